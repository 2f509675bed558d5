#include "mapping/variogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mapping/plan_kd_tree.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kCentres = 1500;
constexpr std::size_t kClasses = 30;
constexpr int kRanges = 40;
constexpr int kExponents = 18;
constexpr double kGreatestExponent = 1.8;

struct Pair {
    double distance_m;
    double half_squared_m2;
};

struct Fit {
    Variogram variogram;
    double misfit = std::numeric_limits<double>::infinity();
};

/// Nugget and sill that fit best, neither below zero.
Fit fitLinearPart(Variogram shape, const std::vector<VariogramClass>& classes,
                  const std::vector<double>& weights) {
    double w = 0.0, ws = 0.0, wss = 0.0, wg = 0.0, wsg = 0.0;
    std::vector<double> structure(classes.size());
    shape.sill_m2 = 1.0;
    for (std::size_t i = 0; i < classes.size(); ++i) {
        structure[i] = shape.structureAt(classes[i].distance_m);
        w += weights[i];
        ws += weights[i] * structure[i];
        wss += weights[i] * structure[i] * structure[i];
        wg += weights[i] * classes[i].semivariance_m2;
        wsg += weights[i] * structure[i] * classes[i].semivariance_m2;
    }
    const double determinant = w * wss - ws * ws;
    double nugget = 0.0;
    double sill = wss > 0.0 ? wsg / wss : 0.0;
    if (determinant > 1e-12 * w * wss) {
        const double free_nugget = (wss * wg - ws * wsg) / determinant;
        const double free_sill = (w * wsg - ws * wg) / determinant;
        if (free_sill < 0.0) {
            nugget = wg / w;
            sill = 0.0;
        } else if (free_nugget > 0.0) {
            nugget = free_nugget;
            sill = free_sill;
        }
    }
    shape.nugget_m2 = nugget;
    shape.sill_m2 = sill;
    Fit fit{shape, 0.0};
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const double off = nugget + sill * structure[i] - classes[i].semivariance_m2;
        fit.misfit += weights[i] * off * off;
    }
    return fit;
}

Fit bestFit(const std::vector<VariogramClass>& classes, const std::vector<double>& weights) {
    const double longest = classes.back().distance_m;
    const double shortest = std::max(classes.front().distance_m, longest * 1e-3);
    Fit best;
    for (int i = 1; i <= kExponents; ++i) {
        const double exponent = kGreatestExponent * i / kExponents;
        const Fit fit = fitLinearPart({VariogramModel::Power, 0.0, 1.0, longest, exponent}, classes, weights);
        if (fit.misfit < best.misfit) best = fit;
    }
    for (const VariogramModel model : {VariogramModel::Spherical, VariogramModel::Exponential}) {
        for (int i = 0; i < kRanges; ++i) {
            // From the shortest distance to three times the longest: beyond, they are all but straight lines.
            const double range =
                shortest * std::pow(3.0 * longest / shortest, static_cast<double>(i) / (kRanges - 1));
            const Fit fit = fitLinearPart({model, 0.0, 1.0, range, 1.0}, classes, weights);
            if (fit.misfit < best.misfit) best = fit;
        }
    }
    return best;
}

}  // namespace

std::string_view name(VariogramModel model) {
    switch (model) {
        case VariogramModel::Power:
            return "power";
        case VariogramModel::Spherical:
            return "spherical";
        case VariogramModel::Exponential:
            return "exponential";
    }
    return "unknown";
}

double Variogram::structureAt(double distance_m) const {
    const double share = distance_m / range_m;
    switch (model) {
        case VariogramModel::Power:
            return sill_m2 * std::pow(share, exponent);
        case VariogramModel::Spherical:
            return share >= 1.0 ? sill_m2 : sill_m2 * share * (1.5 - 0.5 * share * share);
        case VariogramModel::Exponential:
            return sill_m2 * -std::expm1(-3.0 * share);
    }
    return 0.0;
}

std::vector<VariogramClass> empiricalVariogram(const std::vector<Eigen::Vector3d>& points_m,
                                               std::size_t neighbours) {
    if (points_m.size() < 2) return {};
    const PlanKdTree tree(points_m);
    std::vector<Pair> pairs;
    std::vector<Neighbour> near;
    const std::size_t centres = std::min(kCentres, points_m.size());
    for (std::size_t i = 0; i < centres; ++i) {
        const std::size_t centre = i * points_m.size() / centres;
        tree.nearest(points_m[centre].head<2>(), neighbours + 1, near);
        for (const Neighbour& neighbour : near) {
            if (neighbour.point == centre) continue;
            const double rise = points_m[neighbour.point].z() - points_m[centre].z();
            pairs.push_back({std::sqrt(neighbour.squared_distance_m2), 0.5 * rise * rise});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
        return a.distance_m != b.distance_m ? a.distance_m < b.distance_m
                                            : a.half_squared_m2 < b.half_squared_m2;
    });
    std::vector<VariogramClass> classes;
    const std::size_t count = std::min(kClasses, pairs.size());
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t begin = k * pairs.size() / count;
        const std::size_t end = (k + 1) * pairs.size() / count;
        VariogramClass sums;
        for (std::size_t i = begin; i < end; ++i) {
            sums.distance_m += pairs[i].distance_m;
            sums.semivariance_m2 += pairs[i].half_squared_m2;
        }
        sums.pairs = end - begin;
        sums.distance_m /= static_cast<double>(sums.pairs);
        sums.semivariance_m2 /= static_cast<double>(sums.pairs);
        classes.push_back(sums);
    }
    return classes;
}

Variogram fitVariogram(const std::vector<VariogramClass>& classes) {
    double greatest = 0.0;
    for (const VariogramClass& c : classes) greatest = std::max(greatest, c.semivariance_m2);
    if (greatest == 0.0) return {};
    std::vector<double> weights(classes.size());
    const auto weigh = [&](auto expected_m2) {
        for (std::size_t i = 0; i < classes.size(); ++i) {
            const double level = std::max(expected_m2(classes[i]) / greatest, 1e-6);
            weights[i] = static_cast<double>(classes[i].pairs) / (level * level);
        }
    };
    weigh([](const VariogramClass& c) { return c.semivariance_m2; });
    Fit fit = bestFit(classes, weights);
    for (int round = 0; round < 2; ++round) {
        weigh([&](const VariogramClass& c) {
            return fit.variogram.nugget_m2 + fit.variogram.structureAt(c.distance_m);
        });
        fit = bestFit(classes, weights);
    }
    return fit.variogram;
}

}  // namespace terrawalk
