#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "fusion/batch_filter_input.hpp"
#include "fusion/batch_filter_lanes.hpp"
#include "fusion/filter_family.hpp"
#include "fusion/fixed_point_loss.hpp"
#include "tests/fusion/measured_survey.hpp"
#include "tests/fusion/normal_numbers.hpp"

namespace terrawalk {
namespace {

constexpr std::array kAllSets{InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2,
                              InstructionSet::Avx512};

// The area walk of the paper's size, with the gaps that mild faults leave in every sensor.
const MeasuredRun& areaWalk() {
    static const MeasuredRun kWalk = [] {
        SimulationOptions simulation;
        simulation.fixed_point_runs = 0;
        simulation.control_stops = 0;
        const SimulatedSurvey simulated = simulatedSurvey(simulation);
        return measured(simulated.survey, simulated.survey.runs.front(), {});
    }();
    return kWalk;
}

MeasuredRun withoutRows(MeasuredRun run, RowSet rows) {
    for (MeasurementEpoch& epoch : run.epochs) epoch.present = static_cast<RowSet>(epoch.present & ~rows);
    return run;
}

// Candidates that differ from one another by orders of magnitude.
std::vector<AukfOptions> someCandidates(std::size_t n, const AukfOptions& options) {
    NormalNumbers normal(7);
    std::vector<AukfOptions> candidates;
    for (std::size_t i = 0; i < n; ++i) {
        std::array<double, kNoiseDimensions> log10_noise{};
        for (double& q : log10_noise) q = -2.0 + normal();
        candidates.push_back(withCandidate(options, log10_noise));
    }
    return candidates;
}

std::vector<double> track(InstructionSet set, const MeasuredRun& run,
                          const std::vector<AukfOptions>& options) {
    const std::vector<BatchEpoch> epochs = batchEpochs(run, options.front());
    std::vector<BatchCandidate> candidates;
    for (const AukfOptions& o : options) candidates.push_back(batchCandidate(o));
    std::vector<double> sum(3 * options.size());
    std::vector<double> positions(3 * options.size() * epochs.size());
    filterBatch(set, batchRun(run, epochs, options.front()), candidates.data(), candidates.size(), sum.data(),
                positions.data());
    return positions;
}

// Largest distance between the kernel's track and that of the full filter.
double farthestApart(const MeasuredRun& run, const AukfOptions& options) {
    const auto full = filterRun(run, options);
    if (!full) {
        ADD_FAILURE() << full.error().text();
        return std::numeric_limits<double>::infinity();
    }
    const std::vector<double> positions = track(widestInstructionSet(), run, {options});
    double farthest = 0.0;
    for (std::size_t i = 0; i < run.epochs.size(); ++i) {
        const Eigen::Map<const Eigen::Vector3d> position(&positions[3 * i]);
        const double apart = (full->states[i].block(StateBlock::Position) - position).norm();
        if (!(apart <= farthest)) farthest = apart;  // a NaN stays
    }
    return farthest;
}

// Nine states and 19 sigma points against six and three: the same numbers but for rounding, which the walk's
// 9141 steps hold near 1e-10 m; with alpha = 0.1 the sums over sigma points lose two digits more.
TEST(BatchFilter, EqualsTheFullSigmaPointFilterOverAnAreaWalk) {
    ASSERT_EQ(areaWalk().epochs.size(), 9141U);
    for (const double alpha : {1.0, 0.1}) {
        AukfOptions options;
        options.unscented.alpha = alpha;
        EXPECT_LT(farthestApart(areaWalk(), options), 1e-6) << "alpha " << alpha;
    }
}

TEST(BatchFilter, EqualsTheFullFilterWithoutSomeOfTheRows) {
    const auto bit = [](MeasurementRow row) {
        return rowBit(static_cast<std::size_t>(row));
    };
    for (const RowSet missing :
         {bit(MeasurementRow::Yaw),
          static_cast<RowSet>(bit(MeasurementRow::FlowEast) | bit(MeasurementRow::FlowNorth)),
          static_cast<RowSet>(bit(MeasurementRow::AccelerationEast) | bit(MeasurementRow::AccelerationUp))}) {
        EXPECT_LT(farthestApart(withoutRows(areaWalk(), missing), {}), 1e-6) << missing;
    }
}

TEST(BatchFilter, EqualsTheFullExtendedAndCubatureFilters) {
    for (const FilterKind filter : {FilterKind::Ekf, FilterKind::Ckf}) {
        AukfOptions options;
        options.filter = filter;
        EXPECT_LT(farthestApart(areaWalk(), options), 1e-6);
    }
}

// The yaw row does something, or the comparisons above would prove little.
TEST(BatchFilter, FeelsTheYawRowAndItsSpread) {
    const auto ends = [](const MeasuredRun& run, const AukfOptions& options) {
        const std::vector<double> positions = track(InstructionSet::Scalar, run, {options});
        return Eigen::Vector3d(positions.end()[-3], positions.end()[-2], positions.end()[-1]);
    };
    AukfOptions narrow;
    narrow.unscented.alpha = 0.1;
    const MeasuredRun no_yaw = withoutRows(areaWalk(), rowBit(static_cast<std::size_t>(MeasurementRow::Yaw)));
    EXPECT_GT((ends(areaWalk(), {}) - ends(no_yaw, {})).norm(), 1e-3);
    EXPECT_GT((ends(areaWalk(), {}) - ends(areaWalk(), narrow)).norm(), 1e-6);
}

TEST(BatchFilter, GivesTheSameBitsOnEveryInstructionSet) {
    const std::vector<AukfOptions> candidates = someCandidates(8, {});
    const std::vector<double> expected = [&] {
        std::vector<double> positions(3 * 8 * areaWalk().epochs.size());
        for (std::size_t c = 0; c < 8; ++c) {
            const std::vector<double> one = track(InstructionSet::Scalar, areaWalk(), {candidates[c]});
            for (std::size_t i = 0; i < areaWalk().epochs.size(); ++i) {
                std::copy_n(&one[3 * i], 3, &positions[3 * (8 * i + c)]);
            }
        }
        return positions;
    }();
    for (const InstructionSet set : kAllSets) {
        if (!available(set)) continue;
        const std::size_t lanes = laneCount(set);
        for (std::size_t first = 0; first < 8; first += lanes) {
            const std::vector<AukfOptions> group(
                candidates.begin() + static_cast<std::ptrdiff_t>(first),
                candidates.begin() + static_cast<std::ptrdiff_t>(first + lanes));
            const std::vector<double> positions = track(set, areaWalk(), group);
            for (std::size_t i = 0; i < areaWalk().epochs.size(); ++i) {
                ASSERT_EQ(std::memcmp(&positions[3 * lanes * i], &expected[3 * (8 * i + first)],
                                      3 * lanes * sizeof(double)),
                          0)
                    << name(set) << ", epoch " << i << ", candidates from " << first;
            }
        }
    }
}

// A group that is not full gives its candidates the same as a full one.
TEST(BatchFilter, FillsIncompleteGroups) {
    const std::vector<AukfOptions> candidates = someCandidates(3, {});
    for (const InstructionSet set : kAllSets) {
        if (!available(set) || laneCount(set) < 4) continue;
        const std::vector<double> three = track(set, areaWalk(), candidates);
        for (std::size_t c = 0; c < 3; ++c) {
            const std::vector<double> one = track(InstructionSet::Scalar, areaWalk(), {candidates[c]});
            EXPECT_EQ(std::memcmp(&three[three.size() - 9 + 3 * c], &one[one.size() - 3], 3 * sizeof(double)),
                      0);
        }
    }
}

TEST(BatchFilter, TellsDivergenceByWhatIsNotFinite) {
    MeasuredRun run = areaWalk();
    run.epochs.resize(50);
    run.start.covariance(0, 0) = -1.0;  // no covariance
    const std::vector<BatchEpoch> epochs = batchEpochs(run, {});
    for (const InstructionSet set : kAllSets) {
        if (!available(set)) continue;
        std::vector<BatchEpoch> at_target = epochs;
        at_target.back().at_target = 1;
        run.start.mean.head<2>() << 1.0, 0.5;  // moving, so that the yaw row is taken
        std::array<double, 3> sum{};
        const BatchCandidate candidate = batchCandidate({});
        filterBatch(set, batchRun(run, at_target, {}), &candidate, 1, sum.data(), nullptr);
        EXPECT_FALSE(std::isfinite(sum[0])) << name(set);
    }
}

TEST(ArcTangent, StaysWithinTwoUnitsInTheLastPlace) {
    NormalNumbers normal(3);
    const auto check = [](double y, double x) {
        const double exact = std::atan2(y, x);
        const double ulp = std::nextafter(std::abs(exact), 4.0) - std::abs(exact);
        EXPECT_LE(std::abs(lanes::arcTangent<double>(y, x) - exact), 2.0 * ulp) << y << ", " << x;
        EXPECT_EQ(lanes::arcTangent<double>(-y, x), -lanes::arcTangent<double>(y, x));
    };
    for (int i = 0; i < 20000; ++i) {
        const double scale = std::pow(10.0, 3.0 * normal());
        check(normal(), scale * normal());
    }
    for (const double x : {-1.0, 0.0, 1.0}) {
        for (const double y : {1e-300, 1e-12, 0.41421356237309503, 1.0, 1e12}) check(y, x);
    }
    EXPECT_EQ(lanes::arcTangent<double>(0.0, 1.0), 0.0);
    EXPECT_EQ(lanes::arcTangent<double>(0.0, 0.0), 0.0);
    EXPECT_TRUE(std::isnan(lanes::arcTangent<double>(std::nan(""), 1.0)));
    EXPECT_TRUE(std::isnan(lanes::arcTangent<double>(1.0, std::nan(""))));
}

}  // namespace
}  // namespace terrawalk
