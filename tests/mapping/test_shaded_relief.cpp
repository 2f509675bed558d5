#include <gtest/gtest.h>

#include "mapping/shaded_relief.hpp"

namespace terrawalk {
namespace {

const std::vector<Colour> kGreyRamp{{100, 100, 100}, {200, 200, 200}};

ElevationGrid plane(double rise_east, double rise_north) {
    ElevationGrid grid{{0, 9, 1, 9, 9}, {}};
    for (std::size_t row = 0; row < 9; ++row) {
        for (std::size_t column = 0; column < 9; ++column) {
            grid.heights_m.push_back(static_cast<float>(rise_east * grid.geometry.centreX(column) +
                                                        rise_north * grid.geometry.centreY(row)));
        }
    }
    return grid;
}

int brightnessInTheMiddle(const ElevationGrid& grid) {
    // One colour only, so that the height does not matter.
    const ReliefImage image = shadedRelief(grid, {{200, 200, 200}, {200, 200, 200}});
    return image.rgba[4 * (4 * 9 + 4)];
}

TEST(ShadedRelief, RampIsExactAtItsAnchorsAndEvenBetween) {
    EXPECT_EQ(rampColour(kGreyRamp, 0.0), (Colour{100, 100, 100}));
    EXPECT_EQ(rampColour(kGreyRamp, 1.0), (Colour{200, 200, 200}));
    EXPECT_EQ(rampColour(kGreyRamp, 0.5), (Colour{150, 150, 150}));
    EXPECT_EQ(rampColour(kGreyRamp, 7.0), (Colour{200, 200, 200}));
}

TEST(ShadedRelief, LevelGroundKeepsItsColour) {
    EXPECT_EQ(brightnessInTheMiddle(plane(0, 0)), 200);
}

TEST(ShadedRelief, SlopesTowardTheNorthWesternSunAreBrighter) {
    const int level = brightnessInTheMiddle(plane(0, 0));
    EXPECT_GT(brightnessInTheMiddle(plane(0.3, -0.3)), level);  // falls to the north-west
    EXPECT_LT(brightnessInTheMiddle(plane(-0.3, 0.3)), level);  // falls to the south-east
}

TEST(ShadedRelief, MissingCellsAreTransparentAndDoNotSpread) {
    ElevationGrid grid = plane(0.1, 0);
    grid.heights_m[4 * 9 + 4] = kNoHeight;
    const ReliefImage image = shadedRelief(grid, kGreyRamp);
    std::size_t transparent = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) transparent += image.rgba[i] == 0 ? 1 : 0;
    EXPECT_EQ(transparent, 1u);
}

TEST(ShadedRelief, RampPictureRunsFromLowToHigh) {
    const ReliefImage image = rampImage(kGreyRamp);
    ASSERT_EQ(image.rgba.size(), 4 * image.columns);
    EXPECT_EQ(image.rgba.front(), 100);
    EXPECT_EQ(image.rgba[image.rgba.size() - 4], 200);
}

TEST(ShadedRelief, NoHeightsGiveAnEmptyPicture) {
    const ReliefImage image = shadedRelief({{0, 2, 1, 2, 2}, std::vector<float>(4, kNoHeight)}, kGreyRamp);
    EXPECT_EQ(image.rgba, std::vector<std::uint8_t>(16, 0));
}

}  // namespace
}  // namespace terrawalk
