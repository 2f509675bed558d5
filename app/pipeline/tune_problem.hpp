#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/config.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// One setting of the configuration as a tuner turns it: value = base * v.
struct TunedSetting {
    std::string key;  ///< such as "fusion.aukf.noise.position_e_m2"
    double base = 1.0;
};

/// A number that is searched. v = 10^x where it is logarithmic, else x.
struct TunableParameter {
    std::string name;
    std::vector<TunedSetting> settings;  ///< all of them move together
    bool logarithmic = true;
    double lower = 0.0;  ///< of x
    double upper = 0.0;
    double start = 0.0;  ///< x of the configuration as it is; may lie outside the bounds

    [[nodiscard]] double value(double x) const;  ///< v
    /// A decade of a logarithmic parameter, half the box of another: a range over which a value that the
    /// data know changes the loss.
    [[nodiscard]] double notableRange() const;
};

/// A share of the data that the loss is summed over and that can be left out and tested on, such as a
/// fixed-point run.
struct TunablePart {
    std::string name;
    std::string mark;  ///< control mark that it is compared with; empty where there is none
};

/// What a tuner needs to know of a method: what may be turned, and how well it does.
struct TunableProblem {
    std::string method;
    std::string loss_meaning;  ///< one line for the reader
    std::string loss_unit;
    std::vector<TunableParameter> parameters;  ///< d
    std::vector<TunablePart> parts;
    std::vector<ControlMark> marks;  ///< that the losses look at; never check marks
    /// m; their sum is made small.
    std::vector<std::string> components;
    /// Sums over the chosen parts, for each candidate: `candidates` is n x d, `losses` n x m. Infinite where
    /// the method fails. Pure, but for what it leaves unfinished when a stop is requested; safe from any
    /// thread.
    std::function<void(std::span<const double> candidates, std::span<const std::size_t> parts,
                       std::span<double> losses, const std::stop_token& stop)>
        losses;
    bool squared_metres = false;     ///< the root of the mean over the parts is an error in metres
    std::size_t profile_points = 0;  ///< places at which each parameter's effect is looked at
    /// What a search takes when nothing else is asked for.
    std::size_t usual_population = 100;
    std::size_t usual_iterations = 1000;
    /// Into so many groups the parts are dealt; each group is left out once. 0: each part by itself.
    std::size_t left_out_groups = 0;
    std::uint64_t fingerprint = 0;  ///< of data and settings

    [[nodiscard]] std::vector<double> start() const;
};

/// The configuration with a candidate in it.
[[nodiscard]] Result<PipelineConfig> withCandidate(const TunableProblem& problem, PipelineConfig config,
                                                   std::span<const double> candidate);

/// What the configured method has to tune on this survey.
///
/// aukf: the nine process noises of paper 000, eq 12, and with `hyperparameters` alpha, beta and kappa as
/// well; loss over the fixed-point runs.
///
/// Other filters: factors on the sigmas and correlation times of their sensors; loss at the control marks,
/// each while the estimator knows nothing of it. Where passes of the walk meet is no such test: tracks that
/// agree better with each other were farther from the truth on simulated surveys.
///
/// Errors: Usage for raw, and for `hyperparameters` where there are none; BadData for a survey without data
/// to tune on; as fuseSurvey(); Cancelled.
[[nodiscard]] Result<TunableProblem> tunableProblem(const Survey& survey, const PipelineConfig& config,
                                                    bool hyperparameters, const std::stop_token& stop);

/// Decided by everything that fusion reads of a survey.
[[nodiscard]] std::uint64_t surveyFingerprint(const Survey& survey);

}  // namespace terrawalk
