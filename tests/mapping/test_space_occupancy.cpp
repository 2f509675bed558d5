#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "mapping/space_occupancy.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using Eigen::Vector3d;

SpaceOccupancy built(const std::vector<LaserRay>& rays, const OccupancyOptions& options = {}) {
    SilentProgress silent;
    auto space = SpaceOccupancy::build(rays, options, silent, {});
    EXPECT_TRUE(space);
    return std::move(*space);
}

const Vector3d kUtm(745645.0, 2565774.0, 38.0);

/// Shots straight down from 1.55 m on every tenth of a metre of a square of two metres at UTM coordinates; a
/// branch 0.85 m above the ground stops those over its one quarter.
std::vector<LaserRay> shotsOverABranch() {
    std::vector<LaserRay> rays;
    for (int i = 0; i < 20; ++i) {
        for (int k = 0; k < 20; ++k) {
            const Vector3d foot = kUtm + Vector3d(0.05 + 0.1 * i, 0.05 + 0.1 * k, 0.05);
            const bool branch = i >= 10 && k >= 10;
            rays.push_back({foot + Vector3d(0, 0, 1.5), foot + Vector3d(0, 0, branch ? 0.8 : 0.0)});
        }
    }
    return rays;
}

OccupancyOptions atUtm() {
    OccupancyOptions options;
    options.origin_m = kUtm;
    return options;
}

TEST(SpaceOccupancy, KnowsTheVoxelsOfARay) {
    const SpaceOccupancy space = built(shotsOverABranch(), atUtm());
    const auto at = [&](double x, double y, double z) {
        return space.at(kUtm + Vector3d(x, y, z));
    };
    for (int k = 1; k <= 15; ++k) EXPECT_EQ(at(0.35, 0.35, 0.05 + 0.1 * k), Space::Free) << k;
    EXPECT_EQ(at(0.35, 0.35, 0.05), Space::Occupied) << "the ground";
    EXPECT_EQ(at(0.35, 0.35, -0.05), Space::Unknown) << "below it";
    EXPECT_EQ(at(0.35, 0.35, 1.85), Space::Unknown) << "above the array";
    EXPECT_EQ(at(1.55, 1.55, 0.85), Space::Occupied) << "the branch";
    EXPECT_EQ(at(1.55, 1.55, 1.15), Space::Free);
    EXPECT_EQ(at(1.55, 1.55, 0.45), Space::Unknown) << "in the shadow of the branch";
    EXPECT_EQ(at(1e7, 0, 0), Space::Unknown);
    // 400 ends, 300 columns of 15 voxels and 100 of 7.
    EXPECT_NEAR(space.volume_m3(Space::Occupied), 0.4, 1e-9);
    EXPECT_NEAR(space.volume_m3(Space::Free), 300 * 0.015 + 100 * 0.007, 1e-9);
}

TEST(SpaceOccupancy, ARayBeyondTheRangeIsFreeUpToIt) {
    OccupancyOptions options;
    options.greatest_range_m = 2.0;
    const SpaceOccupancy space = built({{{0.05, 0.05, 5.05}, {0.05, 0.05, 0.05}}}, options);
    EXPECT_EQ(space.at({0.05, 0.05, 4.0 + 0.05}), Space::Free);
    EXPECT_EQ(space.at({0.05, 0.05, 2.55}), Space::Unknown);
    EXPECT_EQ(space.at({0.05, 0.05, 0.05}), Space::Unknown);
    EXPECT_EQ(space.volume_m3(Space::Occupied), 0.0);
}

TEST(SpaceOccupancy, OctoMapReadsBothFiles) {
    const SpaceOccupancy space = built(shotsOverABranch(), atUtm());
    const auto binary = space.binaryTree(), full = space.fullTree();
    ASSERT_TRUE(binary && full);
    const test::TemporaryFolder folder;
    test::writeBytes(folder / "s.bt", *binary);
    test::writeBytes(folder / "s.ot", *full);
    octomap::OcTree from_bt((folder / "s.bt").string());
    const std::unique_ptr<octomap::AbstractOcTree> any(
        octomap::AbstractOcTree::read((folder / "s.ot").string()));
    const auto* const from_ot = dynamic_cast<octomap::OcTree*>(any.get());
    ASSERT_NE(from_ot, nullptr);
    EXPECT_DOUBLE_EQ(from_bt.getResolution(), 0.1);
    for (const octomap::OcTree* tree : std::array<const octomap::OcTree*, 2>{&from_bt, from_ot}) {
        for (const auto& [z, occupied] :
             {std::pair{0.05, true}, std::pair{0.45, false}, std::pair{1.45, false}}) {
            const auto* const node = tree->search(0.35, 0.35, z);
            ASSERT_NE(node, nullptr);
            EXPECT_EQ(tree->isNodeOccupied(node), occupied) << z;
        }
        EXPECT_EQ(tree->search(1.55, 1.55, 0.45), nullptr);
    }
    // One hit and no miss: the default sensor model.
    EXPECT_NEAR(from_ot->search(0.35, 0.35, 0.05)->getOccupancy(), 0.7, 1e-6);
    EXPECT_EQ(*built(shotsOverABranch(), atUtm()).fullTree(), *full) << "the same bytes again";
}

TEST(SpaceOccupancy, TellsFreeHeightAndObstacles) {
    const SpaceOccupancy space = built(shotsOverABranch(), atUtm());
    // Cells of half a metre; those of the last column were never shot at.
    ElevationGrid ground{{kUtm.x(), kUtm.y() + 2.0, 0.5, 5, 4}, std::vector<float>(20, 38.05F)};
    ground.heights_m[0] = kNoHeight;
    SilentProgress silent;
    const auto above = space.aboveGround(ground, {}, silent, {});
    ASSERT_TRUE(above);
    EXPECT_TRUE(std::isnan(above->free_height.at(0, 0)));
    // Floats near 38 step by 3.8e-6. The voxel of the array itself, 1.5 to 1.6 m, was crossed too.
    EXPECT_NEAR(above->free_height.at(3, 0), 1.6 - 0.05, 1e-5);
    EXPECT_TRUE(std::isnan(above->obstacle_height.at(3, 0)));
    EXPECT_EQ(above->free_height.at(0, 3), 0.0F) << "the branch hides the space below it";
    EXPECT_NEAR(above->obstacle_height.at(0, 3), 0.8 - 0.05, 1e-5);
    EXPECT_TRUE(std::isnan(above->free_height.at(3, 4))) << "no ray went there";
    EXPECT_TRUE(std::isnan(above->obstacle_height.at(3, 4)));
    // A thick ground layer swallows the branch.
    const auto thick = space.aboveGround(ground, {1.0, 5.0}, silent, {});
    ASSERT_TRUE(thick);
    EXPECT_TRUE(std::isnan(thick->obstacle_height.at(0, 3)));
    EXPECT_NEAR(thick->free_height.at(0, 3), 1.55, 1e-5);
}

TEST(SpaceOccupancy, RefusesAndStops) {
    SilentProgress silent;
    const auto error = [&](const std::vector<LaserRay>& rays, const OccupancyOptions& options) {
        const auto space = SpaceOccupancy::build(rays, options, silent, {});
        return space ? "built" : space.error().text();
    };
    OccupancyOptions none;
    none.voxel_m = 0.0;
    EXPECT_NE(error({}, none).find("above zero"), std::string::npos);
    EXPECT_NE(error({{kUtm, kUtm}}, {}).find("farther"), std::string::npos);
    EXPECT_NE(error({{Vector3d::Constant(std::nan("")), Vector3d::Zero()}}, {}).find("farther"),
              std::string::npos);
    std::stop_source stop;
    stop.request_stop();
    const auto stopped = SpaceOccupancy::build(shotsOverABranch(), atUtm(), silent, stop.get_token());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
    EXPECT_GT(occupancyMemory_bytes(shotsOverABranch(), atUtm()), 400 * 15 * 16.0);
}

}  // namespace
}  // namespace terrawalk
