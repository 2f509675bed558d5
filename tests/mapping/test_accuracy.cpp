#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mapping/accuracy.hpp"
#include "mapping/accuracy_statements.hpp"
#include "mapping/order_statistics.hpp"
#include "tests/support/example_report.hpp"
#include "tests/support/random_numbers.hpp"

namespace terrawalk {
namespace {

using test::exampleReport;
using test::ExampleSurvey;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kRounding = 1e-14;

/// Triangular numbers with alternating signs: nothing symmetric that could hide a wrong term.
std::vector<double> unevenDifferences(int n) {
    std::vector<double> d;
    for (int i = 0; i < n; ++i) d.push_back((i % 3 == 0 ? -1.0 : 1.0) * 0.01 * i * (i + 1) / 2.0 + 0.003);
    return d;
}

Residual heightResidual(std::string mark, double d_u_m, MarkRole role = MarkRole::Check,
                        Stage stage = Stage::Surface, Quantity quantity = Quantity::SurfaceHeight) {
    Residual r;
    r.stage = stage;
    r.quantity = quantity;
    r.mark = std::move(mark);
    r.role = role;
    r.difference_enu_m.z() = d_u_m;
    return r;
}

TEST(ErrorStatistics, AreThoseOfAHandWorkedExample) {
    // d = -2 0 1 5 (mm would do as well): sum 4, squares 30, deviations from 1: 9 1 0 16.
    const ErrorStatistics s = errorStatistics(std::vector<double>{5.0, -2.0, 0.0, 1.0}, 1);
    EXPECT_EQ(s.n, 4U);
    EXPECT_EQ(s.marks, 4U);
    EXPECT_DOUBLE_EQ(s.mean_m, 1.0);
    EXPECT_DOUBLE_EQ(s.sd_m.value(), std::sqrt(26.0 / 3.0));
    EXPECT_DOUBLE_EQ(s.rmse_m, std::sqrt(7.5));
    EXPECT_DOUBLE_EQ(s.mae_m, 2.0);
    EXPECT_DOUBLE_EQ(s.median_m, 0.5);
    EXPECT_DOUBLE_EQ(s.nmad_m, 1.4826 * 1.5);  // |d - 0.5| = 0.5 0.5 2.5 4.5
    EXPECT_DOUBLE_EQ(s.largest_m, 5.0);
    EXPECT_FALSE(s.rmse_95);
}

TEST(ErrorStatistics, KeepTheSignOfTheLargest) {
    EXPECT_EQ(errorStatistics(std::vector<double>{0.1, -0.3, 0.2}, 1).largest_m, -0.3);
}

TEST(ErrorStatistics, OfOneDifferenceHaveNoSpread) {
    const ErrorStatistics s = errorStatistics(std::vector<double>{-0.25}, 1);
    EXPECT_FALSE(s.sd_m);
    EXPECT_FALSE(s.rmse_95);
    EXPECT_EQ(s.rmse_m, 0.25);
    EXPECT_EQ(s.nmad_m, 0.0);
    EXPECT_EQ(s.median_m, -0.25);
}

TEST(ErrorStatistics, RmseIsMeanAndSpreadTogether) {
    for (const int n : {2, 3, 10, 101}) {
        const ErrorStatistics s = errorStatistics(unevenDifferences(n), 1);
        const double share = (n - 1.0) / n;
        const double together = s.mean_m * s.mean_m + *s.sd_m * *s.sd_m * share;
        EXPECT_NEAR(s.rmse_m * s.rmse_m / together, 1.0, 8 * n * 2.2e-16) << n;
    }
}

TEST(ErrorStatistics, NmadIsTheSigmaOfANormalSampleWhateverItsOutliers) {
    // Quantiles of the standard normal distribution at (i + 0.5) / 9; the outermost two replaced by blunders.
    const std::vector<double> d{-50.0,     -0.9674216, -0.5894558, -0.2822161, 0.0,
                                0.2822161, 0.5894558,  0.9674216,  80.0};
    const ErrorStatistics s = errorStatistics(d, 1);
    // The median of |d| is 0.5895; 0.6745 would be that of an endless sample.
    EXPECT_NEAR(s.nmad_m, 1.4826 * 0.5894558, kRounding);
    EXPECT_GT(*s.sd_m, 30.0);
}

TEST(ErrorStatistics, IntervalComesFromTheSeedAloneAndHoldsTheRmse) {
    const auto d = unevenDifferences(40);
    const ErrorStatistics a = errorStatistics(d, 9), b = errorStatistics(d, 9), c = errorStatistics(d, 10);
    EXPECT_EQ(a.rmse_95->low_m, b.rmse_95->low_m);
    EXPECT_EQ(a.rmse_95->high_m, b.rmse_95->high_m);
    EXPECT_NE(a.rmse_95->low_m, c.rmse_95->low_m);
    EXPECT_LT(a.rmse_95->low_m, a.rmse_m);
    EXPECT_GT(a.rmse_95->high_m, a.rmse_m);
}

TEST(ErrorStatistics, IntervalAgreesWithTheNormalTheoryOfASquare) {
    // For n squares of a normal variable the bootstrap's spread of the mean square is sd(d^2) / sqrt(n). With
    // the quantiles of a normal sample, n = 400: sd(d^2) = sqrt 2 within 4 %, so the interval of the RMSE is
    // 1 +- 1.96 / sqrt(2 n) = 1 +- 0.0693. Tolerance: that 4 %, and 3 % for 4000 resamples.
    std::vector<double> d;
    for (int i = 0; i < 400; ++i) {
        const double p = (i + 0.5) / 400.0;
        double low = -6.0, high = 6.0;
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (low + high);
            (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
        }
        d.push_back(low);
    }
    const ErrorStatistics s = errorStatistics(d, 3);
    EXPECT_NEAR(s.rmse_95->high_m - s.rmse_95->low_m, 2.0 * 0.0693, 0.07 * 2.0 * 0.0693);
}

double square(double value) {
    return value * value;
}

/// Without the bootstraps of the other measures, which take long.
ConfidenceInterval intervalOfQuantile(std::vector<double> errors_m) {
    for (double& error_m : errors_m) error_m = std::abs(error_m);
    std::sort(errors_m.begin(), errors_m.end());
    const QuantilePlaces places = quantilePlaces95(errors_m.size(), 0.95).value();
    return {errors_m[places.low], errors_m[places.high]};
}

/// How often the 95 % intervals of a normal sample hold what they stand for.
struct IntervalCoverage {
    double rmse = 0.0, median = 0.0, nmad = 0.0;
};

IntervalCoverage intervalCoverage(std::size_t n, std::uint64_t seed) {
    constexpr int kSamples = 200;
    test::RandomNumbers random(seed);
    IntervalCoverage share;
    for (int sample = 0; sample < kSamples; ++sample) {
        std::vector<double> d(n);
        for (double& value : d) value = random.normal();
        const ErrorStatistics s = errorStatistics(d, seed + static_cast<std::uint64_t>(sample));
        const auto holds = [](const std::optional<ConfidenceInterval>& interval, double truth) {
            return interval->low_m <= truth && truth <= interval->high_m ? 1.0 / kSamples : 0.0;
        };
        share.rmse += holds(s.rmse_95, 1.0);
        share.median += holds(s.median_95, 0.0);
        share.nmad += holds(s.nmad_95, 1.0);
    }
    return share;
}

TEST(ErrorStatistics, IntervalsHoldTheTruthOfNormalSamplesAboutAsOftenAsTheySay) {
    // Percentile bootstraps are narrow for few marks. Of 200 samples a share of 0.95 scatters by 0.015.
    const auto atLeast = [](std::size_t n, double rmse, double middle) {
        const IntervalCoverage share = intervalCoverage(n, 20'000 + n);
        EXPECT_GE(share.rmse, rmse) << n;
        EXPECT_GE(share.median, middle) << n;
        EXPECT_GE(share.nmad, middle) << n;
        // A median's interval that always held it would be no interval.
        EXPECT_LE(share.rmse, 0.985) << n;
        EXPECT_LE(share.median, 0.985) << n;
    };
    atLeast(30, 0.86, 0.90);
    atLeast(120, 0.89, 0.90);
}

TEST(ErrorStatistics, IntervalOfTheQuantileHoldsItInAtLeast95PercentOfSamples) {
    // Whatever the distribution: normal errors and errors with long tails. Of 1000 samples a share of 0.95
    // scatters by 0.007.
    constexpr int kSamples = 1000;
    constexpr double kNormal = 1.959964, kLaplace = 2.995732;  // 95 % of their sizes are below
    for (const std::size_t n : {72U, 100U, 250U}) {
        test::RandomNumbers random(30'000 + n);
        int normal = 0, laplace = 0;
        for (int sample = 0; sample < kSamples; ++sample) {
            std::vector<double> a(n), b(n);
            for (double& value : a) value = random.normal();
            for (double& value : b) {
                value = 0.5 * (square(random.normal()) + square(random.normal()));  // the size is exponential
            }
            const auto of_a = intervalOfQuantile(std::move(a)), of_b = intervalOfQuantile(std::move(b));
            normal += of_a.low_m <= kNormal && kNormal <= of_a.high_m ? 1 : 0;
            laplace += of_b.low_m <= kLaplace && kLaplace <= of_b.high_m ? 1 : 0;
        }
        EXPECT_GE(normal, 930) << n;
        EXPECT_GE(laplace, 930) << n;
        EXPECT_LE(normal, 990) << n << ": an interval that always held it would be no interval";
    }
}

TEST(ErrorStatistics, IntervalOfTheQuantileNeeds72Marks) {
    // 0.95^72 is the first power below 0.025: the largest of fewer errors passes for a bound too seldom.
    EXPECT_FALSE(errorStatistics(unevenDifferences(71), 1).error95_95);
    const auto d = unevenDifferences(72);
    const ErrorStatistics s = errorStatistics(d, 1);
    ASSERT_TRUE(s.error95_95);
    EXPECT_EQ(s.error95_95->high_m, std::abs(s.largest_m));
    EXPECT_LT(s.error95_95->low_m, s.error95_m);
    EXPECT_FALSE(quantilePlaces95(0, 0.95));
    // Marks count, not differences: the same interval for ten of each, none for ten at seven marks.
    std::vector<MarkDifference> tenfold, few;
    for (std::size_t mark = 0; mark < d.size(); ++mark) {
        for (int repeat = 0; repeat < 10; ++repeat) {
            tenfold.push_back({fmt::format("P{}", mark), d[mark]});
            few.push_back({fmt::format("P{}", mark % 7), d[mark]});
        }
    }
    EXPECT_EQ(errorStatistics(tenfold, 1).error95_95->low_m, s.error95_95->low_m);
    EXPECT_EQ(errorStatistics(tenfold, 1).error95_95->high_m, s.error95_95->high_m);
    EXPECT_FALSE(errorStatistics(few, 1).error95_95);
}

TEST(ErrorStatistics, IntervalOfEqualErrorsIsAPoint) {
    const ErrorStatistics s = errorStatistics(std::vector<double>{0.25, -0.25, 0.25, 0.25, -0.25}, 1);
    EXPECT_DOUBLE_EQ(s.rmse_95->low_m, 0.25);
    EXPECT_DOUBLE_EQ(s.rmse_95->high_m, 0.25);
}

TEST(ErrorStatistics, RepeatsOverOneMarkDoNotNarrowTheInterval) {
    std::vector<MarkDifference> once, tenfold;
    const auto d = unevenDifferences(12);
    for (std::size_t mark = 0; mark < d.size(); ++mark) {
        once.push_back({fmt::format("P{}", mark), d[mark]});
        for (int repeat = 0; repeat < 10; ++repeat) tenfold.push_back(once.back());
    }
    const ErrorStatistics a = errorStatistics(once, 5), b = errorStatistics(tenfold, 5);
    EXPECT_EQ(b.n, 120U);
    EXPECT_EQ(b.marks, 12U);
    EXPECT_NEAR(a.rmse_95->low_m, b.rmse_95->low_m, kRounding);
    EXPECT_NEAR(a.rmse_95->high_m, b.rmse_95->high_m, kRounding);
}

TEST(ErrorStatistics, FourMarksAreTooFewForAnInterval) {
    std::vector<MarkDifference> differences;
    for (int i = 0; i < 40; ++i) differences.push_back({fmt::format("P{}", i % 4), 0.01 * i});
    EXPECT_FALSE(errorStatistics(differences, 1).rmse_95);
}

TEST(OrderStatistics, QuantilesLieBetweenNeighbours) {
    const std::vector<double> sorted{1.0, 2.0, 4.0};
    EXPECT_EQ(quantileOfSorted(sorted, 0.0), 1.0);
    EXPECT_EQ(quantileOfSorted(sorted, 0.5), 2.0);
    EXPECT_EQ(quantileOfSorted(sorted, 0.75), 3.0);
    EXPECT_EQ(quantileOfSorted(sorted, 1.0), 4.0);
    EXPECT_EQ(median({3.0, 1.0}), 2.0);
}

TEST(MarkError, JoinsAsInTheStandardsExample) {
    // ASPRS Edition 2, table 7.4: fit 1.00 cm, check marks 2.0 cm.
    EXPECT_NEAR(rmseWithMarkError_m(0.0100, 0.020), 0.0224, 0.00005);
}

TEST(AccuracyGroups, HorizontalIsTheRootOfBothAxesSquared) {
    std::vector<Residual> residuals;
    const auto d = unevenDifferences(9);
    for (std::size_t i = 0; i < d.size(); ++i) {
        Residual r = heightResidual(fmt::format("P{}", i), 0.1, MarkRole::Check, Stage::Fused,
                                    Quantity::ArrayPosition);
        r.difference_enu_m = {d[i], 0.5 * d[d.size() - 1 - i], 0.1};
        residuals.push_back(r);
    }
    const AccuracyGroup group = accuracyGroups(residuals, 1).at(0);
    EXPECT_NEAR(group.horizontal->rmse_m, std::hypot(group.east->rmse_m, group.north->rmse_m), kRounding);
    EXPECT_GT(group.horizontal->mean_m, std::hypot(group.east->mean_m, group.north->mean_m));
}

TEST(AccuracyGroups, NeverCountWhatTheEstimatorWasTiedTo) {
    std::vector<Residual> residuals{heightResidual("P1", 0.2, MarkRole::Control),
                                    heightResidual("P2", 9.0, MarkRole::Control)};
    residuals[1].used_by_estimator = true;
    const auto groups = accuracyGroups(residuals, 1);
    ASSERT_EQ(groups.size(), 1U);
    EXPECT_EQ(groups[0].up->n, 1U);
    EXPECT_EQ(groups[0].up->rmse_m, 0.2);
    residuals[0].used_by_estimator = true;
    EXPECT_THAT(accuracyGroups(residuals, 1), IsEmpty());
}

TEST(AccuracyGroups, CountEachAxisForItself) {
    std::vector<Residual> residuals{heightResidual("P1", 0.2), heightResidual("P2", 0.3)};
    residuals[0].difference_enu_m.x() = 1.0;
    residuals[1].difference_enu_m.z() = std::numeric_limits<double>::infinity();
    const auto groups = accuracyGroups(residuals, 1);
    ASSERT_EQ(groups.size(), 1U);
    EXPECT_EQ(groups[0].east->n, 1U);
    EXPECT_FALSE(groups[0].north);
    EXPECT_FALSE(groups[0].horizontal);
    EXPECT_EQ(groups[0].up->n, 1U);
}

TEST(AccuracyGroups, StandInOneOrderWhateverTheOrderOfResiduals) {
    std::vector<Residual> residuals{
        heightResidual("a", 1, MarkRole::Control), heightResidual("a", 1),
        heightResidual("a", 1, MarkRole::Check, Stage::Fused, Quantity::NearestSample),
        heightResidual("a", 1, MarkRole::Check, Stage::Fused, Quantity::ArrayPosition),
        heightResidual("a", 1, MarkRole::Check, Stage::BeforeFusion, Quantity::NearestSample)};
    const auto order = [](const std::vector<AccuracyGroup>& groups) {
        std::vector<std::tuple<Stage, Quantity, bool>> keys;
        for (const auto& g : groups) keys.emplace_back(g.stage, g.quantity, g.role == MarkRole::Control);
        return keys;
    };
    const auto keys = order(accuracyGroups(residuals, 1));
    EXPECT_EQ(keys.size(), 5U);
    EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
    std::reverse(residuals.begin(), residuals.end());
    EXPECT_EQ(order(accuracyGroups(residuals, 1)), keys);
}

TEST(AccuracyGroups, CoverageCountsHeightsWithinTheirSigmas) {
    std::vector<Residual> residuals;
    for (const double d : {0.0, 1.9, -1.95, 1.97, -3.0}) {
        residuals.push_back(heightResidual(fmt::format("P{}", residuals.size()), d));
        residuals.back().sigma_enu_m.z() = 1.0;
    }
    residuals.push_back(heightResidual("without sigma", 0.0));
    const SigmaCoverage coverage = accuracyGroups(residuals, 1).at(0).up_coverage.value();
    EXPECT_EQ(coverage.n, 5U);
    EXPECT_EQ(coverage.within, 3U);
}

// ---------------------------------------------------------------------------------------------- statements

TEST(Statements, WithoutMarksSayThatNoAccuracyCanBeStated) {
    const SurveyReport report =
        withAccuracy(exampleReport({.fixed_point_runs = 0, .check_marks = 0, .control_marks = 0}));
    EXPECT_FALSE(report.headline);
    EXPECT_EQ(report.figures.at(0).value, "not known");
    EXPECT_THAT(report.statements, Contains(HasSubstr("No accuracy can be stated: the survey has no marks")));
    EXPECT_THAT(report.limitations, Contains(HasSubstr("no marks measured by total station")));
    EXPECT_THAT(report.limitations.back(), HasSubstr("GNSS base"));
}

TEST(Statements, FewCheckMarksAreCalledAReducedNumber) {
    const SurveyReport report = withAccuracy(exampleReport({.check_marks = 8}));
    EXPECT_THAT(report.statements,
                Contains(AllOf(HasSubstr("reduced number of 7 check marks"), HasSubstr("ask for 30"))));
    EXPECT_THAT(report.limitations, Contains(HasSubstr("small sample")));
}

TEST(Statements, ThirtyCheckMarksAreEnoughButClaimNoClass) {
    // K007 misses the surface, so 31 marks give 30 comparisons and 30 give 29.
    const SurveyReport enough = withAccuracy(exampleReport({.check_marks = 31}));
    EXPECT_THAT(enough.statements,
                Contains(AllOf(HasSubstr("Tested with 30"), HasSubstr("No accuracy class is claimed"))));
    EXPECT_THAT(enough.limitations, Not(Contains(HasSubstr("small sample"))));
    const SurveyReport few = withAccuracy(exampleReport({.check_marks = 30}));
    EXPECT_THAT(few.statements, Contains(HasSubstr("reduced number of 29")));
}

TEST(Statements, ControlMarksAloneCertifyNothing) {
    const SurveyReport report = withAccuracy(exampleReport({.check_marks = 0}));
    EXPECT_FALSE(report.headline);
    EXPECT_FALSE(report.accuracy.empty());
    EXPECT_EQ(report.figures.at(0).value, "not known");
    EXPECT_THAT(report.limitations,
                Contains(AllOf(HasSubstr("No check mark was compared"), HasSubstr("5 control marks"))));
}

TEST(Statements, NameMarksThatCouldNotBeCompared) {
    EXPECT_THAT(withAccuracy(exampleReport({})).limitations,
                Contains("1 check mark lies outside the surface and could not be compared: K007."));
}

TEST(Statements, CompareBeforeAndAfterAtTheSameMarks) {
    SurveyReport report;
    for (const char* mark : {"A", "B", "C"}) {
        report.marks.push_back({mark, {0, 0, 0}, 0.0, 0.0, MarkRole::Check});
        const double before_m = *mark == 'C' ? 100.0 : 1.0;
        report.residuals.push_back(
            heightResidual(mark, before_m, MarkRole::Check, Stage::BeforeFusion, Quantity::SurfaceHeight));
        if (*mark != 'C') report.residuals.push_back(heightResidual(mark, 0.25));
    }
    EXPECT_THAT(
        withAccuracy(report).statements,
        Contains("Before fusion the height RMSE was 1.000 m (surface height); at the same 2 marks it is "
                 "0.250 m now, 75 % less."));
}

TEST(Statements, PointOutABlunderAndABias) {
    SurveyReport report;
    for (int i = 0; i < 40; ++i) {
        const std::string mark = fmt::format("K{}", i);
        report.marks.push_back({mark, {0, 0, 0}, 0.0, 0.0, MarkRole::Check});
        report.residuals.push_back(heightResidual(mark, i == 17 ? -5.0 : i % 2 == 0 ? 0.1 : -0.1));
    }
    EXPECT_THAT(withAccuracy(report).statements, Contains(HasSubstr("K17 is off by -5.000 m")));
    EXPECT_THAT(withAccuracy(report).statements, Not(Contains(HasSubstr("on average"))));
    for (Residual& r : report.residuals) r.difference_enu_m.z() = r.mark == "K1" ? 0.9 : 1.0;
    EXPECT_THAT(withAccuracy(report).statements, Contains(HasSubstr("too high on average")));
    EXPECT_THAT(withAccuracy(report).statements, Not(Contains(HasSubstr("blunder"))));
}

TEST(Nssda, HasTheConstantsOfTheStandard) {
    // FGDC-STD-007.3-1998, appendix 3-A. A gist in circulation has 1.7808.
    EXPECT_NEAR(nssdaVertical_m(0.1), 0.196, 1e-12);
    EXPECT_NEAR(*nssdaHorizontal_m(1.0, 1.0), 1.7308 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(*nssdaHorizontal_m(1.0, 1.0), 2.4477, 5e-5);
    EXPECT_NEAR(*nssdaHorizontal_m(0.6, 1.0), 2.4477 * 0.8, 1e-12);
    EXPECT_NEAR(*nssdaHorizontal_m(1.0, 0.8), 2.4477 * 0.9, 1e-12);
    EXPECT_FALSE(nssdaHorizontal_m(0.59, 1.0));
}

TEST(Nssda, IsStatedOfTwentyCheckMarksAndMore) {
    for (const int n : {19, 20}) {
        SurveyReport report;
        for (int i = 0; i < n; ++i) {
            const std::string mark = fmt::format("K{}", i);
            report.marks.push_back({mark, {0, 0, 0}, 0.0, 0.0, MarkRole::Check});
            report.residuals.push_back(heightResidual(mark, i % 2 == 0 ? 0.1 : -0.1));
        }
        const std::string tested = "Tested 0.196 m vertical accuracy at 95 % confidence level";
        EXPECT_EQ(testing::Matches(Contains(HasSubstr(tested)))(withAccuracy(report).statements), n == 20);
        EXPECT_THAT(withAccuracy(report).statements, Contains(HasSubstr("0.196 m vertical accuracy")));
    }
}

TEST(Blunders, OneIsFlaggedInASmallGroupAndStillCounted) {
    // In a group of six no difference can pass 3 times an RMSE that it belongs to: sqrt(6) < 3.
    std::vector<Residual> residuals;
    for (int i = 0; i < 6; ++i) {
        residuals.push_back(heightResidual(fmt::format("K{}", i), i == 2 ? 2.0 : i % 2 == 0 ? 0.1 : -0.1));
    }
    const auto flagged = withBlundersFlagged(residuals);
    for (const Residual& r : flagged) EXPECT_EQ(r.possible_blunder, r.mark == "K2") << r.mark;
    EXPECT_EQ(accuracyGroups(flagged, 1).front().up->n, 6U);
    residuals.resize(4);
    for (const Residual& r : withBlundersFlagged(residuals)) EXPECT_FALSE(r.possible_blunder);
}

TEST(SlopeLeakage, IsPlanErrorTimesSlope) {
    std::vector<Residual> residuals;
    for (int i = 0; i < 10; ++i) {
        Residual stand = heightResidual(fmt::format("K{}", i), 0.0, MarkRole::Check, Stage::Fused,
                                        Quantity::ArrayPosition);
        stand.difference_enu_m = {i % 2 == 0 ? 0.3 : -0.3, i % 2 == 0 ? -0.4 : 0.4, 0.0};
        residuals.push_back(stand);
        residuals.push_back(heightResidual(stand.mark, 0.5));
        residuals.back().slope = 0.4;
    }
    const auto groups = accuracyGroups(residuals, 1);
    const AccuracyGroup& surface = groups.at(*headlineGroup(groups));
    const auto leakage = slopeLeakage(residuals, groups, surface);
    ASSERT_TRUE(leakage);
    const double plan_m = std::sqrt((0.09 + 0.16) / 2.0);
    EXPECT_NEAR(leakage->plan_rmse_m, plan_m, 1e-12);
    EXPECT_NEAR(leakage->rmse_m, 0.4 * plan_m, 1e-12);
    EXPECT_NEAR(leakage->share, std::pow(0.4 * plan_m / 0.5, 2.0), 1e-12);
    for (Residual& r : residuals) r.slope = kMissing;
    EXPECT_FALSE(slopeLeakage(residuals, groups, surface));
}

TEST(SlopeLeakage, WhatIsMissingForItIsTold) {
    SurveyReport report;
    for (const char* mark : {"A", "B"}) {
        report.marks.push_back({mark, {0, 0, 0}, 0.0, 0.0, MarkRole::Check});
        report.residuals.push_back(heightResidual(mark, 0.1));
        report.residuals.back().slope = 0.3;
    }
    const SurveyReport made = withAccuracy(report);
    EXPECT_FALSE(made.slope_leakage);
    EXPECT_THAT(made.slope_leakage_unknown, HasSubstr("no run stood on a mark"));
    EXPECT_THAT(made.limitations, Contains(AllOf(HasSubstr("What errors in plan add to errors of height"),
                                                 HasSubstr("no run stood on a mark"))));
    for (Residual& r : report.residuals) r.slope = kMissing;
    EXPECT_THAT(withAccuracy(report).limitations, Not(Contains(HasSubstr("errors in plan"))));
}

/// A surface that is off by 4 cm up and down at check marks known to a centimetre.
SurveyReport testedReport(int check_marks, double class_m) {
    SurveyReport report;
    report.vertical_class_m = class_m;
    for (int i = 0; i < check_marks; ++i) {
        report.marks.push_back({fmt::format("K{}", i), {0, 0, 0}, 0.01, 0.01, MarkRole::Check});
        report.residuals.push_back(heightResidual(report.marks.back().name, i % 2 == 0 ? 0.04 : -0.04));
    }
    return report;
}

TEST(VerticalClass, IsMetByThirtyCheckMarksWithTheirOwnError) {
    const double found_m = std::hypot(0.04, 0.01);  // ASPRS Edition 2, section 7.11
    for (const double class_m : {found_m - 1e-6, found_m + 1e-6}) {
        const SurveyReport report = withAccuracy(testedReport(30, class_m));
        ASSERT_TRUE(report.class_test);
        EXPECT_NEAR(report.class_test->rmse_v_m, found_m, 1e-12);
        EXPECT_EQ(report.class_test->met(), class_m > found_m);
    }
    EXPECT_THAT(
        withAccuracy(testedReport(30, 0.05)).statements,
        Contains(
            "This data set was tested to meet ASPRS Positional Accuracy Standards for Digital "
            "Geospatial Data, Edition 2, Version 2 (2024) for a 5 cm RMSE_V Vertical Accuracy Class. The "
            "Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = 4.12 cm."));
    const auto never = Not(Contains(HasSubstr("tested to meet")));
    EXPECT_THAT(withAccuracy(testedReport(30, 0.025)).statements,
                AllOf(never, Contains(HasSubstr("does not meet the 2.5 cm RMSE_V Vertical Accuracy Class"))));
    EXPECT_THAT(withAccuracy(testedReport(30, 0.0)).statements,
                AllOf(never, Contains(HasSubstr("No accuracy class is claimed"))));
    const SurveyReport few = withAccuracy(testedReport(29, 0.05));
    EXPECT_FALSE(few.class_test->met());
    EXPECT_THAT(few.statements,
                AllOf(never, Contains(AllOf(HasSubstr("using ONLY 29 checkpoints"),
                                            HasSubstr("RMSE_V = 4.12 cm using the reduced number "
                                                      "of checkpoints, within the 5 cm")))));
}

TEST(VerticalClass, IsNotTestedByMarksThatAreUnsureOrAmongPlants) {
    const auto never = Not(Contains(HasSubstr("tested to meet")));
    SurveyReport unsure = testedReport(30, 0.06);
    for (ControlMark& mark : unsure.marks) mark.sigma_v_m = 0.031;
    EXPECT_THAT(withAccuracy(unsure).statements,
                AllOf(never, Contains(HasSubstr("own error of 3.10 cm is more than half of the 6 cm"))));
    SurveyReport unknown = testedReport(30, 0.06);
    for (ControlMark& mark : unknown.marks) mark.sigma_v_m = 0.0;
    EXPECT_THAT(withAccuracy(unknown).limitations, Contains(HasSubstr("own error is not known")));
    SurveyReport planted = testedReport(40, 0.05);
    for (std::size_t i = 0; i < 11; ++i) {
        planted.residuals[i].cover = GroundCover::Vegetated;
        planted.residuals[i].difference_enu_m.z() = 0.5;
    }
    EXPECT_THAT(
        withAccuracy(planted).statements,
        AllOf(never, Contains(HasSubstr("ONLY 29 checkpoints")),
              Contains("The Vegetated Vertical Accuracy (VVA) was found to be RMSE_V = 50.01 cm at 11 "
                       "check marks.")));
}

TEST(VerticalClass, DecidesWhatIsABlunderAndABias) {
    SurveyReport report = testedReport(30, 0.05);
    report.residuals[3].difference_enu_m.z() = 0.151;
    report.residuals[4].difference_enu_m.z() = 0.149;
    const SurveyReport made = withAccuracy(report);
    for (const Residual& r : made.residuals) EXPECT_EQ(r.possible_blunder, r.mark == "K3") << r.mark;
    EXPECT_THAT(made.statements, Contains(HasSubstr("K3 is off by +0.151 m, more than 3 times the RMSE_V")));
    for (Residual& r : report.residuals) r.difference_enu_m.z() += 0.013;
    EXPECT_THAT(withAccuracy(report).statements, Contains(HasSubstr("more than a quarter of the RMSE_V")));
    EXPECT_THAT(made.statements, Not(Contains(HasSubstr("more than a quarter"))));
}

TEST(Statements, TiedComparisonsAreNamedAsNotCounted) {
    SurveyReport report = exampleReport({});
    report.residuals.front().used_by_estimator = true;
    EXPECT_THAT(withAccuracy(report).limitations,
                Contains(HasSubstr("tied to the mark or tuned on it in 1 comparison;")));
}

}  // namespace
}  // namespace terrawalk
