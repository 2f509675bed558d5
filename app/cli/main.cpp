#include <fmt/format.h>
#include <malloc.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <new>
#include <optional>
#include <ranges>
#include <string>
#include <vector>

#include "app/cli/analysis_options.hpp"
#include "app/cli/export_options.hpp"
#include "app/cli/interrupt.hpp"
#include "app/cli/new_survey_options.hpp"
#include "app/cli/simulate_options.hpp"
#include "app/cli/surface_options.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/cli/tune_options.hpp"
#include "app/pipeline/compare.hpp"
#include "app/pipeline/experiment.hpp"
#include "app/pipeline/jobs.hpp"
#include "app/pipeline/json_output.hpp"
#include "app/pipeline/surface.hpp"
#include "app/pipeline/tune_file.hpp"
#include "app/pipeline/tune_jobs.hpp"
#include "app/pipeline/version.hpp"

namespace terrawalk {
namespace {

namespace fs = std::filesystem;

constexpr int kExitUsage = 2;
constexpr FusionMethod kTunedMethod = FusionMethod::Aukf;  // by `tune`, where no other is named

int exitCode(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::Usage:
            return kExitUsage;
        case ErrorKind::BadData:
            return 3;
        case ErrorKind::Cancelled:
            return 4;
        case ErrorKind::System:
            return 1;
    }
    return 1;
}

/// Options that every command has.
struct Common {
    std::size_t threads = 0;
    bool json = false;
    bool quiet = false;
};

struct ProcessArguments {
    fs::path survey;
    fs::path output = "out";
    fs::path config_file;
    std::vector<std::string> settings;
    std::optional<std::string> method;
    std::optional<std::uint64_t> seed;
    bool multiband = false;
    bool preview = false;
    bool tune = false;
    TuneOptions tuning;
};

struct TuneArguments {
    ProcessArguments survey_and_configuration;
    TuneFiles files;
};

struct SimulateArguments {
    fs::path output;
    SimulationOptions options;
};

struct ExperimentArguments {
    std::string name;
    fs::path output = "experiments";
    bool list = false;
    ExperimentOptions options;
};

// Without fmt: a closed standard error must not turn into an exception.
void printError(const std::string& text) {
    std::fputs(("terrawalk: " + text + "\n").c_str(), stderr);
}

int fail(const Error& error, const Common& common, TerminalProgress& progress) {
    progress.clear();
    printError(error.text());
    if (common.json) fmt::print("{}\n", errorJson(error));
    return exitCode(error.kind);
}

void addJson(CLI::App& command, Common& common) {
    command.add_flag("--json", common.json, "Print the outcome as JSON");
}

void addQuiet(CLI::App& command, Common& common) {
    command.add_flag("--quiet,-q", common.quiet, "Print errors only");
}

void addCommon(CLI::App& command, Common& common) {
    command.add_option("--threads", common.threads, "Threads to work on; 0: one for each core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    addJson(command, common);
    addQuiet(command, common);
}

void addSettings(CLI::App& command, ProcessArguments& arguments) {
    command.add_option("--config", arguments.config_file, "JSON file with parameters")->type_name("FILE");
    command
        .add_option("--set", arguments.settings, "Set one parameter; `terrawalk config describe` lists them")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

/// Names of many things in one line of the help.
template <class Range, class NameOf>
std::string listed(Range&& range, NameOf nameOf) {
    std::string list;
    for (const auto& item : range) list += (list.empty() ? "" : ", ") + std::string(nameOf(item));
    return list;
}

void addConfiguration(CLI::App& command, ProcessArguments& arguments,
                      FusionMethod method = FusionOptions{}.method) {
    addSettings(command, arguments);
    command
        .add_option("--method", arguments.method,
                    "Short for --set fusion.method=NAME: " +
                        listed(kFusionMethodNames, [](const auto& pair) { return pair.second; }))
        ->option_text(fmt::format("NAME [{}]", name(method)));
    command.add_option("--seed", arguments.seed, "Short for --set seed=...");
    command.add_flag("--multiband", arguments.multiband, "Short for --set surface.multiband=true");
    command.add_flag("--preview", arguments.preview,
                     "A quick look, without the adjustment of all runs: short for --set "
                     "fusion.joint.preview=true");
}

// The file first, then single settings, so that the command line has the last word.
Result<PipelineConfig> configuration(const ProcessArguments& arguments) {
    PipelineConfig config;
    if (!arguments.config_file.empty()) {
        if (auto done = applyConfigFile(config, arguments.config_file); !done)
            return tl::unexpected(done.error());
    }
    std::vector<std::string> settings = arguments.settings;
    if (arguments.method) settings.push_back("fusion.method=" + *arguments.method);
    if (arguments.seed) settings.push_back(fmt::format("seed={}", *arguments.seed));
    if (arguments.multiband) settings.emplace_back("surface.multiband=true");
    if (arguments.preview) settings.emplace_back("fusion.joint.preview=true");
    for (const std::string& setting : settings) {
        if (auto done = applySetting(config, setting); !done) return tl::unexpected(done.error());
    }
    return config;
}

// What a second person has to type for the same result; what changes no byte of it is left out.
Provenance provenanceOf(const std::string& command, const ProcessArguments& arguments) {
    Provenance provenance{{"terrawalk", command, arguments.survey.string()}};
    const auto add = [&](const std::string& option, const std::string& value) {
        provenance.command.push_back(option);
        provenance.command.push_back(value);
    };
    if (!arguments.config_file.empty()) add("--config", arguments.config_file.string());
    for (const std::string& setting : arguments.settings) add("--set", setting);
    if (arguments.method) add("--method", *arguments.method);
    if (arguments.seed) add("--seed", std::to_string(*arguments.seed));
    if (arguments.multiband) provenance.command.emplace_back("--multiband");
    if (arguments.preview) provenance.command.emplace_back("--preview");
    if (arguments.tune) {
        provenance.command.emplace_back("--tune");
        const std::vector<std::string> options = tuneArguments(arguments.tuning);
        provenance.command.insert(provenance.command.end(), options.begin(), options.end());
    }
    return provenance;
}

int runProcess(const ProcessArguments& arguments, const Common& common, TerminalProgress& progress,
               const std::stop_token& stop) {
    const auto config = configuration(arguments);
    if (!config) return fail(config.error(), common, progress);
    std::optional<TuneOptions> tuning;
    if (arguments.tune) {
        tuning = arguments.tuning;
        tuning->seed = config->seed;
    }
    const auto products = processSurvey(arguments.survey, *config, provenanceOf("process", arguments),
                                        arguments.output, progress, stop, tuning);
    if (!products) return fail(products.error(), common, progress);
    progress.clear();
    if (common.json) {
        fmt::print("{}", summaryJson(*products, arguments.output));
    } else if (!common.quiet) {
        fmt::print("Written to {}\n{}", printable(arguments.output.string()), summaryText(*products));
    }
    return 0;
}

int runTune(TuneArguments& arguments, const Common& common, TerminalProgress& progress,
            const std::stop_token& stop) {
    ProcessArguments& asked = arguments.survey_and_configuration;
    if (!asked.method) asked.method = name(kTunedMethod);
    const auto config = configuration(asked);
    if (!config) return fail(config.error(), common, progress);
    asked.tuning.seed = config->seed;
    const auto tuned = tuneSurvey(asked.survey, *config, asked.tuning, arguments.files, progress, stop);
    if (!tuned) return fail(tuned.error(), common, progress);
    progress.clear();
    const std::string file = arguments.files.output.string();
    if (common.json) {
        fmt::print("{}", toJson(tuned->outcome, tuned->survey, arguments.files.output));
    } else if (!common.quiet) {
        fmt::print("{}Written to {}\nUse it with: terrawalk process {} --config {} -o out\n",
                   toText(tuned->outcome), printable(file), printable(asked.survey.string()),
                   printable(file));
    }
    return 0;
}

int runCompare(const ProcessArguments& arguments, const Common& common, TerminalProgress& progress,
               const std::stop_token& stop) {
    const auto config = configuration(arguments);
    if (!config) return fail(config.error(), common, progress);
    const auto comparison = compareSurvey(arguments.survey, *config, provenanceOf("compare", arguments),
                                          arguments.output, progress, stop);
    if (!comparison) return fail(comparison.error(), common, progress);
    progress.clear();
    if (common.json) {
        fmt::print("{}", toJson(*comparison, arguments.output));
    } else if (!common.quiet) {
        fmt::print("{}", toText(*comparison));
    }
    return 0;
}

int runInspect(const fs::path& path, const Common& common, TerminalProgress& progress,
               const std::stop_token& stop) {
    const auto summaries = inspectFiles(path, progress, stop);
    if (!summaries) return fail(summaries.error(), common, progress);
    progress.clear();
    if (common.json) {
        fmt::print("{}", toJson(*summaries));
    } else {
        for (const LogSummary& summary : *summaries) fmt::print("{}\n", toText(summary));
    }
    return 0;
}

int runSimulate(const SimulateArguments& arguments, const Common& common, TerminalProgress& progress,
                const std::stop_token& stop) {
    const auto done = simulateSurveyFolder(arguments.options, arguments.output, progress, stop);
    if (!done) return fail(done.error(), common, progress);
    progress.clear();
    const std::string project = (arguments.output / "survey.json").string();
    if (common.json) {
        fmt::print("{}", simulationJson(arguments.options, arguments.output));
    } else if (!common.quiet) {
        fmt::print("Simulated survey written to {}\nProcess it with: terrawalk process {} -o out\n",
                   printable(arguments.output.string()), printable(project));
    }
    return 0;
}

int runExperiments(const ExperimentArguments& arguments, const Common& common, TerminalProgress& progress,
                   const std::stop_token& stop) {
    if (arguments.list) {
        for (const Experiment& experiment : experiments())
            fmt::print("{:<12}{}\n", experiment.name, experiment.about);
        return 0;
    }
    const auto report = runExperiment(arguments.name, arguments.options, arguments.output, progress, stop);
    if (!report) return fail(report.error(), common, progress);
    progress.clear();
    const ExperimentFiles files = experimentFiles(arguments.name, arguments.output);
    if (common.json) {
        fmt::print("{}", toJson(*report, arguments.options, files));
    } else if (!common.quiet) {
        fmt::print("{}\nWritten to {} and {}\n", toText(*report, arguments.options),
                   printable(files.csv.string()), printable(files.svg.string()));
    }
    return 0;
}

/// Prints what a job came to.
template <class Outcome>
int tell(const Result<Outcome>& outcome, const Common& common, TerminalProgress& progress) {
    if (!outcome) return fail(outcome.error(), common, progress);
    progress.clear();
    if (common.json) {
        fmt::print("{}", toJson(*outcome));
    } else if (!common.quiet) {
        fmt::print("{}", toText(*outcome));
    }
    return 0;
}

/// Commands that are a request, a job and its outcome, and nothing else.
class JobCommands {
  public:
    JobCommands(CLI::App& app, Common& common) : app_(app), common_(common) {}

    /// @param request  is filled by the options, so it must outlive this
    template <class Request, class Job>
    void add(const char* name, const char* about, void (*addOptions)(CLI::App&, Request&), Request& request,
             Job job) {
        CLI::App* const command = app_.add_subcommand(name, about);
        addOptions(*command, request);
        addCommon(*command, common_);
        commands_.emplace_back(command,
                               [this, &request, job](TerminalProgress& progress, std::stop_token stop) {
                                   return tell(job(request, progress, std::move(stop)), common_, progress);
                               });
    }
    /// The exit code of the command that was named; nothing when it is none of these.
    std::optional<int> run(TerminalProgress& progress, const std::stop_token& stop) const {
        for (const auto& [command, job] : commands_) {
            if (command->parsed()) return job(progress, stop);
        }
        return std::nullopt;
    }

  private:
    CLI::App& app_;
    Common& common_;
    std::vector<std::pair<CLI::App*, std::function<int(TerminalProgress&, std::stop_token)>>> commands_;
};

int runConfigPrint(const ProcessArguments& arguments, const Common& common, TerminalProgress& progress) {
    const auto config = configuration(arguments);
    if (!config) return fail(config.error(), common, progress);
    fmt::print("{}", toJson(*config));
    return 0;
}

int runConfigDescribe(const Common& common) {
    if (common.json) {
        fmt::print("{}", parametersJson());
        return 0;
    }
    for (const ParameterInfo& p : describeParameters()) {
        fmt::print("{}\n    {}\n    default {}; permitted {}\n", p.key, p.meaning, p.default_value, p.range);
    }
    return 0;
}

int runConfigValidate(const fs::path& file, const Common& common, TerminalProgress& progress) {
    PipelineConfig config;
    if (auto done = applyConfigFile(config, file); !done) return fail(done.error(), common, progress);
    if (common.json) {
        fmt::print("{}", validationJson(file));
    } else if (!common.quiet) {
        fmt::print("{}: good\n", printable(file.string()));
    }
    return 0;
}

int run(int argc, char** argv) {
    const Interrupt interrupt;

    CLI::App app{"Terrawalk turns a walk with a handheld sensor array into a terrain model."};
    app.set_version_flag("--version", programVersion());
    app.require_subcommand(1);
    app.footer("Exit codes: 0 done, 1 the system refused, 2 wrong usage, 3 bad data, 4 cancelled.");
    Common common;

    ProcessArguments process;
    CLI::App* process_command = app.add_subcommand("process", "Make the terrain model and its error report");
    process_command->add_option("survey", process.survey, "survey.json, or the folder that holds it")
        ->required();
    process_command->add_option("-o,--output", process.output, "Folder for the products")
        ->capture_default_str();
    addConfiguration(*process_command, process);
    CLI::Option* tune_first = process_command->add_flag(
        "--tune", process.tune,
        "Tune the method on the survey's own marks first; the tuned values are used where they do better on "
        "marks left out");
    for (CLI::Option* option : addTuneOptions(*process_command, process.tuning)) option->needs(tune_first);
    addCommon(*process_command, common);

    TuneArguments tune;
    CLI::App* tune_command =
        app.add_subcommand("tune", "Find a method's parameters on the survey's own marks");
    tune_command
        ->add_option("survey", tune.survey_and_configuration.survey,
                     "survey.json, or the folder that holds it")
        ->required();
    tune_command->add_option("-o,--output", tune.files.output, "File for the parameters")
        ->capture_default_str();
    addTuneOptions(*tune_command, tune.survey_and_configuration.tuning);
    tune_command->add_flag("--resume", tune.files.resume, "Go on where an interrupted tuning stopped");
    tune_command->add_option("--checkpoint", tune.files.checkpoint,
                             "File that keeps the work of an interrupted tuning [OUTPUT.checkpoint]");
    addConfiguration(*tune_command, tune.survey_and_configuration, kTunedMethod);
    addCommon(*tune_command, common);

    ProcessArguments compare;
    compare.output.clear();
    CLI::App* compare_command =
        app.add_subcommand("compare", "Run every method over a survey and tell their errors side by side");
    compare_command->add_option("survey", compare.survey, "survey.json, or the folder that holds it")
        ->required();
    compare_command->add_option("-o,--output", compare.output,
                                "Folder for comparison.csv and comparison.txt; none: printed only");
    addSettings(*compare_command, compare);
    addCommon(*compare_command, common);

    fs::path inspected;
    CLI::App* inspect_command = app.add_subcommand("inspect", "Show what is in a log or a survey");
    inspect_command->add_option("path", inspected, "survey.json, its folder, or one log")->required();
    addCommon(*inspect_command, common);

    SimulateArguments simulate;
    CLI::App* simulate_command = app.add_subcommand("simulate", "Make a survey with known truth");
    simulate_command->add_option("-o,--output", simulate.output, "Folder for the survey")->required();
    addSimulationOptions(*simulate_command, simulate.options);
    addCommon(*simulate_command, common);

    ExperimentArguments experiment;
    CLI::App* experiment_command = app.add_subcommand(
        "experiment", "Repeat an experiment of the papers, or measure accuracy and outages");
    CLI::Option* experiment_name = experiment_command->add_option(
        "name", experiment.name,
        "Which one: " + listed(experiments(), [](const Experiment& e) { return e.name; }));
    experiment_command->add_flag("--list", experiment.list, "Show what each of them is")
        ->excludes(experiment_name);
    experiment_command
        ->add_option("survey", experiment.options.survey,
                     "Survey to work on, for " +
                         listed(experiments() | std::views::filter(&Experiment::takes_survey),
                                [](const Experiment& e) { return e.name; }) +
                         "; a simulated one where it is left out")
        ->excludes("--list");
    experiment_command->add_flag("--quick", experiment.options.quick,
                                 "A small form, done in seconds to a minute");
    experiment_command->add_option("-o,--output", experiment.output, "Folder for NAME.csv and NAME.svg")
        ->capture_default_str();
    experiment_command->add_option("--seed", experiment.options.seed, "Of all random numbers")
        ->capture_default_str();
    addCommon(*experiment_command, common);

    JobCommands jobs(app, common);
    NewSurveyRequest new_survey;
    jobs.add("new", "Make a survey.json from array logs and a table of marks", addNewSurveyOptions,
             new_survey, makeNewSurvey);
    SurfaceRequest surface;
    jobs.add("surface", "Make a DEM from ground points of any origin, by the method that fits them",
             addSurfaceOptions, surface, makeSurface);
    VolumeRequest volume;
    jobs.add("volume", "Tell the volume between a DEM and a plane or another DEM, with its error",
             addVolumeOptions, volume, measureVolume);
    ContourRequest contours;
    jobs.add("contour", "Draw smooth contours that never cross", addContourOptions, contours, makeContours);
    ProfileRequest profile;
    jobs.add("profile", "Tell the heights along a line", addProfileOptions, profile, makeProfile);
    DifferenceRequest difference;
    jobs.add("diff", "Tell what changed between two surveys, and what of it is beyond error",
             addDifferenceOptions, difference, compareDems);
    DeriveRequest derived;
    jobs.add("derive", "Make hillshade, slope, aspect, curvature, roughness, drainage of a DEM",
             addDeriveOptions, derived, deriveRasters);
    ValidateRequest validated_dem;
    jobs.add("validate", "Measure a DEM's errors at marks", addValidateOptions, validated_dem, validateDem);
    WalkAdviceRequest advice;
    jobs.add("walk-again", "Find where another walk would help most", addWalkAdviceOptions, advice,
             adviseWalk);
    ExportRequest exported;
    jobs.add("export", "Write results of a processed survey for other programs", addExportOptions, exported,
             exportResults);
    OccupancyRequest occupancy;
    jobs.add("occupancy", "Map the space above ground that the laser knows to be free or taken",
             addOccupancyOptions, occupancy, mapOccupancy);

    CLI::App* config_command = app.add_subcommand("config", "Show and check parameters");
    config_command->require_subcommand(1);
    CLI::App* print_command = config_command->add_subcommand("print", "Print all parameters as JSON");
    addConfiguration(*print_command, process);
    CLI::App* describe_command = config_command->add_subcommand("describe", "Explain every parameter");
    addJson(*describe_command, common);
    fs::path validated;
    CLI::App* validate_command = config_command->add_subcommand("validate", "Check a parameter file");
    validate_command->add_option("file", validated, "JSON file with parameters")->required();
    addJson(*validate_command, common);
    addQuiet(*validate_command, common);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kExitUsage;
    }

    std::optional<tbb::global_control> limit;
    if (common.threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, common.threads);
    TerminalProgress progress(common.quiet);
    if (process_command->parsed()) return runProcess(process, common, progress, interrupt.token());
    if (tune_command->parsed()) return runTune(tune, common, progress, interrupt.token());
    if (compare_command->parsed()) return runCompare(compare, common, progress, interrupt.token());
    if (inspect_command->parsed()) return runInspect(inspected, common, progress, interrupt.token());
    if (simulate_command->parsed()) return runSimulate(simulate, common, progress, interrupt.token());
    if (experiment_command->parsed()) return runExperiments(experiment, common, progress, interrupt.token());
    if (const auto code = jobs.run(progress, interrupt.token())) return *code;
    if (print_command->parsed()) return runConfigPrint(process, common, progress);
    if (describe_command->parsed()) return runConfigDescribe(common);
    return runConfigValidate(validated, common, progress);
}

}  // namespace
}  // namespace terrawalk

int main(int argc, char** argv) {
    using namespace terrawalk;
    // Large arrays come and go: given back to the system and taken again, each page costs a fault. Half the
    // faults of a large surface are spared.
    mallopt(M_MMAP_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    int code = exitCode(ErrorKind::System);
    try {
        code = run(argc, argv);
    } catch (const std::bad_alloc&) {
        printError("not enough memory");
    } catch (const std::exception& error) {
        printError(error.what());
    }
    if (std::fflush(stdout) != 0 && code == 0) {
        printError("standard output cannot be written");
        code = exitCode(ErrorKind::System);
    }
    return code;
}
