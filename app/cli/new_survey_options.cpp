#include "app/cli/new_survey_options.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace terrawalk {

namespace {

void addTarget(const std::string& text, NewSurveyRequest& r) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw CLI::ValidationError("--target", "write RUN=MARK, such as F01=P01");
    r.targets[text.substr(0, equals)] = text.substr(equals + 1);
}

void takeZero(const std::vector<double>& numbers, NewSurveyRequest& r) {
    const GeodeticPosition zero{numbers[0], numbers[1], numbers[2]};
    const bool on_earth = std::abs(zero.lat_deg) <= 90.0 && std::abs(zero.lon_deg) <= 180.0 &&
                          zero.h_ell_m >= -1000.0 && zero.h_ell_m <= 10000.0;
    if (!on_earth)
        throw CLI::ValidationError("--zero", "write latitude, longitude and ellipsoidal height in m");
    r.zero_point = zero;
}

}  // namespace

void addNewSurveyOptions(CLI::App& command, NewSurveyRequest& r) {
    command.add_option("logs", r.files, "Array logs, tables of marks, and folders that hold them")
        ->required();
    command.add_option("--marks", r.marks, "Table of marks [the one among LOGS]")->type_name("FILE");
    command
        .add_option("-o,--output", r.output,
                    "survey.json to write, or its folder [in the folder that holds all files]")
        ->type_name("FILE");
    command.add_option("--name", r.name, "Of the survey [its folder's name]");
    command
        .add_option_function<std::vector<double>>(
            "--zero", [&r](const std::vector<double>& numbers) { takeZero(numbers, r); },
            "Zero point of the marks, ellipsoidal height [where most walks start]")
        ->delimiter(',')
        ->expected(3)
        ->type_name("LAT,LON,HEIGHT");
    command.add_option("--crs", r.crs, "Map frame; \"\" for the local frame [UTM zone of the zero point]");
    command
        .add_option_function<std::vector<std::string>>(
            "--target",
            [&r](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) addTarget(text, r);
            },
            "A fixed-point run and the mark that it ends on [guessed]")
        ->allow_extra_args(false)
        ->type_name("RUN=MARK");
    command.add_option("--area", r.area_runs, "A run that is an area walk [guessed]")
        ->allow_extra_args(false)
        ->type_name("RUN");
    command.add_flag("--replace", r.replace, "Write over a survey.json that is there");
}

}  // namespace terrawalk
