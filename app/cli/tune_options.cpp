#include "app/cli/tune_options.hpp"

#include <string>

#include "app/cli/choice_option.hpp"

namespace terrawalk {

std::vector<CLI::Option*> addTuneOptions(CLI::App& command, TuneOptions& o) {
    const auto count = [&](const char* option, std::size_t& value, std::size_t least, std::size_t greatest,
                           const char* meaning) {
        return command.add_option(option, value, meaning)->check(CLI::Range(least, greatest));
    };
    CLI::Option* hyperparameters =
        command.add_flag("--hyperparameters", o.hyperparameters,
                         "aukf: tune alpha, beta and kappa as well as the nine process noises");
    return {addChoice(command, "--optimizer,--optimiser", o.optimiser, kOptimiserNames, "Who searches"),
            count("--population", o.population, 8, 100'000,
                  "Candidates that the search keeps [aukf 100, others 8]"),
            count("--iterations", o.iterations, 1, 10'000'000,
                  "How often each of them is tried anew [aukf 1000, others 6]"),
            count("--restarts", o.restarts, 1, 64, "Independent searches, each of that budget [1]"),
            hyperparameters,
            command
                .add_option_function<int>(
                    "--parameters", [&o](int n) { o.hyperparameters = n == 12; },
                    "aukf: how many are tuned; 12 is --hyperparameters")
                ->check(CLI::IsMember({9, 12}))
                ->excludes(hyperparameters)};
}

std::vector<std::string> tuneArguments(const TuneOptions& o) {
    const TuneOptions defaults;
    std::vector<std::string> arguments;
    const auto add = [&](const char* option, const auto& value, const auto& default_value,
                         const std::string& text) {
        if (value == default_value) return;
        arguments.emplace_back(option);
        arguments.push_back(text);
    };
    add("--optimizer", o.optimiser, defaults.optimiser, std::string(name(o.optimiser)));
    add("--population", o.population, defaults.population, std::to_string(o.population));
    add("--iterations", o.iterations, defaults.iterations, std::to_string(o.iterations));
    add("--restarts", o.restarts, defaults.restarts, std::to_string(o.restarts));
    if (o.hyperparameters) arguments.emplace_back("--hyperparameters");
    return arguments;
}

}  // namespace terrawalk
