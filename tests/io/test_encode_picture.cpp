#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include "io/encode_picture.hpp"
#include "io/markup_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

TEST(Base64, IsThatOfRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(EncodePng, GdalReadsTheSamePixelsBack) {
    ReliefImage image;
    image.columns = 3;
    image.rows = 2;
    for (int i = 0; i < 24; ++i) image.rgba.push_back(static_cast<std::uint8_t>(i * 10));
    const auto png = encodePng(image);
    ASSERT_TRUE(png) << png.error().text();
    EXPECT_EQ(encodePng(image).value(), *png);
    const test::TemporaryFolder folder;
    test::writeBytes(folder / "picture.png", *png);
    GDALAllRegister();
    const auto read = GDALDatasetUniquePtr(GDALDataset::Open((folder / "picture.png").c_str()));
    ASSERT_TRUE(read);
    std::vector<std::uint8_t> pixels(24);
    ASSERT_EQ(
        read->RasterIO(GF_Read, 0, 0, 3, 2, pixels.data(), 3, 2, GDT_Byte, 4, nullptr, 4, 12, 1, nullptr),
        CE_None);
    EXPECT_EQ(pixels, image.rgba);
}

TEST(EncodePng, AnEmptyPictureIsAnError) {
    EXPECT_FALSE(encodePng({}));
}

}  // namespace
}  // namespace terrawalk
