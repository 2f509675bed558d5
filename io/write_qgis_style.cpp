#include <fmt/format.h>

#include "io/markup_text.hpp"
#include "io/output_folder.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

namespace {

constexpr const char* kHillshade = R"(<pipe>
<rasterrenderer type="hillshade" band="1" azimuth="315" angle="45" zfactor="1" multidirection="0" opacity="1" alphaBand="-1" nodataColor=""/>
<rasterresampler maxOversampling="2" zoomedInResampler="bilinear"/>
<resamplingStage>resamplingFilter</resamplingStage>
</pipe>
)";

std::string pseudocolour(double lowest, double highest,
                         const std::vector<std::array<std::uint8_t, 3>>& ramp) {
    std::string items;
    for (std::size_t i = 0; i < ramp.size(); ++i) {
        const double share =
            ramp.size() < 2 ? 0.0 : static_cast<double>(i) / static_cast<double>(ramp.size() - 1);
        const double height = lowest + share * (highest - lowest);
        const auto& [red, green, blue] = ramp[i];
        items +=
            fmt::format("<item value=\"{}\" label=\"{:.2f}\" alpha=\"255\" color=\"#{:02x}{:02x}{:02x}\"/>\n",
                        height, height, red, green, blue);
    }
    return fmt::format(R"(<pipe>
<rasterrenderer type="singlebandpseudocolor" band="1" classificationMin="{}" classificationMax="{}" opacity="1" alphaBand="-1" nodataColor="">
<rastershader>
<colorrampshader colorRampType="INTERPOLATED" classificationMode="1" clip="0" minimumValue="{}" maximumValue="{}">
{}</colorrampshader>
</rastershader>
</rasterrenderer>
<rasterresampler maxOversampling="2"/>
</pipe>
)",
                       lowest, highest, lowest, highest, items);
}

std::string treeLayer(const std::string& id, const std::string& file, const std::string& name) {
    return fmt::format(
        "<layer-tree-layer id=\"{}\" name=\"{}\" source=\"./{}\" providerKey=\"gdal\" "
        "checked=\"Qt::Checked\" "
        "expanded=\"0\"/>\n",
        id, name, file);
}

/// @param blend  how QGIS lays it over what is below: 0 as it is, 6 multiplied
std::string mapLayer(const std::string& id, const std::string& file, const std::string& crs_wkt2,
                     const std::string& name, int blend, const std::string& pipe) {
    return fmt::format(
        "<maplayer type=\"raster\">\n<id>{}</id>\n<datasource>./{}</datasource>\n<layername>{}</layername>\n"
        "<srs><spatialrefsys nativeFormat=\"Wkt\"><wkt>{}</wkt></spatialrefsys></srs>\n"
        "<provider>gdal</provider>\n{}<blendMode>{}</blendMode>\n</maplayer>\n",
        id, file, name, escapedMarkup(crs_wkt2), pipe, blend);
}

}  // namespace

Result<void> writeHillshadeStyle(const std::filesystem::path& file) {
    return writeTextFile(
        fmt::format("<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n<qgis "
                    "version=\"3.22\" styleCategories=\"Symbology\">\n{}<blendMode>0</blendMode>\n"
                    "</qgis>\n",
                    kHillshade),
        file);
}

Result<void> writeShadedLayers(const std::string& dem_name, const std::string& crs_wkt2, double lowest,
                               double highest, const std::vector<std::array<std::uint8_t, 3>>& ramp,
                               const std::filesystem::path& file) {
    if (ramp.size() < 2 || !(lowest <= highest)) return badData("no colours or no heights to show", file);
    const std::string name = escapedMarkup(dem_name);
    constexpr int kMultiply = 6;
    return writeTextFile(
        "<!DOCTYPE qgis-layer-definition>\n<qlr>\n<layer-tree-group name=\"\" checked=\"Qt::Checked\" "
        "expanded=\"1\">\n" +
            treeLayer("terrawalk_shade", name, "Relief") + treeLayer("terrawalk_heights", name, "Heights") +
            "</layer-tree-group>\n<maplayers>\n" +
            mapLayer("terrawalk_shade", name, crs_wkt2, "Relief", kMultiply, kHillshade) +
            mapLayer("terrawalk_heights", name, crs_wkt2, "Heights", 0, pseudocolour(lowest, highest, ramp)) +
            "</maplayers>\n</qlr>\n",
        file);
}

}  // namespace terrawalk
