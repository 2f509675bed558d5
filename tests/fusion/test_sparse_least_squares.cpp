#include "fusion/sparse_least_squares.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>
#include <vector>

#include "tests/support/random_numbers.hpp"

namespace terrawalk {
namespace {

using Eigen::Index;

RowGroup group(Loss loss, double tuning, double scale = 1.0) {
    RowGroup g;
    g.name = "rows";
    g.loss = loss;
    g.tuning = tuning;
    g.scale = scale;
    return g;
}

/// The same rows once more, dense.
struct DenseRows {
    Eigen::MatrixXd A;
    Eigen::VectorXd residual;
    Eigen::VectorXd sigma;
    std::vector<std::size_t> group;
};

/// Each unknown stands in a row of its own and in some that it shares.
DenseRows randomRows(Index unknowns, Index rows, std::size_t groups, test::RandomNumbers& random) {
    DenseRows dense{Eigen::MatrixXd::Zero(rows, unknowns), Eigen::VectorXd(rows), Eigen::VectorXd(rows), {}};
    for (Index r = 0; r < rows; ++r) {
        if (r < unknowns) dense.A(r, r) = 1.0;
        for (int k = 0; k < 3; ++k) {
            dense.A(r, static_cast<Index>(random.below(static_cast<std::size_t>(unknowns)))) +=
                random.uniform(-0.3, 0.3);
        }
        dense.residual[r] = random.normal();
        dense.sigma[r] = random.uniform(0.3, 3.0);
        dense.group.push_back(random.below(groups));
    }
    return dense;
}

SparseLeastSquares systemOf(const DenseRows& dense, std::vector<RowGroup> groups) {
    SparseLeastSquares system(static_cast<std::size_t>(dense.A.cols()), std::move(groups));
    std::vector<Coefficient> row;
    for (Index r = 0; r < dense.A.rows(); ++r) {
        row.clear();
        for (Index j = 0; j < dense.A.cols(); ++j) {
            if (dense.A(r, j) != 0.0) row.push_back({static_cast<std::size_t>(j), dense.A(r, j)});
        }
        system.addRow(dense.group[static_cast<std::size_t>(r)], row, dense.residual[r], dense.sigma[r]);
    }
    return system;
}

// Written out once more: Huber 1981; the Cauchy weight of Holland and Welsch 1977.
double weight(const RowGroup& g, double residual, double sigma) {
    const double t = std::abs(residual) / (g.scale * sigma) / g.tuning;
    if (g.loss == Loss::Huber) return std::min(1.0, 1.0 / t);
    return g.loss == Loss::Cauchy ? 1.0 / (1.0 + t * t) : 1.0;
}

Eigen::VectorXd inverseSigmas(const DenseRows& dense, const std::vector<RowGroup>& groups) {
    Eigen::VectorXd w(dense.A.rows());
    for (Index r = 0; r < w.size(); ++r) {
        const RowGroup& g = groups[dense.group[static_cast<std::size_t>(r)]];
        w[r] = std::sqrt(weight(g, dense.residual[r], dense.sigma[r])) / (g.scale * dense.sigma[r]);
    }
    return w;
}

/// Rounding of the normal equations: their condition number, at most the square of that of the rows.
double tolerance(const Eigen::MatrixXd& weighted) {
    const Eigen::VectorXd s = weighted.jacobiSvd().singularValues();
    const double condition = s[0] / s[s.size() - 1];
    return 16.0 * static_cast<double>(weighted.cols()) * std::numeric_limits<double>::epsilon() * condition *
           condition;
}

const std::vector<std::vector<RowGroup>>& allKinds() {
    static const std::vector<std::vector<RowGroup>> kinds{
        {group(Loss::Square, 1.0)},
        {group(Loss::Huber, 0.7)},
        {group(Loss::Cauchy, 1.5)},
        {group(Loss::Square, 1.0, 2.5), group(Loss::Huber, 0.5, 0.4), group(Loss::Cauchy, 0.8, 1.7)}};
    return kinds;
}

TEST(SparseLeastSquares, SolvesLikeADenseQr) {
    test::RandomNumbers random(1);
    for (const std::vector<RowGroup>& groups : allKinds()) {
        for (const Index unknowns : {1, 4, 25}) {
            const DenseRows dense = randomRows(unknowns, 4 * unknowns, groups.size(), random);
            SparseLeastSquares system = systemOf(dense, groups);
            const auto solution = system.solve();
            ASSERT_TRUE(solution);
            const Eigen::VectorXd w = inverseSigmas(dense, groups);
            const Eigen::MatrixXd weighted = w.asDiagonal() * dense.A;
            const Eigen::VectorXd expected =
                weighted.colPivHouseholderQr().solve(w.cwiseProduct(dense.residual));
            EXPECT_LE((*solution - expected).norm(), tolerance(weighted) * (1.0 + expected.norm()));
        }
    }
}

TEST(SparseLeastSquares, ItsCovarianceIsTheDenseInverse) {
    test::RandomNumbers random(2);
    for (const std::vector<RowGroup>& groups : allKinds()) {
        const DenseRows dense = randomRows(20, 70, groups.size(), random);
        SparseLeastSquares system = systemOf(dense, groups);
        for (std::size_t i = 0; i < 20; ++i) system.wantCovariance(i, (7 * i + 3) % 20);
        ASSERT_TRUE(system.solve());
        const Eigen::MatrixXd weighted = inverseSigmas(dense, groups).asDiagonal() * dense.A;
        const Eigen::MatrixXd inverse = (weighted.transpose() * weighted).inverse();
        const double bound = tolerance(weighted) * inverse.norm();
        for (std::size_t i = 0; i < 20; ++i) {
            const std::size_t asked = (7 * i + 3) % 20;
            EXPECT_NEAR(system.covariance(i, asked),
                        inverse(static_cast<Index>(i), static_cast<Index>(asked)), bound);
            EXPECT_EQ(system.covariance(i, asked), system.covariance(asked, i));
        }
        for (Index r = 0; r < 70; ++r) {
            for (Index i = 0; i < 20; ++i) {
                for (Index j = 0; j < 20; ++j) {
                    if (dense.A(r, i) == 0.0 || dense.A(r, j) == 0.0) continue;
                    EXPECT_NEAR(system.covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j)),
                                inverse(i, j), bound);
                }
            }
        }
    }
}

TEST(SparseLeastSquares, AnUnknownTwiceInARowIsItsSum) {
    SparseLeastSquares twice(2, {group(Loss::Square, 1.0)});
    twice.addRow(0, {{0, 1.0}, {1, 0.5}, {0, 2.0}}, 1.0, 0.5);
    twice.addRow(0, {{1, 1.0}}, 0.3, 0.2);
    twice.addRow(0, {{0, 1.0}}, 0.1, 0.7);
    SparseLeastSquares once(2, {group(Loss::Square, 1.0)});
    once.addRow(0, {{0, 3.0}, {1, 0.5}}, 1.0, 0.5);
    once.addRow(0, {{1, 1.0}}, 0.3, 0.2);
    once.addRow(0, {{0, 1.0}}, 0.1, 0.7);
    const auto a = twice.solve();
    const auto b = once.solve();
    ASSERT_TRUE(a && b);
    EXPECT_LT((*a - *b).norm(), 1e-14);
    EXPECT_NEAR(twice.covariance(0, 1), once.covariance(0, 1), 1e-14);
    EXPECT_NEAR(twice.statistics(*a)[0].redundancy, once.statistics(*b)[0].redundancy, 1e-13);
}

TEST(SparseLeastSquares, SaysWhenTheRowsDoNotDetermineAnUnknown) {
    SparseLeastSquares open(3, {group(Loss::Square, 1.0)});
    open.addRow(0, {{0, 1.0}, {1, -1.0}}, 0.0, 1.0);
    open.addRow(0, {{1, 1.0}, {2, -1.0}}, 0.0, 1.0);
    EXPECT_FALSE(open.solve());
    open.addRow(0, {{2, 1.0}}, 1.0, 1.0);
    EXPECT_TRUE(open.solve());

    SparseLeastSquares unmeasured(2, {group(Loss::Square, 1.0)});
    unmeasured.addRow(0, {{0, 1.0}}, 1.0, 1.0);
    EXPECT_FALSE(unmeasured.solve());

    SparseLeastSquares not_finite(1, {group(Loss::Square, 1.0)});
    not_finite.addRow(0, {{0, 1.0}}, std::numeric_limits<double>::quiet_NaN(), 1.0);
    EXPECT_FALSE(not_finite.solve());
}

TEST(SparseLeastSquares, AStopRequestLeavesNoNumbers) {
    std::stop_source source;
    SparseLeastSquares system(1, {group(Loss::Square, 1.0)}, source.get_token());
    system.addRow(0, {{0, 1.0}}, 1.0, 1.0);
    ASSERT_TRUE(system.solve());
    source.request_stop();
    EXPECT_TRUE(std::isnan(system.covariance(0, 0)));
    EXPECT_FALSE(system.solve());
}

TEST(SparseLeastSquares, AnOrderTakenOverChangesNoResult) {
    test::RandomNumbers random(3);
    const std::vector<RowGroup> groups{group(Loss::Huber, 1.0)};
    const DenseRows first = randomRows(30, 90, 1, random);
    for (const bool same_pattern : {true, false}) {
        DenseRows second = same_pattern ? first : randomRows(30, 90, 1, random);
        for (double& residual : second.residual) residual += random.normal();
        SparseLeastSquares before = systemOf(first, groups);
        ASSERT_TRUE(before.solve());
        SparseLeastSquares alone = systemOf(second, groups);
        SparseLeastSquares after = systemOf(second, groups);
        after.continueFrom(before);
        const auto a = alone.solve();
        const auto b = after.solve();
        ASSERT_TRUE(a && b);
        const double bound = tolerance(inverseSigmas(second, groups).asDiagonal() * second.A);
        EXPECT_LT((*a - *b).norm(), bound * (1.0 + a->norm()));
        EXPECT_NEAR(alone.covariance(4, 4), after.covariance(4, 4), bound * alone.covariance(4, 4));
    }
}

// Fit of a line to 60 points, six of them 50 sigmas off: rounds of re-weighting.
TEST(SparseLeastSquares, ReweightingLeavesOutliersBehind) {
    const auto fitted = [](Loss loss, double* least_weight, std::size_t* down_weighted) {
        test::RandomNumbers random(4);
        Eigen::VectorXd y(60);
        for (Index i = 0; i < 60; ++i) {
            y[i] = 2.0 + 0.1 * static_cast<double>(i) + 0.05 * random.normal() + (i % 10 == 5 ? 2.5 : 0.0);
        }
        Eigen::Vector2d x = Eigen::Vector2d::Zero();
        for (int round = 0; round < 30; ++round) {
            SparseLeastSquares system(2, {group(round == 0 ? Loss::Square : loss, 2.0)});
            for (Index i = 0; i < 60; ++i) {
                const auto t = static_cast<double>(i);
                system.addRow(0, {{0, 1.0}, {1, t}}, y[i] - x[0] - x[1] * t, 0.05);
            }
            *least_weight = system.robustWeight(5);
            const auto step = system.solve();
            EXPECT_TRUE(step);
            if (!step) break;
            *down_weighted = system.statistics(*step)[0].down_weighted;
            x += *step;
        }
        return Eigen::Vector2d(x - Eigen::Vector2d(2.0, 0.1));
    };
    double weight = 1.0;
    std::size_t down_weighted = 0;
    // The mean of the six drags a plain fit by 0.25 m; 54 good points tell the level to 0.05 2 / sqrt(54).
    const double level_sigma = 0.05 * 2.0 / std::sqrt(54.0);
    EXPECT_GT(std::abs(fitted(Loss::Square, &weight, &down_weighted)[0]), 10.0 * level_sigma);
    EXPECT_EQ(weight, 1.0);
    EXPECT_EQ(down_weighted, 0U);
    EXPECT_LT(std::abs(fitted(Loss::Cauchy, &weight, &down_weighted)[0]), 4.0 * level_sigma);
    EXPECT_LT(weight, 0.01);
    EXPECT_GE(down_weighted, 6U);
    EXPECT_LT(down_weighted, 15U);
    EXPECT_LT(std::abs(fitted(Loss::Huber, &weight, &down_weighted)[0]), 6.0 * level_sigma);
    EXPECT_LT(weight, 0.1);
}

TEST(SparseLeastSquares, RedundancyIsRowsLessUnknowns) {
    test::RandomNumbers random(5);
    const std::vector<RowGroup> groups{group(Loss::Square, 1.0), group(Loss::Square, 1.0, 0.3)};
    const DenseRows dense = randomRows(25, 80, 2, random);
    SparseLeastSquares system = systemOf(dense, groups);
    const auto solution = system.solve();
    ASSERT_TRUE(solution);
    const std::vector<GroupStatistics> statistics = system.statistics(*solution);
    EXPECT_EQ(statistics[0].rows + statistics[1].rows, 80U);
    EXPECT_NEAR(statistics[0].redundancy + statistics[1].redundancy, 55.0, 1e-9);
    // Koenig's identity: the squares that the fit leaves are the squares before less those explained.
    const Eigen::VectorXd w = inverseSigmas(dense, groups);
    const Eigen::VectorXd left = w.cwiseProduct(dense.residual - dense.A * *solution);
    EXPECT_NEAR(statistics[0].weighted_squares + statistics[1].weighted_squares, left.squaredNorm(),
                1e-9 * left.squaredNorm());
}

// The mean of many readings of two instruments whose sigmas are said wrong.
TEST(SparseLeastSquares, FindsTheNoiseOfEachGroup) {
    constexpr int kRows = 2000;
    for (const Loss loss : {Loss::Square, Loss::Huber, Loss::Cauchy}) {
        test::RandomNumbers random(6);
        std::vector<RowGroup> groups{group(loss, 2.0), group(loss, 2.0), group(Loss::Square, 1.0)};
        groups[0].adapt = groups[1].adapt = true;
        std::vector<double> readings;
        for (int i = 0; i < kRows; ++i) {
            readings.push_back(0.5 * random.normal());
            readings.push_back(3.0 * random.normal());
        }
        double x = 0.0;
        for (int round = 0; round < 20; ++round) {
            SparseLeastSquares system(1, groups);
            for (std::size_t i = 0; i < readings.size(); ++i) {
                system.addRow(i % 2, {{0, 1.0}}, readings[i] - x, 1.0);
            }
            const auto step = system.solve();
            ASSERT_TRUE(step);
            system.adaptScales(system.statistics(*step));
            groups = system.groups();
            x += (*step)[0];
        }
        // A standard deviation from n normal numbers is known to 1 / sqrt(2 n); robust ones lose up to
        // half of the information. The prior of 20 rows moves it by 1 %.
        const double bound = 4.0 / std::sqrt(static_cast<double>(kRows)) + 0.01;
        EXPECT_NEAR(groups[0].scale, 0.5, 0.5 * bound + 0.02);
        EXPECT_NEAR(groups[1].scale, 3.0, 3.0 * bound);
        EXPECT_EQ(groups[2].scale, 1.0);
    }
}

TEST(SparseLeastSquares, TheMedianOfAGroupDoesNotSeeItsOutliers) {
    for (const bool by_median : {true, false}) {
        test::RandomNumbers random(7);
        RowGroup rows = group(Loss::Square, 1.0);
        rows.adapt = true;
        rows.by_median = by_median;
        SparseLeastSquares system(1, {rows});
        for (int i = 0; i < 1000; ++i) {
            system.addRow(0, {{0, 1.0}}, (i % 10 == 0 ? 30.0 : 1.0) * random.normal(), 1.0);
        }
        const auto step = system.solve();
        ASSERT_TRUE(step);
        system.adaptScales(system.statistics(*step));
        // A tenth of outliers moves the median of the sizes from 0.6745 to 0.77 sigmas; their squares moves
        // the mean square tenfold, to the limit.
        if (by_median) {
            EXPECT_NEAR(system.groups()[0].scale, 0.77 / 0.6745, 0.12);
        } else {
            EXPECT_EQ(system.groups()[0].scale, rows.greatest_scale);
        }
    }
}

TEST(SparseLeastSquares, PlainSquaresCountWhatTheWeightsHoldOff) {
    SparseLeastSquares system(1, {group(Loss::Cauchy, 2.0)});
    for (int i = 0; i < 20; ++i) system.addRow(0, {{0, 1.0}}, i % 2 == 0 ? 1.0 : -1.0, 1.0);
    system.addRow(0, {{0, 1.0}}, 100.0, 1.0);
    const Eigen::VectorXd stays = Eigen::VectorXd::Zero(1);
    ASSERT_TRUE(system.solve());
    const GroupStatistics s = system.statistics(stays)[0];
    EXPECT_NEAR(s.squares, 20.0 + 1e4, 1e-9);
    // Weight 1 / (1 + (r / 2)^2) of each.
    EXPECT_NEAR(s.weighted_squares, 20.0 * 0.8 + 1e4 / 2501.0, 1e-9);
}

TEST(SparseLeastSquares, NoiseFactorsStayInTheirLimits) {
    for (const double size : {1e-3, 1e3}) {
        RowGroup rows = group(Loss::Square, 1.0);
        rows.adapt = true;
        rows.least_scale = 0.3;
        rows.greatest_scale = 2.0;
        rows.prior_rows = 1.0;
        SparseLeastSquares system(1, {rows});
        for (int i = 0; i < 100; ++i) system.addRow(0, {{0, 1.0}}, i % 2 == 0 ? size : -size, 1.0);
        const auto step = system.solve();
        ASSERT_TRUE(step);
        system.adaptScales(system.statistics(*step));
        EXPECT_EQ(system.groups()[0].scale, size < 1.0 ? 0.3 : 2.0);
    }
}

TEST(ExpectedWeightedSquare, HasTheClosedForms) {
    EXPECT_NEAR(expectedWeightedSquare(Loss::Square, 1.0), 1.0, 1e-6);
    for (const double c : {0.5, 1.345, 2.0, 3.0}) {
        // Integrated by parts.
        EXPECT_NEAR(expectedWeightedSquare(Loss::Huber, c), std::erf(c / std::sqrt(2.0)), 1e-5) << c;
        const double inverse =
            c * std::sqrt(std::acos(-1.0) / 2.0) * std::exp(0.5 * c * c) * std::erfc(c / std::sqrt(2.0));
        EXPECT_NEAR(expectedWeightedSquare(Loss::Cauchy, c), c * c * (1.0 - inverse), 1e-6) << c;
    }
}

}  // namespace
}  // namespace terrawalk
