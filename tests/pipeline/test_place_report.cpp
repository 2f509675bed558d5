#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/pipeline/place_report.hpp"
#include "tests/support/small_survey.hpp"

namespace terrawalk {
namespace {

class PlaceReports : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        survey = new Survey(simulatedSurvey(smallField()).survey);
        SilentProgress silent;
        PipelineConfig config;
        config.surface.cross_validate = false;
        auto made = process(*survey, config, silent, {});
        ASSERT_TRUE(made) << made.error().text();
        products = new Products(std::move(*made));
        auto drawn = fusedMap(*survey, *products, {});
        ASSERT_TRUE(drawn) << drawn.error().text();
        map = new SurveyMap(std::move(*drawn));
    }
    static void TearDownTestSuite() {
        delete map;
        delete products;
        delete survey;
    }
    static inline Survey* survey = nullptr;
    static inline Products* products = nullptr;
    static inline SurveyMap* map = nullptr;
};

TEST_F(PlaceReports, PartsAddUpToTheSigmaOfTheRaster) {
    const GridGeometry& g = products->dem.geometry;
    std::size_t checked = 0;
    for (std::size_t cell = 0; cell < g.size(); cell += 37) {
        if (std::isnan(products->dem.heights_m[cell])) continue;
        const Eigen::Vector2d at(g.centreX(cell % g.columns), g.centreY(cell / g.columns));
        const PlaceReport place = placeReport(*survey, *products, *map, at);
        ASSERT_TRUE(place.parts);
        const SigmaParts& p = *place.parts;
        const double sum = std::sqrt(p.track_m * p.track_m + p.plan_m * p.plan_m +
                                     p.attitude_m * p.attitude_m + p.interpolation_m * p.interpolation_m);
        EXPECT_NEAR(sum, products->uncertainty->sigmas_m[cell], 1e-5) << cell;
        EXPECT_FLOAT_EQ(static_cast<float>(*place.height_m), products->dem.heights_m[cell]);
        EXPECT_LE(*place.sigma_after_pass_m, *place.sigma_m + 1e-6);
        ++checked;
    }
    EXPECT_GT(checked, 20u);
}

TEST_F(PlaceReports, NearestSamplesComeInOrderAndTheFirstIsTheNearest) {
    const Eigen::Vector3d& sample = map->ground_points_m[products->ground_points.size() / 2];
    const PlaceReport place = placeReport(*survey, *products, *map, sample.head<2>());
    ASSERT_GE(place.nearest.size(), 3u);
    EXPECT_NEAR(place.nearest.front().distance_m, 0.0, 1e-9);
    for (std::size_t i = 1; i < place.nearest.size(); ++i) {
        EXPECT_GE(place.nearest[i].distance_m, place.nearest[i - 1].distance_m);
    }
}

TEST_F(PlaceReports, OutsideTheSurfaceThereIsNoHeightAndTheAdviceSaysHowFar) {
    const GridGeometry& g = products->dem.geometry;
    const PlaceReport place = placeReport(*survey, *products, *map, {g.west_m - 50.0, g.north_m + 50.0});
    EXPECT_FALSE(place.height_m);
    EXPECT_FALSE(place.parts);
    ASSERT_FALSE(place.nearest.empty());
    EXPECT_GT(place.nearest.front().distance_m, 30.0);
}

}  // namespace
}  // namespace terrawalk
