#include "app/cli/simulate_options.hpp"

#include <array>

#include "app/cli/choice_option.hpp"

namespace terrawalk {

void addSimulationOptions(CLI::App& command, SimulationOptions& o) {
    command.add_option("--seed", o.seed, "Of all random numbers")->capture_default_str();
    addChoice(command, "--terrain", o.terrain, kSimulatedTerrainNames, "Shape of the ground");
    addChoice(command, "--faults", o.faults, kFaultLevelNames, "How bad the day is");
    addChoice(command, "--gnss", o.gnss, kGnssModeNames, "What the receiver reaches");
    addChoices(command, "--disturb", o.disturbances, kDisturbanceNames,
               "Errors that no level of faults has, e.g. gnss-drift,flow-spikes");
    const auto number = [&](const char* option, double& value, double least, double greatest,
                            const char* meaning) {
        command.add_option(option, value, meaning)->check(CLI::Range(least, greatest))->capture_default_str();
    };
    const auto count = [&](const char* option, std::size_t& value, std::size_t least, std::size_t greatest,
                           const char* meaning) {
        command.add_option(option, value, meaning)->check(CLI::Range(least, greatest))->capture_default_str();
    };
    number("--noise-scale", o.noise_scale, 0, 100, "Factor on every error; 0: exact sensors");
    number("--area-east", o.area_east_m, 10, 5000, "East-west size of the walked area, m");
    number("--area-north", o.area_north_m, 10, 5000, "North-south size of the walked area, m");
    number("--line-spacing", o.line_spacing_m, 1.5, 100, "Between the lines of the area walk, m");
    number("--interval", o.sample_interval_s, 0.01, 5, "Between records, s");
    count("--fixed-runs", o.fixed_point_runs, 0, 99, "Fixed-point runs");
    count("--fixed-epochs", o.fixed_point_epochs, 60, 1'000'000, "Records in each fixed-point run");
    count("--area-epochs", o.area_epochs, 0, 10'000'000, "Records in the area walk; 0: no area walk");
    count("--control-stops", o.control_stops, 0, 50, "Stops of the area walk on control marks");
    count("--check-stops", o.check_stops, 0, 50, "Stops of the area walk on check marks");
    count("--check-points", o.check_points, 0, 100'000, "Check marks over the area");
    const auto lever = [&](const char* option, Eigen::Vector3d& value, const char* meaning) {
        command
            .add_option_function<std::array<double, 3>>(
                option,
                [&value](const std::array<double, 3>& xyz) {
                    value = {xyz[0], xyz[1], xyz[2]};
                },
                meaning)
            ->type_name("X Y Z");
    };
    lever("--range-lever-arm", o.range_lever_arm_m, "Range finder in the body frame, m");
    lever("--gnss-lever-arm", o.gnss_lever_arm_m, "GNSS antenna in the body frame, m");
    command.add_flag("--end-on-zero,!--end-anywhere", o.end_on_zero, "Whether the area walk ends on ZERO");
    command.add_flag("--doppler", o.doppler_velocity, "The receiver gives its velocity as well");
}

}  // namespace terrawalk
