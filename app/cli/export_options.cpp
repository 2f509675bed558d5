#include "app/cli/export_options.hpp"

#include "app/cli/choice_option.hpp"

namespace terrawalk {

void addExportOptions(CLI::App& command, ExportRequest& r) {
    command.add_option("input", r.input, "Folder that `terrawalk process` wrote")->required();
    command.add_option("-o,--output", r.output, "Folder for the files [INPUT-export]");
    addChoices(command, "--points", r.points, kPointFormats, "Ground points");
    addChoices(command, "--mesh", r.meshes, kMeshFormats, "Surface, beside its PLY and OBJ");
    addChoices(command, "--dem", r.grids, kGridFormats, "Heights, beside their GeoTIFF");
    command.add_flag("--all-points", r.all_points, "Also points that were not used, with their reasons");
}

}  // namespace terrawalk
