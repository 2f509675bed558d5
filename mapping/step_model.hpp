#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "mapping/plan_cells.hpp"

namespace terrawalk {

// A step in the ground along a line, fitted to the points about a place: two treads that each slope on their
// own, a face of one width between them, and its middle line, a parabola in plan. Heights are linear in five
// parameters, which are solved for; place, course, bend and width are searched on grids, so that a face
// without a point on it is found as well. Lengths in the unit of the points; all pure, safe from any thread.

/// Looks along a step: u ahead, v to the left, uphill.
struct StepFrame {
    Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();
    double course_rad = 0.0;

    [[nodiscard]] Eigen::Vector2d ahead() const { return {std::cos(course_rad), std::sin(course_rad)}; }
    [[nodiscard]] Eigen::Vector2d toMap(double u, double v) const {
        const Eigen::Vector2d a = ahead();
        return origin_m + u * a + v * Eigen::Vector2d(-a.y(), a.x());
    }
};

/// How far a look at a place goes, and what the heights are worth.
struct StepScale {
    double reach_m = 0.0;  ///< across the step, to either side
    double along_m = 0.0;  ///< along it, to either side
    double noise_m = 0.0;  ///< sigma of the heights, as a first guess
};

struct WindowPoint {
    double u, v, z, weight;
};
/// Points about a place, in its frame; heights from their mean: sums of squares lose no digits.
struct StepWindow {
    std::vector<WindowPoint> points;
    StepScale scale;
    double mean_height_m = 0.0;
};

/// Points in reach, weighted by the tricube of their distance along.
[[nodiscard]] StepWindow windowAt(const PlanCells& cells, const StepFrame& frame, const StepScale& scale);
/// Those not far along: the others tell a place only as far as course and bend are known.
[[nodiscard]] StepWindow middleOf(const StepWindow& window);
[[nodiscard]] double totalWeight(const StepWindow& window);

/// The middle of the face, v = place + course u + bend u^2, and its width.
struct StepShape {
    double place_m = 0.0;
    double course = 0.0;
    double bend_pm = 0.0;
    double width_m = 0.6;

    /// Signed distance from the middle of the face, in v.
    [[nodiscard]] double offset_m(const WindowPoint& p) const {
        return p.v - (place_m + p.u * (course + p.u * bend_pm));
    }
};

struct StepFit {
    StepShape shape;
    double middle_m = 0.0;  ///< height of the middle of the face at u = 0, from the window's mean height
    double along_slope = 0.0;
    double lower_slope = 0.0;  ///< of the treads, across
    double upper_slope = 0.0;
    double step_m = 0.0;
    double squares_m2 = std::numeric_limits<double>::infinity();  ///< weighted, of what is left

    [[nodiscard]] double height_m(const WindowPoint& p) const;
};
/// Weighted least squares; treads are near level unless points say otherwise.
[[nodiscard]] StepFit fitStep(const StepWindow& window, const StepShape& shape);

/// Points far off the fit lose weight (Huber).
[[nodiscard]] StepWindow robustWindow(const StepWindow& window, const StepFit& fit);

/// How far about a first shape the search goes, and how likely it is to change.
struct StepSearch {
    double place_m = 0.0;  ///< to either side
    double course = 0.0;
    double bend_pm = 0.0;
    double greatest_width_m = 0.0;
    bool from_before = false;  ///< whether a place before tells what to expect
    double place_sigma_m = std::numeric_limits<double>::infinity();
    double course_sigma = 0.0;
    double bend_sigma_pm = 0.0;
    double bend_before_pm = 0.0;
};
/// The best shape, with the robust window that it was found in. The step rises to the left, or no better fit
/// than the first one was found.
struct FoundStep {
    StepWindow window;
    StepFit fit;
};
[[nodiscard]] FoundStep searchStep(const StepWindow& window, const StepShape& start,
                                   const StepSearch& search);

/// Of the step against a quadratic surface, by the Bayesian information criterion (as twice a log of odds).
[[nodiscard]] double gainOf(const StepWindow& window, const StepFit& fit);
/// The same before bend and width are searched for, without the price of parameters.
[[nodiscard]] double roughGain(double smooth_squares_m2, const StepFit& fit, double total_weight);
/// What a quadratic surface leaves.
[[nodiscard]] double smoothSquares_m2(const StepWindow& window);

/// Whether there are points on both sides of the face.
[[nodiscard]] bool onBothSides(const StepWindow& window, const StepShape& shape);
/// Whether there are points on both sides and both ways along.
[[nodiscard]] bool supported(const StepWindow& window, const StepShape& shape);

/// Means of place and width over the likelihood, by the points nearby.
struct StepPlace {
    StepShape mean;
    double sigma_m = 0.0;  ///< of the place, across
};
struct StepPlaces {
    StepPlace seen;      ///< by the points' word alone
    StepPlace expected;  ///< with what the place before tells
};
/// @param window  the points nearby
/// @param sigma_m  of a height about the fit
[[nodiscard]] StepPlaces placeStep(const StepWindow& window, const StepFit& fit, double sigma_m,
                                   const StepSearch& search);
/// Sigma of a height about the fit, with a floor; needs more weight than parameters.
[[nodiscard]] double sigmaAbout_m(const StepWindow& window, const StepFit& fit);
/// Whether there is more weight than the fit has parameters.
[[nodiscard]] bool determined(const StepWindow& window);

}  // namespace terrawalk
