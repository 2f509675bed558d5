#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/pipeline/height_change.hpp"
#include "app/pipeline/jobs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using testing::HasSubstr;

/// A plane that rises a tenth eastwards, one sigma of 0.1 m.
Products plane(double west_m, double cell_m, std::size_t across, double up_m) {
    Products p;
    p.dem.geometry = {west_m, 100.0, cell_m, across, across};
    p.uncertainty.emplace();
    for (std::size_t i = 0; i < across * across; ++i) {
        const double x = p.dem.geometry.centreX(i % across);
        p.dem.heights_m.push_back(static_cast<float>(0.1 * x + up_m));
        p.uncertainty->sigmas_m.push_back(0.1F);
    }
    return p;
}

TEST(HeightChange, IsLaterLessEarlierAndSignificantBeyondBothSigmas) {
    const Products earlier = plane(0.0, 1.0, 20, 0.0);
    // 1.96 times the root of two times 0.1 m is 0.277 m.
    for (const auto& [up_m, significance] : {std::pair{0.30, 1.0F}, {0.25, 0.0F}, {-0.30, -1.0F}}) {
        const auto change = changeSince(plane(0.0, 1.0, 20, up_m), earlier, "run 1", {});
        ASSERT_TRUE(change.has_value());
        EXPECT_EQ(change->earlier, "run 1");
        EXPECT_TRUE(change->has_sigma && change->earlier_has_sigma);
        EXPECT_NEAR(change->median_m, up_m, 1e-6);
        EXPECT_NEAR(change->rms_m, std::abs(up_m), 1e-6);
        for (const float s : change->difference.significance.heights_m) EXPECT_EQ(s, significance);
    }
}

// Bilinear is exact on a plane, so other cells change nothing but where the earlier ones end.
TEST(HeightChange, TakesEarlierHeightsBetweenTheirCells) {
    const Products earlier = plane(5.0, 0.5, 20, 1.0), later = plane(0.0, 1.0, 20, 1.2);
    const auto change = changeSince(later, earlier, "coarser", {});
    ASSERT_TRUE(change.has_value());
    std::size_t known = 0;
    for (std::size_t i = 0; i < later.dem.geometry.size(); ++i) {
        const float c = change->difference.change.heights_m[i];
        const double x = later.dem.geometry.centreX(i % 20), y = later.dem.geometry.centreY(i / 20);
        const bool inside = x >= 5.25 && x <= 14.75 && y <= 99.75 && y >= 90.25;
        EXPECT_EQ(!std::isnan(c), inside) << x << " " << y;
        if (inside) {
            EXPECT_NEAR(c, 0.2, 1e-5);
        }
        known += inside ? 1 : 0;
    }
    EXPECT_EQ(change->difference.all.cells, known);
}

TEST(HeightChange, RefusesPlacesThatDoNotMeet) {
    const auto change = changeSince(plane(0.0, 1.0, 20, 0.0), plane(500.0, 1.0, 20, 0.0), "far", {});
    ASSERT_FALSE(change.has_value());
    EXPECT_THAT(change.error().text(), HasSubstr("no place in common"));
}

TEST(HeightChange, AgainstItsOwnExportIsNothing) {
    const test::TemporaryFolder scratch;
    const auto project = std::filesystem::path(TERRAWALK_SOURCE_DIR) / "sample_surveys/quick_plot";
    SilentProgress silent;
    const auto products = processSurvey(project, {}, {}, scratch / "out", silent, {});
    ASSERT_TRUE(products.has_value());
    const auto same = changeSince(*products, scratch / "out/dem.tif", {});
    ASSERT_TRUE(same.has_value()) << same.error().text();
    EXPECT_TRUE(same->earlier_has_sigma) << "dem_uncertainty.tif lies beside it";
    // The file holds millimetres or better.
    EXPECT_LT(same->rms_m, 1e-3);
    EXPECT_EQ(same->difference.raised + same->difference.lowered, 0u);

    test::writeBytes(scratch / "bad.tif", "no raster");
    const auto bad = changeSince(*products, scratch / "bad.tif", {});
    ASSERT_FALSE(bad.has_value());
    EXPECT_THAT(bad.error().text(), HasSubstr("bad.tif"));
}

}  // namespace
}  // namespace terrawalk
