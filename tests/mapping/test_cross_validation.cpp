#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <cmath>

#include "mapping/cross_validation.hpp"
#include "tests/mapping/terrain_points.hpp"

namespace terrawalk {
namespace {

using test::Points;
using test::RandomNumbers;
using Method = InterpolationMethod;

Result<CrossValidation> validate(const Points& points, const CrossValidationOptions& options) {
    SilentProgress progress;
    return crossValidate(points, {}, {}, options, progress, {});
}

const HoldOutResult& resultOf(const CrossValidation& validation, HoldOut hold_out) {
    for (const HoldOutResult& result : validation.results) {
        if (result.hold_out == hold_out) return result;
    }
    ADD_FAILURE() << "no result of " << name(hold_out);
    return validation.results.front();
}

Points hills(std::size_t count, std::uint64_t seed) {
    Points points = test::randomPoints(count, 50.0, seed);
    for (Eigen::Vector3d& p : points) p.z() = std::sin(p.x() / 4.0) * std::cos(p.y() / 5.0);
    return points;
}

// Points left out together must not see one another's absence: the same as one fit for each point.
TEST(CrossValidation, LeavesOutOneByOne) {
    const Points points = hills(300, 1);
    CrossValidationOptions options;
    options.methods = {Method::Linear, Method::NaturalNeighbour, Method::InverseDistance};
    const auto validation = validate(points, options);
    ASSERT_TRUE(validation) << validation.error().text();
    const HoldOutResult& result = resultOf(*validation, HoldOut::LeaveOneOut);
    EXPECT_GT(result.rounds, 5u);
    EXPECT_LT(result.rounds, 150u);

    std::vector<double> squares(3, 0.0);
    std::size_t compared = 0;
    for (std::size_t left_out = 0; left_out < points.size(); ++left_out) {
        Points others = points;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
        std::vector<double> errors;
        for (const Method method : options.methods) {
            SilentProgress progress;
            const auto surface = fitInterpolator(method, others, {}, {}, progress, {});
            const std::vector<Eigen::Vector2d> place{points[left_out].head<2>()};
            std::vector<HeightEstimate> estimate(1);
            (*surface)->estimate(place, estimate);
            errors.push_back(estimate.front().height_m - points[left_out].z());
        }
        if (!std::isfinite(errors[0])) continue;
        ++compared;
        for (std::size_t m = 0; m < 3; ++m) squares[m] += errors[m] * errors[m];
    }
    EXPECT_EQ(result.compared, compared);
    EXPECT_EQ(result.compared + result.outside, points.size());
    for (std::size_t m = 0; m < 3; ++m) {
        EXPECT_NEAR(result.scores[m].rmse_m, std::sqrt(squares[m] / static_cast<double>(compared)), 1e-9)
            << m;
    }
}

TEST(CrossValidation, KeepsToBreaklinesWhereAMethodFollowsThem) {
    // A step of two metres within two decimetres, and its toe and top edge as lines.
    Points points = test::randomPoints(800, 50.0, 9);
    for (Eigen::Vector3d& p : points) p.z() = 2.0 * std::clamp((p.x() - 24.9) / 0.2, 0.0, 1.0);
    CrossValidationOptions options;
    options.methods = {Method::Linear, Method::Nearest};
    const auto plain = validate(points, options);
    options.breaklines = {{{{24.9, 0.5, 0.0}, {24.9, 49.5, 0.0}}, BreaklineKind::Soft, "toe"},
                          {{{25.1, 0.5, 2.0}, {25.1, 49.5, 2.0}}, BreaklineKind::Soft, "top"}};
    const auto along = validate(points, options);
    ASSERT_TRUE(plain && along) << along.error().text();
    for (const auto& [hold_out, text] : kHoldOuts) {
        const HoldOutResult &without = resultOf(*plain, hold_out), &with = resultOf(*along, hold_out);
        EXPECT_LT(with.scores[0].rmse_m, 0.3 * without.scores[0].rmse_m) << text;
        EXPECT_EQ(with.scores[1].rmse_m, without.scores[1].rmse_m) << text;
    }
}

TEST(CrossValidation, DoesNotDependOnOrderOrThreadsButOnTheSeed) {
    Points points = hills(500, 2);
    CrossValidationOptions options;
    options.seed = 7;
    const auto one = validate(points, options);
    RandomNumbers random(3);
    test::shuffle(points, random);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const auto same = validate(points, options);
    options.seed = 8;
    const auto other = validate(points, options);
    ASSERT_TRUE(one && same && other);
    EXPECT_EQ(one->ranking, same->ranking);
    ASSERT_EQ(one->results.size(), 3u);
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t m = 0; m < one->methods.size(); ++m) {
            EXPECT_EQ(one->results[r].scores[m].rmse_m, same->results[r].scores[m].rmse_m);
            EXPECT_EQ(one->results[r].scores[m].error95_m, same->results[r].scores[m].error95_m);
        }
    }
    EXPECT_NE(one->results[1].scores[0].rmse_m, other->results[1].scores[0].rmse_m);
}

TEST(CrossValidation, RanksSmoothMethodsFirstOnSmoothHillsAndNearestLast) {
    const auto validation = validate(hills(1000, 4), {});
    ASSERT_TRUE(validation);
    ASSERT_EQ(validation->ranking.size(), kInterpolationMethods.size());
    EXPECT_EQ(validation->ranking.back(), Method::Nearest);
    EXPECT_THAT((std::vector{Method::CloughTocher, Method::Kriging, Method::SibsonC1}),
                testing::Contains(validation->ranking.front()));
    // Gaps of five spacings are harder to fill than those of one point.
    const HoldOutScore& block = resultOf(*validation, HoldOut::SpatialBlocks).scores.front();
    const HoldOutScore& single = resultOf(*validation, HoldOut::LeaveOneOut).scores.front();
    EXPECT_GT(block.rmse_m, 1.5 * single.rmse_m);
    EXPECT_NEAR(validation->block_m, 5.0 * 50.0 / std::sqrt(1000.0), 0.4);
}

TEST(CrossValidation, EachPointIsLeftOutOnceInFoldsAndBlocks) {
    const auto validation = validate(hills(500, 5), {});
    ASSERT_TRUE(validation);
    for (const HoldOut hold_out : {HoldOut::RandomFolds, HoldOut::SpatialBlocks}) {
        const HoldOutResult& result = resultOf(*validation, hold_out);
        EXPECT_EQ(result.rounds, 10u);
        EXPECT_EQ(result.compared + result.outside, 500u);
    }
}

TEST(CrossValidation, RefusesWhatCannotBeJudged) {
    EXPECT_EQ(validate(hills(5, 6), {}).error().kind, ErrorKind::BadData);
    EXPECT_EQ(validate({}, {}).error().kind, ErrorKind::BadData);
    CrossValidationOptions options;
    options.folds = 1;
    EXPECT_EQ(validate(hills(50, 6), options).error().kind, ErrorKind::Usage);
    std::stop_source stop;
    stop.request_stop();
    SilentProgress progress;
    const auto cancelled = crossValidate(hills(50, 6), {}, {}, {}, progress, stop.get_token());
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace terrawalk
