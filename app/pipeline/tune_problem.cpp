#include "app/pipeline/tune_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <numeric>

#include "app/pipeline/tune_survey_loss.hpp"
#include "fusion/fixed_point_loss.hpp"

namespace terrawalk {

namespace {

/// FNV-1a.
class Fingerprint {
  public:
    void add(std::string_view text) {
        add(static_cast<std::uint64_t>(text.size()));
        for (const char c : text) addByte(static_cast<unsigned char>(c));
    }
    void add(std::uint64_t bits) {
        for (int i = 0; i < 8; ++i) addByte(static_cast<unsigned char>(bits >> (8 * i)));
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(const Eigen::Vector3d& v) {
        for (const double value : v) add(value);
    }
    void add(const std::vector<double>& values) {
        add(static_cast<std::uint64_t>(values.size()));
        for (const double value : values) add(value);
    }
    [[nodiscard]] std::uint64_t value() const { return bits_; }

  private:
    void addByte(unsigned char byte) { bits_ = (bits_ ^ byte) * 0x100000001b3ULL; }
    std::uint64_t bits_ = 0xcbf29ce484222325ULL;
};

constexpr std::array<const char*, kAllDimensions> kAukfKeys{"fusion.aukf.noise.position_e_m2",
                                                            "fusion.aukf.noise.position_n_m2",
                                                            "fusion.aukf.noise.position_u_m2",
                                                            "fusion.aukf.noise.velocity_e_m2ps2",
                                                            "fusion.aukf.noise.velocity_n_m2ps2",
                                                            "fusion.aukf.noise.velocity_u_m2ps2",
                                                            "fusion.aukf.noise.acceleration_e_m2ps4",
                                                            "fusion.aukf.noise.acceleration_n_m2ps4",
                                                            "fusion.aukf.noise.acceleration_u_m2ps4",
                                                            "fusion.aukf.unscented.alpha",
                                                            "fusion.aukf.unscented.beta",
                                                            "fusion.aukf.unscented.kappa"};

std::vector<TunableParameter> aukfParameters(const AukfOptions& options, std::size_t dimensions) {
    const CandidateBounds bounds = candidateBounds(dimensions);
    const std::vector<double> start = candidateOf(options, dimensions);
    std::vector<TunableParameter> parameters;
    for (std::size_t i = 0; i < dimensions; ++i) {
        parameters.push_back({.name = kAukfKeys[i],
                              .settings = {{kAukfKeys[i], 1.0}},
                              .logarithmic = i < kNoiseDimensions,
                              .lower = bounds.lower[i],
                              .upper = bounds.upper[i],
                              .start = start[i]});
    }
    return parameters;
}

Result<TunableProblem> aukfProblem(const Survey& survey, const PipelineConfig& config, bool hyperparameters) {
    auto loss = FixedPointLoss::prepare(survey, config.fusion);
    if (!loss) return tl::unexpected(loss.error());
    const std::size_t dimensions = hyperparameters ? kAllDimensions : kNoiseDimensions;
    constexpr std::size_t kProfilePoints = 91;  // ten to a decade of the noises' box
    TunableProblem problem{.method = "aukf",
                           .loss_meaning =
                               "squared distance between the fused position over the last still seconds of a "
                               "fixed-point run and its target mark, summed over the runs",
                           .loss_unit = "m2",
                           .parameters = aukfParameters(config.fusion.aukf, dimensions),
                           .components = {"horizontal", "vertical"},
                           .squared_metres = true,
                           .profile_points = kProfilePoints};
    for (const FixedPointRun& run : loss->runs()) {
        problem.parts.push_back({run.id, run.target});
        const bool known = std::any_of(problem.marks.begin(), problem.marks.end(),
                                       [&](const ControlMark& mark) { return mark.name == run.target; });
        if (!known) problem.marks.push_back(survey.findMark(run.target).value());
    }
    problem.losses = [dimensions, loss = *loss](std::span<const double> candidates,
                                                std::span<const std::size_t> parts, std::span<double> losses,
                                                const std::stop_token&) {
        if (parts.size() == loss.runs().size()) return loss.losses(candidates, dimensions, losses);
        loss.over(parts).losses(candidates, dimensions, losses);
    };
    return problem;
}

}  // namespace

double TunableParameter::value(double x) const {
    return logarithmic ? std::pow(10.0, x) : x;
}

double TunableParameter::notableRange() const {
    return logarithmic ? 1.0 : 0.5 * (upper - lower);
}

std::vector<double> TunableProblem::start() const {
    std::vector<double> candidate;
    for (const TunableParameter& parameter : parameters) candidate.push_back(parameter.start);
    return candidate;
}

Result<PipelineConfig> withCandidate(const TunableProblem& problem, PipelineConfig config,
                                     std::span<const double> candidate) {
    for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
        const TunableParameter& parameter = problem.parameters[i];
        for (const TunedSetting& setting : parameter.settings) {
            const double value = setting.base * parameter.value(candidate[i]);
            if (auto done = applySetting(config, fmt::format("{}={}", setting.key, value)); !done) {
                return tl::unexpected(done.error());
            }
        }
    }
    return config;
}

Result<TunableProblem> tunableProblem(const Survey& survey, const PipelineConfig& config,
                                      bool hyperparameters, const std::stop_token& stop) {
    const FusionMethod method = config.fusion.method;
    if (method == FusionMethod::Raw) {
        return usageError("raw sensors have no parameters to tune", "choose another --method");
    }
    if (hyperparameters && method != FusionMethod::Aukf) {
        return usageError("only method aukf has alpha, beta and kappa to tune",
                          "leave --hyperparameters out");
    }
    auto problem = method == FusionMethod::Aukf ? aukfProblem(survey, config, hyperparameters)
                                                : surveyProblem(survey, config, stop);
    if (!problem) return problem;
    Fingerprint print;
    print.add(surveyFingerprint(survey));
    print.add(toJson(config));
    problem->fingerprint = print.value();
    return problem;
}

std::uint64_t surveyFingerprint(const Survey& survey) {
    Fingerprint print;
    print.add(
        Eigen::Vector3d(survey.zero_point.lat_deg, survey.zero_point.lon_deg, survey.zero_point.h_ell_m));
    for (const ControlMark& mark : survey.marks) {
        print.add(mark.name);
        print.add(mark.enu_m);
        print.add(static_cast<std::uint64_t>(mark.role));
    }
    for (const Run& run : survey.runs) {
        print.add(run.id);
        print.add(static_cast<std::uint64_t>(run.kind));
        print.add(run.start.value_or(""));
        print.add(run.target.value_or(""));
        for (const Stop& stop : run.stops) {
            print.add(stop.point);
            print.add(stop.from_s);
            print.add(stop.to_s);
        }
        print.add(run.log.time_s);
        for (std::size_t c = 0; c < kChannelCount; ++c) print.add(run.log.channels[c]);
        print.add(run.log.range_lever_arm_m);
        print.add(run.log.gnss_lever_arm_m);
    }
    return print.value();
}

}  // namespace terrawalk
