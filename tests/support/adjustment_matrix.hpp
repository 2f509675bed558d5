#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/support/random_numbers.hpp"

namespace terrawalk::test {

/// The normal matrix of a made-up joint adjustment of walks over a field, with the couplings of a real one:
/// position knots each second along the track, slow sensor errors with knots of their own, a few unknowns of
/// the whole survey, and couplings between passes that come within a metre of each other. Positive definite.
class AdjustmentMatrix {
  public:
    /// @param walk_s  length of the area walk
    /// @param fixed_runs  short walks beside it
    /// @param reach_m  within which passes are coupled
    AdjustmentMatrix(std::size_t walk_s, std::size_t fixed_runs, double reach_m, std::uint64_t seed)
        : random_(seed), reach_m_(reach_m) {
        survey_ = take(3);
        addRun(areaTrack(walk_s));
        for (std::size_t run = 0; run < fixed_runs; ++run) {
            const double course = 6.28 * static_cast<double>(run) / static_cast<double>(fixed_runs);
            std::vector<Eigen::Vector2d> track;
            for (std::size_t k = 0; k < 52; ++k) {
                const double way_m = 0.7 * static_cast<double>(k);
                track.push_back(way_m * Eigen::Vector2d(std::cos(course), std::sin(course)));
            }
            addRun(track);
        }
        addPairs();
    }

    [[nodiscard]] Eigen::SparseMatrix<double> matrix() const {
        const auto n = static_cast<Eigen::Index>(unknowns_);
        Eigen::SparseMatrix<double> jacobian(static_cast<Eigen::Index>(rows_), n);
        jacobian.setFromTriplets(entries_.begin(), entries_.end());
        Eigen::SparseMatrix<double> damping(n, n);
        damping.setIdentity();
        return Eigen::SparseMatrix<double>(jacobian.transpose() * jacobian) + 0.05 * damping;
    }

  private:
    struct Knot {
        Eigen::Vector2d en_m;
        std::size_t first;  ///< unknown of the knot's east
        double time_s;
    };

    static std::vector<Eigen::Vector2d> areaTrack(std::size_t walk_s) {
        // Lines 3 m apart over 50 x 60 m, then slanting passes back across them.
        std::vector<Eigen::Vector2d> corners;
        for (int line = 0; line < 20; ++line) {
            const double n_m = 3.0 * line;
            corners.emplace_back(line % 2 == 0 ? 0.0 : 50.0, n_m);
            corners.emplace_back(line % 2 == 0 ? 50.0 : 0.0, n_m);
        }
        for (int pass = 0; pass < 100; ++pass) {
            corners.emplace_back(3.0 + 4.7 * (pass % 10), pass % 2 == 0 ? 0.0 : 57.0);
        }
        constexpr double kSpeed_mps = 0.8;
        std::vector<Eigen::Vector2d> track;
        std::size_t corner = 0;
        double along_m = 0.0;
        while (track.size() < walk_s && corner + 1 < corners.size()) {
            const Eigen::Vector2d leg = corners[corner + 1] - corners[corner];
            if (along_m > leg.norm()) {
                along_m -= leg.norm();
                ++corner;
                continue;
            }
            track.push_back(corners[corner] + along_m * leg.normalized());
            along_m += kSpeed_mps;
        }
        return track;
    }

    std::size_t take(std::size_t count) {
        unknowns_ += count;
        return unknowns_ - count;
    }

    void addRow(const std::vector<std::size_t>& columns) {
        for (const std::size_t column : columns) {
            entries_.emplace_back(static_cast<int>(rows_), static_cast<int>(column),
                                  random_.uniform(-1.0, 1.0));
        }
        ++rows_;
    }

    void addRun(const std::vector<Eigen::Vector2d>& track) {
        const std::size_t n = track.size();
        const std::size_t position = take(3 * n);
        const std::size_t gust = take(n);
        const std::size_t gnss = take(3 * (n / 4 + 2));
        const std::size_t drift = take(n / 10 + 2);
        const std::size_t heading = take(n / 10 + 2);
        for (std::size_t k = 0; k < n; ++k) {
            knots_.push_back({track[k], position + 3 * k, 1.0 * static_cast<double>(knots_.size())});
            const std::size_t e = position + 3 * k;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                addRow({e + axis, gnss + 3 * (k / 4) + axis, gnss + 3 * (k / 4 + 1) + axis});
            }
            addRow({e + 2, gust + k, drift + k / 10, drift + k / 10 + 1});
            if (k + 1 == n) break;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                addRow({e + axis, e + 3 + axis, gnss + 3 * (k / 4) + axis, gnss + 3 * (k / 4 + 1) + axis});
            }
            addRow({e + 2, e + 5, gust + k, gust + k + 1, drift + k / 10, drift + k / 10 + 1});
            for (std::size_t axis = 0; axis < 2; ++axis) {
                addRow({e + axis, e + 3 + axis, heading + k / 10, heading + k / 10 + 1, survey_, survey_ + 1,
                        survey_ + 2});
            }
            addRow({gust + k, gust + k + 1});
        }
    }

    void addPairs() {
        for (std::size_t a = 0; a + 1 < knots_.size(); ++a) {
            // The nearest knot of each other pass, where passes are stretches of 20 s.
            std::size_t best = knots_.size();
            for (std::size_t b = a + 20; b + 1 < knots_.size(); ++b) {
                const double distance_m = (knots_[a].en_m - knots_[b].en_m).norm();
                if (distance_m < reach_m_ &&
                    (best == knots_.size() || distance_m < (knots_[a].en_m - knots_[best].en_m).norm())) {
                    best = b;
                }
                const bool pass_ends = b + 2 == knots_.size() || (best < knots_.size() && b > best + 20);
                if (pass_ends && best < knots_.size()) {
                    const std::size_t i = knots_[a].first;
                    const std::size_t j = knots_[best].first;
                    addRow({i, i + 1, i + 2, i + 3, i + 4, i + 5, j, j + 1, j + 2, j + 3, j + 4, j + 5});
                    best = knots_.size();
                }
            }
        }
    }

    RandomNumbers random_;
    double reach_m_;
    std::size_t unknowns_ = 0;
    std::size_t rows_ = 0;
    std::size_t survey_ = 0;
    std::vector<Knot> knots_;
    std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace terrawalk::test
