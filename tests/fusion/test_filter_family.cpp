#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "fusion/filter_family.hpp"
#include "fusion/fuse_run.hpp"
#include "fusion/unscented_transform.hpp"
#include "tests/fusion/made_run.hpp"
#include "tests/fusion/measured_survey.hpp"

namespace terrawalk {
namespace {

constexpr std::array kAllFilters{FilterKind::Ekf, FilterKind::Ckf, FilterKind::Ukf, FilterKind::SquareRootUkf,
                                 FilterKind::AdaptiveUkf};

AukfOptions with(FilterKind filter) {
    AukfOptions options;
    options.filter = filter;
    return options;
}

MeasuredRun withoutYaw(MeasuredRun run) {
    for (MeasurementEpoch& epoch : run.epochs) {
        epoch.present =
            static_cast<RowSet>(epoch.present & ~rowBit(static_cast<std::size_t>(MeasurementRow::Yaw)));
    }
    return run;
}

double farthestApart(const FilteredRun& a, const FilteredRun& b) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < a.states.size(); ++i) {
        farthest = std::max(farthest, (a.states[i].mean - b.states[i].mean).lpNorm<Eigen::Infinity>());
    }
    return farthest;
}

TEST(PositioningModel, MovesUnderConstantAcceleration) {
    Vector9d x;
    x << 1.0, -2.0, 0.5, 10.0, 20.0, 30.0, 0.2, 0.4, -0.6;
    const Vector9d moved = constantAccelerationMatrix(2.0) * x;
    Vector9d expected;
    expected << 1.4, -1.2, -0.7, 10.0 + 2.0 + 0.4, 20.0 - 4.0 + 0.8, 30.0 + 1.0 - 1.2, 0.2, 0.4, -0.6;
    EXPECT_LT((moved - expected).norm(), 1e-14);
    // Two steps of half the length are one step.
    const Matrix9d half = constantAccelerationMatrix(1.0);
    EXPECT_LT((half * half - constantAccelerationMatrix(2.0)).norm(), 1e-14);
}

TEST(PositioningModel, AddsTheStepNoiseInShares) {
    AukfOptions options;
    options.noise.position_e_m2 = 0.3;
    options.noise.velocity_n_m2ps2 = 0.7;
    const Vector9d q = stepNoiseDiagonal(options, options.nominal_interval_s);
    EXPECT_DOUBLE_EQ(q[3], 0.3);
    EXPECT_DOUBLE_EQ(q[1], 0.7);
    EXPECT_DOUBLE_EQ(q[8], 0.01);
    EXPECT_LT((2.5 * q - stepNoiseDiagonal(options, 2.5 * options.nominal_interval_s)).norm(), 1e-15);
}

// Exact sensors: every row says what the truth is.
TEST(PositioningModel, ReadsTheTruthFromExactSensors) {
    MadeOptions made_options;
    made_options.errors = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    made_options.gnss_lever_arm_m = {0.1, -0.2, 0.3};
    const MadeRun made = makeRun(made_options);
    const MeasuredRun run = measured(made.survey, made.run(), {});
    ASSERT_EQ(run.epochs.size(), made.position_enu_m.size());
    EXPECT_LT((run.start.block(StateBlock::Position) - made.position_enu_m[0]).norm(), 1e-6);
    for (std::size_t i = 1; i < run.epochs.size(); ++i) {
        const MeasurementEpoch& epoch = run.epochs[i];
        EXPECT_NEAR(epoch.dt_s, 0.2, 1e-9);
        ASSERT_EQ(epoch.present, 0x1FF) << i;
        const auto z = [&](MeasurementRow row) {
            return epoch.z[static_cast<std::size_t>(row)];
        };
        const Eigen::Vector3d& p = made.position_enu_m[i];
        const Eigen::Vector3d& v = made.velocity_enu_mps[i];
        EXPECT_NEAR(z(MeasurementRow::GnssEast), p.x(), 1e-6);
        EXPECT_NEAR(z(MeasurementRow::GnssNorth), p.y(), 1e-6);
        EXPECT_NEAR(z(MeasurementRow::BarometerUp), p.z(), 1e-3);  // the level surface sinks away
        EXPECT_NEAR(z(MeasurementRow::FlowEast), v.x(), 1e-9);
        EXPECT_NEAR(z(MeasurementRow::FlowNorth), v.y(), 1e-9);
        EXPECT_NEAR(z(MeasurementRow::Yaw), radians(30.0), 1e-9);
        const Eigen::Vector3d acceleration = (v - made.velocity_enu_mps[i - 1]) / 0.2;
        EXPECT_NEAR(z(MeasurementRow::AccelerationEast), acceleration.x(), 1e-6);
        EXPECT_NEAR(z(MeasurementRow::AccelerationNorth), acceleration.y(), 1e-6);
        EXPECT_NEAR(z(MeasurementRow::AccelerationUp), acceleration.z(), 1e-6);
    }
}

TEST(PositioningModel, LeavesOutWhatIsMissing) {
    MadeRun made = makeRun();
    made.log().column(Channel::Pressure)[40] = kMissing;
    made.log().column(Channel::FlowLeft)[41] = kMissing;
    made.log().column(Channel::Fix)[42] = fix_code::kNone;
    made.log().column(Channel::AccelerationY)[43] = kMissing;
    const MeasuredRun run = measured(made.survey, made.run(), {});
    const auto has = [&](std::size_t i, MeasurementRow row) {
        return run.epochs[i].has(row);
    };
    EXPECT_FALSE(has(40, MeasurementRow::BarometerUp));
    EXPECT_FALSE(has(41, MeasurementRow::FlowEast));
    EXPECT_FALSE(has(41, MeasurementRow::FlowNorth));
    EXPECT_FALSE(has(42, MeasurementRow::GnssEast));
    EXPECT_FALSE(has(43, MeasurementRow::AccelerationUp));
    EXPECT_EQ(run.epochs[44].present, 0x1FF);
}

// The height row is never left without a source.
TEST(PositioningModel, FindsAnotherHeightWhereThereIsNoBarometer) {
    constexpr auto kUp = static_cast<std::size_t>(MeasurementRow::BarometerUp);
    MadeOptions made_options;
    made_options.errors = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    MadeRun made = makeRun(made_options);
    made.erase(Channel::Pressure);
    const MeasuredRun by_gnss = measured(made.survey, made.run(), {});
    EXPECT_EQ(by_gnss.sensors[kUp], Sensor::GnssHeight);
    EXPECT_NEAR(by_gnss.epochs[100].z[kUp], made.position_enu_m[100].z(), 1e-6);
    made.erase(Channel::EllipsoidalHeight);
    const MeasuredRun assumed = measured(made.survey, made.run(), {});
    EXPECT_EQ(assumed.sensors[kUp], Sensor::HeightAssumption);
    EXPECT_NEAR(assumed.epochs[100].z[kUp], made.position_enu_m[0].z(), 1e-6);
    EXPECT_GE(assumed.epochs[100].variance[kUp], 1.0);
}

TEST(PositioningModel, TakesTheMountOffsetFromTheYaw) {
    FusionOptions options;
    options.aukf.yaw_row.mount_offset_deg = 20.0;
    const MadeRun made = makeRun();
    const MeasuredRun run = measured(made.survey, made.run(), options);
    EXPECT_NEAR(run.epochs[5].z[static_cast<std::size_t>(MeasurementRow::Yaw)], radians(10.0), 1e-9);
}

// Without the yaw row all is linear, and what the four do is the Kalman filter.
TEST(FilterFamily, AgreesWhereAllIsLinear) {
    const MadeRun made = makeRun();
    const MeasuredRun run = withoutYaw(measured(made.survey, made.run(), {}));
    const auto ekf = filterRun(run, with(FilterKind::Ekf));
    ASSERT_TRUE(ekf);
    for (const FilterKind filter : {FilterKind::Ckf, FilterKind::Ukf, FilterKind::SquareRootUkf}) {
        const auto other = filterRun(run, with(filter));
        ASSERT_TRUE(other);
        EXPECT_LT(farthestApart(*ekf, *other), 1e-9);
        for (std::size_t i = 0; i < run.epochs.size(); ++i) {
            ASSERT_LT((ekf->states[i].covariance - other->states[i].covariance).norm(), 1e-9);
        }
    }
}

// With the yaw row the square-root form is still the same filter, the others are not.
TEST(FilterFamily, DiffersByTheYawRowAlone) {
    const MadeRun made = makeRun();
    const MeasuredRun run = measured(made.survey, made.run(), {});
    const auto ukf = filterRun(run, with(FilterKind::Ukf));
    const auto root = filterRun(run, with(FilterKind::SquareRootUkf));
    const auto ekf = filterRun(run, with(FilterKind::Ekf));
    const auto ckf = filterRun(run, with(FilterKind::Ckf));
    ASSERT_TRUE(ukf && root && ekf && ckf);
    EXPECT_LT(farthestApart(*ukf, *root), 1e-9);
    EXPECT_GT(farthestApart(*ukf, *ekf), 1e-6);
    EXPECT_GT(farthestApart(*ukf, *ckf), 1e-6);
}

// The cubature rule: 18 points of equal weight, none in the centre.
TEST(FilterFamily, CubatureIsTheTransformWithoutACentreWeight) {
    const UnscentedOptions points = sigmaPointOptions(with(FilterKind::Ckf));
    const double spread = sigmaPointSpread(points, 9);
    EXPECT_DOUBLE_EQ(spread, 9.0);  // sqrt(n) columns
    const double lambda = spread - 9.0;
    EXPECT_DOUBLE_EQ(lambda / spread, 0.0);                                                    // mean
    EXPECT_DOUBLE_EQ(lambda / spread + 1.0 - points.alpha * points.alpha + points.beta, 0.0);  // covariance
}

TEST(FilterFamily, KeepsTheCovariancePositiveDefinite) {
    SimulationOptions simulation;
    simulation.fixed_point_runs = 0;
    simulation.control_stops = 0;
    simulation.area_east_m = 25.0;
    simulation.area_north_m = 30.0;
    simulation.area_epochs = 2000;
    simulation.faults = FaultLevel::Severe;
    const SimulatedSurvey simulated = simulatedSurvey(simulation);
    const MeasuredRun run = measured(simulated.survey, simulated.survey.runs.front(), {});
    for (const FilterKind filter : kAllFilters) {
        for (const double log10_noise : {-8.0, 1.0}) {
            AukfOptions options = with(filter);
            const double q = std::pow(10.0, log10_noise);
            options.noise = {q, q, q, q, q, q, q, q, q};
            const auto filtered = filterRun(run, options);
            ASSERT_TRUE(filtered) << filtered.error().text();
            for (std::size_t i = 0; i < filtered->states.size(); i += 97) {
                const Eigen::SelfAdjointEigenSolver<Matrix9d> eigen(filtered->states[i].covariance);
                ASSERT_GT(eigen.eigenvalues().minCoeff(), 0.0) << i;
            }
        }
    }
}

// White noise of the stated size in a model that holds: innovations and errors are as large as they say. The
// mean of n chi-square numbers of m degrees has the variance 2 m / n; errors of a track hang together, which
// widens that of the NEES by the correlation time.
TEST(FilterFamily, IsConsistentOnItsOwnModel) {
    NormalNumbers normal(5);
    AukfOptions options;
    options.noise = {1e-4, 1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-2, 1e-2, 1e-2};
    MeasuredRun run;
    run.run_id = "model";
    run.start.covariance = Matrix9d::Identity();
    run.start.mean.head<2>() << 4.0, 3.0;  // fast, so that the course is nearly linear
    Vector9d x = run.start.mean;
    for (int i = 0; i < 9; ++i) x[i] += normal();
    const Matrix9d F = constantAccelerationMatrix(0.2);
    const Vector9d sigma = stepNoiseDiagonal(options, 0.2).cwiseSqrt();
    std::vector<Vector9d> truth;
    for (std::size_t i = 0; i < 4000; ++i) {
        MeasurementEpoch epoch;
        epoch.dt_s = i == 0 ? 0.0 : 0.2;
        if (i > 0) {
            x = F * x;
            for (int k = 0; k < 9; ++k) x[k] += sigma[k] * normal();
        }
        truth.push_back(x);
        for (std::size_t row = 0; row < kRowCount; ++row) {
            const double variance = row < 2 ? 1.0 : row == 5 ? 0.03 : 0.09;
            const int k = kStateOfRow[row];
            const double noise = std::sqrt(variance) * normal();
            epoch.set(static_cast<MeasurementRow>(row),
                      k == kNoState ? wrapAngle(std::atan2(x[1], x[0]) + noise) : x[k] + noise, variance);
        }
        run.epochs.push_back(epoch);
    }
    for (const FilterKind filter :
         {FilterKind::Ekf, FilterKind::Ckf, FilterKind::Ukf, FilterKind::SquareRootUkf}) {
        options.filter = filter;
        const auto filtered = filterRun(run, options);
        ASSERT_TRUE(filtered);
        ASSERT_EQ(filtered->consistency.size(), 5U);
        for (const SensorConsistency& sensor : filtered->consistency) {
            const double bound = 5.0 * std::sqrt(2.0 * sensor.dof / static_cast<double>(sensor.n));
            EXPECT_NEAR(sensor.mean_nis, sensor.dof, bound) << sensor.sensor;
        }
        double nees = 0.0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Vector9d d = filtered->states[i].mean - truth[i];
            nees += d.dot(filtered->states[i].covariance.ldlt().solve(d)) / static_cast<double>(truth.size());
        }
        EXPECT_NEAR(nees, 9.0, 5.0 * std::sqrt(2.0 * 9.0 / 4000.0 * 25.0));
    }
}

// GNSS with five times the noise that its table says: the adaptive filter finds out, the fixed one does not.
TEST(FilterFamily, AdaptsToNoiseThatIsLargerThanStated) {
    MadeOptions made_options;
    made_options.epochs = 3000;
    made_options.errors.gnss_m = 5.0 * GnssOptions{}.sigma_single_m;
    const MadeRun made = makeRun(made_options);
    const MeasuredRun run = measured(made.survey, made.run(), {});
    const auto rmse = [&](const FilteredRun& filtered) {
        double sum = 0.0;
        for (std::size_t i = 0; i < filtered.states.size(); ++i) {
            sum += (filtered.states[i].block(StateBlock::Position) - made.position_enu_m[i])
                       .head<2>()
                       .squaredNorm();
        }
        return std::sqrt(sum / static_cast<double>(filtered.states.size()));
    };
    const auto nis = [](const FilteredRun& filtered) {
        for (const SensorConsistency& sensor : filtered.consistency) {
            if (sensor.sensor == "GNSS position") return sensor.mean_nis / sensor.dof;
        }
        return kMissing;
    };
    const auto fixed = filterRun(run, with(FilterKind::Ukf));
    const auto adaptive = filterRun(run, with(FilterKind::AdaptiveUkf));
    ASSERT_TRUE(fixed && adaptive);
    EXPECT_GT(nis(*fixed), 5.0);
    EXPECT_LT(nis(*adaptive), 2.0);
    EXPECT_LT(rmse(*adaptive), 0.8 * rmse(*fixed));
}

// A reading beyond the greatest noise is left out, and only that one row.
TEST(FilterFamily, AdaptiveFilterSkipsWhatNoNoiseExplains) {
    const MadeRun made = makeRun();
    MeasuredRun run = measured(made.survey, made.run(), {});
    run.epochs[100].z[static_cast<std::size_t>(MeasurementRow::GnssNorth)] += 1000.0;
    const auto filtered = filterRun(run, with(FilterKind::AdaptiveUkf));
    ASSERT_TRUE(filtered);
    const RowSet north = rowBit(static_cast<std::size_t>(MeasurementRow::GnssNorth));
    EXPECT_EQ(filtered->used[100], run.epochs[100].present & ~north);
    EXPECT_EQ(filtered->used[99], run.epochs[99].present);
}

TEST(FilterFamily, LeavesTheYawRowOutAtRest) {
    MadeOptions made_options;
    made_options.speed_mps = 0.0;
    made_options.errors.flow_mps = 0.01;
    const MadeRun made = makeRun(made_options);
    const MeasuredRun run = measured(made.survey, made.run(), {});
    for (const FilterKind filter : kAllFilters) {
        const auto filtered = filterRun(run, with(filter));
        ASSERT_TRUE(filtered);
        const RowSet yaw = rowBit(static_cast<std::size_t>(MeasurementRow::Yaw));
        for (const RowSet used : filtered->used) ASSERT_EQ(used & yaw, 0);
    }
}

TEST(FilterFamily, SaysWhenItDiverges) {
    const MadeRun made = makeRun();
    MeasuredRun run = measured(made.survey, made.run(), {});
    run.start.mean[0] = kMissing;
    for (const FilterKind filter : kAllFilters) {
        const auto filtered = filterRun(run, with(filter));
        ASSERT_FALSE(filtered);
        EXPECT_EQ(filtered.error().kind, ErrorKind::BadData);
        EXPECT_NE(filtered.error().text().find("diverged"), std::string::npos);
    }
}

TEST(FilterFamily, StopsWhenAsked) {
    const MadeRun made = makeRun();
    const MeasuredRun run = measured(made.survey, made.run(), {});
    std::stop_source source;
    source.request_stop();
    const auto filtered = filterRun(run, {}, source.get_token());
    ASSERT_FALSE(filtered);
    EXPECT_EQ(filtered.error().kind, ErrorKind::Cancelled);
}

TEST(AukfMethod, TellsSigmasSensorsAndConsistency) {
    const MadeRun made = makeRun();
    FusionOptions options;
    options.method = FusionMethod::Aukf;
    SilentProgress progress;
    const auto fused = fuseRun(made.survey, made.run(), options, progress, {});
    ASSERT_TRUE(fused) << fused.error().text();
    ASSERT_EQ(fused->trajectory.epochs.size(), made.run().log.size());
    const auto filtered = filterRun(measured(made.survey, made.run(), options), options.aukf);
    ASSERT_TRUE(filtered);
    const TrajectoryEpoch& epoch = fused->trajectory.epochs[150];
    EXPECT_EQ(epoch.position_enu_m, filtered->states[150].block(StateBlock::Position));
    EXPECT_EQ(epoch.covariance(2, 2), filtered->states[150].covariance(5, 5));
    EXPECT_EQ(epoch.covariance(0, 3), filtered->states[150].covariance(3, 0));
    std::size_t slow = 0;
    for (const SensorUse& use : fused->sensors) {
        std::size_t rejected = 0;
        for (const auto& rejection : use.rejections) rejected += rejection.count;
        EXPECT_EQ(use.offered, made.run().log.size()) << use.sensor;
        EXPECT_EQ(use.offered, use.used + rejected) << use.sensor;
        if (use.sensor == "heading row") slow = rejected;
    }
    EXPECT_EQ(fused->sensors.size(), 5U);
    EXPECT_GT(slow, 20U);  // it stands for three seconds at either end
    EXPECT_EQ(fused->consistency.size(), 5U);
}

// It is forward only: what comes later changes nothing before.
TEST(AukfMethod, LooksForwardOnly) {
    MadeRun made = makeRun();
    FusionOptions options;
    options.method = FusionMethod::Aukf;
    SilentProgress progress;
    const auto before = fuseRun(made.survey, made.run(), options, progress, {});
    for (std::size_t i = 200; i < made.log().size(); ++i) made.log().column(Channel::FlowForward)[i] += 1.0;
    const auto after = fuseRun(made.survey, made.run(), options, progress, {});
    ASSERT_TRUE(before && after);
    EXPECT_EQ(before->trajectory.epochs[199].position_enu_m, after->trajectory.epochs[199].position_enu_m);
    EXPECT_NE(before->trajectory.epochs[201].position_enu_m, after->trajectory.epochs[201].position_enu_m);
}

}  // namespace
}  // namespace terrawalk
