#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "app/pipeline/process.hpp"
#include "app/pipeline/relief.hpp"
#include "app/pipeline/version.hpp"
#include "io/read_dem.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

Result<InputFile> describeInput(const fs::path& file, const fs::path& folder) {
    auto digest = sha256OfFile(file);
    if (!digest) return tl::unexpected(digest.error());
    std::error_code error;
    const auto bytes = fs::file_size(file, error);
    if (error) return systemError(error.message(), file);
    return InputFile{file.lexically_relative(folder).generic_string(), bytes, std::move(*digest)};
}

Result<std::vector<InputFile>> describeInputs(const Survey& survey) {
    std::vector<fs::path> files{survey.project_file};
    if (!survey.control_file.empty()) files.push_back(survey.control_file);
    if (!survey.breakline_file.empty()) files.push_back(survey.breakline_file);
    for (const Run& run : survey.runs) files.push_back(run.log.file);
    std::vector<InputFile> inputs;
    for (const fs::path& file : files) {
        auto input = describeInput(file, survey.project_file.parent_path());
        if (!input) return tl::unexpected(input.error());
        // Two runs may share a log.
        if (std::none_of(inputs.begin(), inputs.end(),
                         [&](const InputFile& i) { return i.path == input->path; })) {
            inputs.push_back(std::move(*input));
        }
    }
    return inputs;
}

/// What takes local coordinates to the map.
ordered_json frameJson(const Survey& survey) {
    const GeodeticPosition& zero = survey.zero_point;
    return {{"zero_point", {{"lat_deg", zero.lat_deg}, {"lon_deg", zero.lon_deg}, {"h_ell_m", zero.h_ell_m}}},
            {"crs", survey.crs},
            {"vertical_datum", survey.vertical_datum}};
}

/// The day on which the first log that knows its time began, as YYYY-MM-DD; empty where none does.
std::string dateOf(const Survey& survey) {
    constexpr std::size_t kDateLength = 10;
    std::string first;
    for (const Run& run : survey.runs) {
        const std::string date = run.log.start_utc.substr(0, kDateLength);
        if (!date.empty() && (first.empty() || date < first)) first = date;
    }
    return first;
}

std::string manifestText(const Survey& survey, const Products& products, const SurveyReport& report,
                         const Provenance& provenance, const std::vector<std::string>& files) {
    PipelineConfig used = products.used;
    used.report.language = report.language;
    ordered_json manifest{{"format", kOutputFormat},
                          {"program", programVersion()},
                          {"libraries", ordered_json::object()},
                          {"command", provenance.command},
                          {"seed", report.seed},
                          {"survey", report.survey_name},
                          {"frame", frameJson(survey)},
                          {"inputs", ordered_json::array()},
                          {"products", files},
                          {"configuration", ordered_json::parse(toJson(used))}};
    if (const std::string date = dateOf(survey); !date.empty()) manifest["survey_date"] = date;
    for (const auto& [library, version] : libraryVersions()) manifest["libraries"][library] = version;
    for (const InputFile& input : report.inputs) {
        manifest["inputs"].push_back(
            {{"path", input.path}, {"bytes", input.bytes}, {"sha256", input.sha256}});
    }
    return manifest.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

/// What the check marks say of the DEM, for who has the file alone.
void addAccuracy(const SurveyReport& report, DemDescription& description) {
    if (!report.headline || *report.headline >= report.accuracy.size()) return;
    const AccuracyGroup& group = report.accuracy[*report.headline];
    if (group.stage != Stage::Surface || group.role != MarkRole::Check || !group.up) return;
    description.metadata.emplace_back("RMSE_V", fmt::format("{:.4f}", group.up->rmse_m));
    description.metadata.emplace_back("CHECK_POINTS", std::to_string(group.up->n));
}

DemDescription describeDem(const Products& products, const Survey& survey) {
    DemDescription description{.crs_wkt2 = products.crs_wkt2,
                               .vertical_datum = survey.vertical_datum,
                               .title = survey.name,
                               .software = programVersion(),
                               .metadata = {{"METHOD", products.report.surface.method},
                                            {"FUSION", products.report.method},
                                            {"HEIGHTS", products.report.surface.vertical_datum}}};
    addAccuracy(products.report, description);
    return description;
}

using Writer = std::function<Result<void>(const fs::path&)>;

// Of a file that holds standard errors: over what range they hang together.
DemDescription describeErrors(const Products& products, const Survey& survey) {
    DemDescription description = describeDem(products, survey);
    description.metadata.emplace_back(kCorrelationRange,
                                      fmt::format("{:.3f}", products.uncertainty->correlation_range_m));
    description.metadata.emplace_back(kHeightsSha256, sha256OfHeights(products.dem));
    return description;
}

DemDescription describeUncertainty(const Products& products, const Survey& survey) {
    DemDescription description = describeErrors(products, survey);
    description.quantity = "Uncertainty, 1 sigma";
    return description;
}

void addUncertainty(const Products& products, const Survey& survey,
                    std::vector<std::pair<std::string, Writer>>& writers, const std::stop_token& stop) {
    const auto raster = [&, stop](std::string quantity, std::string unit, auto values, bool classes) {
        return [&products, &survey, stop, quantity = std::move(quantity), unit = std::move(unit),
                values = std::move(values), classes](const fs::path& f) {
            DemDescription description = describeDem(products, survey);
            description.quantity = quantity;
            description.unit = unit;
            description.classes = classes;
            return writeDem({products.dem.geometry, values()}, description, f, stop);
        };
    };
    const auto whereKnown = [&products](const auto& cells) {
        std::vector<float> values(cells.size(), kNoHeight);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (!std::isnan(products.dem.heights_m[i])) values[i] = static_cast<float>(cells[i]);
        }
        return values;
    };
    const SurfaceUncertainty& u = *products.uncertainty;
    writers.emplace_back("dem_uncertainty.tif", [&, stop](const fs::path& f) {
        return writeDem({products.dem.geometry, u.sigmas_m}, describeUncertainty(products, survey), f, stop);
    });
    writers.emplace_back(
        "dem_density.tif",
        raster(
            "Ground points", "1/m2", [&u, whereKnown] { return whereKnown(u.density_per_m2); }, false));
    writers.emplace_back("dem_source.tif", raster(
                                               "Source: 1 measured, 2 interpolated, 3 extrapolated", "class",
                                               [&u, whereKnown] { return whereKnown(u.sources); }, true));
    if (products.used.surface.multiband) {
        writers.emplace_back("dem_multiband.tif", [&](const fs::path& f) {
            return writeDemWithUncertainty(products.dem, u.sigmas_m, describeErrors(products, survey), f,
                                           stop);
        });
    }
}

void setLanguage(SurveyReport& report, ReportLanguage language) {
    report.language = language;
    PipelineConfig config;
    config.report.language = language;
    const std::string text = settingText(config, "report.language");
    for (UsedSetting& s : report.settings) {
        if (s.key == "report.language")
            s = {s.key, language == ReportLanguage::English ? "default" : text, text};
    }
}

/// The report with what only its writers need to know: the hashes of the inputs, the language.
Result<SurveyReport> reportToWrite(const Survey& survey, const Products& products,
                                   std::optional<ReportLanguage> language) {
    SurveyReport report = products.report;
    if (language) setLanguage(report, *language);
    auto inputs = describeInputs(survey);
    if (!inputs) return tl::unexpected(inputs.error());
    report.inputs = std::move(*inputs);
    return report;
}

}  // namespace

Result<void> writeReport(const Survey& survey, const Products& products, ReportLanguage language,
                         const fs::path& file) {
    const auto report = reportToWrite(survey, products, language);
    if (!report) return tl::unexpected(report.error());
    return writeReportPdf(*report, file);
}

Result<void> writeSurface(const Survey& survey, const Products& products, const fs::path& file,
                          std::stop_token stop) {
    if (products.uncertainty) {
        const fs::path beside =
            file.parent_path() / (file.stem().string() + "_uncertainty" + file.extension().string());
        auto written = writeDem({products.dem.geometry, products.uncertainty->sigmas_m},
                                describeUncertainty(products, survey), beside, stop);
        if (!written) return written;
    }
    return writeDem(products.dem, describeDem(products, survey), file, stop);
}

Result<void> writeProducts(const Survey& survey, const Products& products, const Provenance& provenance,
                           OutputFolder& folder, Progress& progress, std::stop_token stop) {
    progress.report(0.0, "hashing the inputs");
    const auto hashed = reportToWrite(survey, products, provenance.language);
    if (!hashed) return tl::unexpected(hashed.error());
    const SurveyReport& report = *hashed;

    std::vector<std::string> files;
    std::vector<std::pair<std::string, Writer>> writers{
        {"dem.tif",
         [&](const fs::path& f) {
             return writeDem(products.dem, describeDem(products, survey), f, stop);
         }},
        {"dem.qml",
         [](const fs::path& f) {
             return writeHillshadeStyle(f);
         }},
        {"dem.qlr",
         [&](const fs::path& f) {
             return writeShadedLayers("dem.tif", products.crs_wkt2, report.surface.lowest_m,
                                      report.surface.highest_m, reliefRamp(), f);
         }},
        {"surface.ply",
         [&](const fs::path& f) {
             return writePly(products.surface, report.surface.crs, f);
         }},
        {"surface.obj",
         [&](const fs::path& f) {
             return writeObj(products.surface, report.surface.crs, f);
         }},
        {"ground_points.csv",
         [&](const fs::path& f) {
             std::vector<std::string> ids;
             for (const Run& run : survey.runs) ids.push_back(run.id);
             return writeGroundPointsCsv(products.ground_points, ids, f);
         }},
        {"residuals.csv",
         [&](const fs::path& f) {
             return writeResidualsCsv(report.residuals, f);
         }},
        {"report.json",
         [&](const fs::path& f) {
             return writeReportJson(report, f);
         }},
        {"report.html",
         [&](const fs::path& f) {
             return writeReportHtml(report, f);
         }},
        {"report.pdf",
         [&](const fs::path& f) {
             return writeReportPdf(report, f);
         }},
        {"figures.txt",
         [&](const fs::path& f) {
             return writeTextFile(summaryText(products), f);
         }},
    };
    if (products.uncertainty) addUncertainty(products, survey, writers, stop);
    if (!products.terrace_edges.empty()) {
        writers.emplace_back("terrace_edges.gpkg", [&](const fs::path& f) {
            return writeBreaklines(softBreaklines(products.terrace_edges), "terrace_edges", products.crs_wkt2,
                                   f, stop);
        });
    }
    if (products.space) {
        for (auto& writer : spaceWriters(*products.space, describeDem(products, survey), stop)) {
            writers.push_back(std::move(writer));
        }
    }
    for (const Trajectory& trajectory : products.trajectories) {
        writers.emplace_back("trajectory/" + trajectory.run_id + ".csv",
                             [&](const fs::path& f) { return writeTrajectoryCsv(trajectory, f); });
    }
    for (const auto& writer : writers) files.push_back(writer.first);
    files.emplace_back("manifest.json");
    writers.emplace_back("manifest.json", [&](const fs::path& f) {
        return writeTextFile(manifestText(survey, products, report, provenance, files), f);
    });

    for (std::size_t i = 0; i < writers.size(); ++i) {
        if (stop.stop_requested()) return cancelled();
        const auto& [name, write] = writers[i];
        progress.report(0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(writers.size()),
                        "writing " + name);
        const auto path = folder.pathFor(name);
        if (!path) return tl::unexpected(path.error());
        if (auto written = write(*path); !written) return written;
    }
    return {};
}

std::string summaryText(const Products& products) {
    const SurfaceReport& surface = products.report.surface;
    std::string text = printable(products.report.survey_name) + "\n";
    text += fmt::format("  DEM      dem.tif       {} x {} cells of {:g} m, {}\n", surface.columns,
                        surface.rows, surface.cell_m, surface.crs);
    text += fmt::format("  mesh     surface.ply   {} points, {} triangles\n",
                        products.surface.vertices_m.size(), surface.triangles);
    if (!products.terrace_edges.empty()) {
        text += fmt::format("  edges    terrace_edges.gpkg  {} terrace edges, {:.0f} m in all\n",
                            surface.terrace_edges.count, surface.terrace_edges.length_m);
    }
    if (const auto& space = products.report.occupancy) {
        for (const auto& [word, line] : inWords(*space)) {
            if (word == "Free") text += "  space    free_height.tif  free " + line + "\n";
        }
    }
    text += "  report   report.html\n";
    for (const KeyFigure& figure : products.report.figures) {
        text += fmt::format("  {}: {}{}{}{}\n", figure.label, figure.value, figure.detail.empty() ? "" : " (",
                            figure.detail, figure.detail.empty() ? "" : ")");
    }
    return text;
}

}  // namespace terrawalk
