#include "app/pipeline/tune_survey_loss.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "fusion/fuse_survey.hpp"
#include "fusion/sensor_readings.hpp"
#include "mapping/order_statistics.hpp"
#include "survey/mark_stands.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestFactor = 5.0;
constexpr std::size_t kPopulation = 8;
constexpr std::size_t kIterations = 6;
constexpr std::size_t kLeftOutGroups = 3;
constexpr std::size_t kProfilePoints = 5;
constexpr std::size_t kCandidatesAtOnce = 4;

/// Settings that stand for one physical quantity and are turned together.
struct Factor {
    std::string name;
    std::vector<std::string> keys;
};

std::vector<Factor> factorsOf(FusionMethod method) {
    std::vector<Factor> factors{
        {"GNSS error",
         {"fusion.gnss.sigma_single_m", "fusion.gnss.sigma_differential_m", "fusion.gnss.sigma_float_m",
          "fusion.gnss.sigma_fixed_m", "fusion.gnss.sigma_single_up_m", "fusion.gnss.sigma_differential_up_m",
          "fusion.gnss.sigma_float_up_m", "fusion.gnss.sigma_fixed_up_m"}},
        {"barometer drift", {"fusion.barometer.drift_m_per_sqrt_min"}},
        {"barometer gusts", {"fusion.barometer.gust_sigma_m"}},
        {"flow variance", {"fusion.flow.variance_m2ps2", "fusion.flow.variance_per_v2"}},
    };
    const std::vector<Factor> of_filter{
        {"GNSS correlation time", {"fusion.gnss.correlation_s", "fusion.gnss.correlation_fixed_s"}},
        {"heading error", {"fusion.attitude.sigma_heading_deg"}},
        {"flow scale error", {"fusion.flow.scale_sigma"}},
        {"velocity process noise",
         {"fusion.process.noise.velocity_e_m2ps3", "fusion.process.noise.velocity_n_m2ps3",
          "fusion.process.noise.velocity_u_m2ps3"}},
    };
    const std::vector<Factor> of_adjustment{
        {"GNSS correlation time", {"fusion.lasting.gnss_correlation_s"}},
        {"heading error",
         {"fusion.lasting.heading_sigma_deg", "fusion.lasting.hard_iron_sigma_deg",
          "fusion.lasting.hard_iron_run_sigma_deg"}},
        {"flow scale error", {"fusion.lasting.flow_scale_sigma", "fusion.lasting.flow_axes_sigma"}},
        {"crossover misfit",
         {"fusion.joint.pair_sigma_m", "fusion.joint.pair_uneven_m", "fusion.joint.pair_apart_per_m"}},
    };
    const auto& more = method == FusionMethod::Terrawalk ? of_adjustment : of_filter;
    factors.insert(factors.end(), more.begin(), more.end());
    return factors;
}

std::vector<TunableParameter> parametersOf(const PipelineConfig& config) {
    const auto settings = nlohmann::json::parse(toJson(config));
    const double bound = std::log10(kLargestFactor);
    std::vector<TunableParameter> parameters;
    for (const Factor& factor : factorsOf(config.fusion.method)) {
        TunableParameter parameter{.name = factor.name + " (factor)", .lower = -bound, .upper = bound};
        for (const std::string& key : factor.keys) {
            std::string pointer = "/" + key;
            std::replace(pointer.begin(), pointer.end(), '.', '/');
            parameter.settings.push_back({key, settings.at(nlohmann::json::json_pointer(pointer))});
        }
        parameters.push_back(std::move(parameter));
    }
    return parameters;
}

double squared(double x) {
    return x * x;
}

// ------------------------------------------------------------------------------- where the marks tell

/// A stand on a mark that the estimator could be tied to, or whose error a fixed-point run is walked for.
struct TestStand {
    std::size_t run = 0;
    MarkStand stand;
    std::size_t part = 0;  ///< mark
};

/// Marks are dealt to folds; in a fold the estimator knows nothing of its marks.
constexpr std::size_t kFolds = 2;

std::vector<TestStand> testStands(const Survey& survey, const StandOptions& options,
                                  std::vector<ControlMark>& marks) {
    std::vector<TestStand> stands;
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        for (const MarkStand& stand : markStands(survey, survey.runs[i], options)) {
            if (stand.mark.role == MarkRole::Check || stand.mark.name == kZeroMark) continue;
            if (stand.place == StandPlace::Start) continue;
            const auto known = std::find_if(marks.begin(), marks.end(), [&](const ControlMark& mark) {
                return mark.name == stand.mark.name;
            });
            stands.push_back({i, stand, static_cast<std::size_t>(known - marks.begin())});
            if (known == marks.end()) marks.push_back(stand.mark);
        }
    }
    return stands;
}

/// The survey as it would be had nobody measured these marks.
Survey withoutMarks(Survey survey, const std::vector<ControlMark>& marks, std::size_t fold) {
    const auto leftOut = [&](const std::string& name) {
        for (std::size_t part = fold; part < marks.size(); part += kFolds) {
            if (marks[part].name == name) return true;
        }
        return false;
    };
    for (Run& run : survey.runs) {
        if (run.target && leftOut(*run.target)) run.target.reset();
        std::erase_if(run.stops, [&](const Stop& stop) { return leftOut(stop.point); });
        if (run.start && leftOut(*run.start)) run.start.reset();
    }
    std::erase_if(survey.marks, [&](const ControlMark& mark) { return leftOut(mark.name); });
    return survey;
}

/// Squared distance between the mark and the ground below the array, mean over the stand: in plan, in height.
std::array<double, 2> standError(const Run& run, const Trajectory& trajectory, const MarkStand& stand,
                                 const TieOptions& ties) {
    Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
    double n = 0.0;
    std::vector<double> heights_m;
    for (std::size_t i = 0; i < trajectory.epochs.size(); ++i) {
        const TrajectoryEpoch& epoch = trajectory.epochs[i];
        if (epoch.time_s < stand.from_s || epoch.time_s > stand.to_s) continue;
        sum_m += epoch.position_enu_m;
        n += 1.0;
        const double height_m = heightAboveGround(run.log, i, epoch.attitude, ties);
        if (present(height_m)) heights_m.push_back(height_m);
    }
    if (n == 0.0) return {0.0, 0.0};
    const double height_m = heights_m.empty() ? ties.assumed_height_m : median(std::move(heights_m));
    const Eigen::Vector3d d_m = sum_m / n - height_m * Eigen::Vector3d::UnitZ() - stand.mark.enu_m;
    return {d_m.head<2>().squaredNorm(), squared(d_m.z())};
}

/// Losses of every part, row after row.
using PartLosses = std::vector<double>;
/// Nothing where the method fails or a stop was requested.
using Evaluation = std::function<std::optional<PartLosses>(const FusionOptions&, const std::stop_token&)>;

struct Measured {
    std::vector<TunablePart> parts;
    std::vector<ControlMark> marks;
    Evaluation evaluate;
    std::string loss_meaning;
    std::vector<std::string> components;
};

std::optional<Measured> measuredAtMarks(const Survey& survey, const FusionOptions& fusion) {
    Measured measured;
    auto stands = std::make_shared<std::vector<TestStand>>(testStands(survey, fusion.stands, measured.marks));
    if (measured.marks.size() < kFolds) return std::nullopt;
    for (const ControlMark& mark : measured.marks) measured.parts.push_back({mark.name, mark.name});
    auto folds = std::make_shared<std::vector<Survey>>();
    for (std::size_t fold = 0; fold < kFolds; ++fold) {
        folds->push_back(withoutMarks(survey, measured.marks, fold));
    }
    measured.loss_meaning =
        "squared distance between the ground below the array and the control marks that it stood on, each "
        "while half of the marks were unknown to the estimator, this one among them; horizontal and vertical "
        "each as a share of what it was before";
    measured.components = {"horizontal", "vertical"};
    measured.evaluate = [stands, folds, parts = measured.parts.size()](
                            const FusionOptions& options,
                            const std::stop_token& stop) -> std::optional<PartLosses> {
        std::array<Result<FusedSurvey>, kFolds> fused{cancelled(), cancelled()};
        parallelFor(kFolds, [&](std::size_t fold) {
            SilentProgress silent;
            fused[fold] = fuseSurvey((*folds)[fold], options, silent, stop);
        });
        PartLosses losses(parts * 2, 0.0);
        for (const TestStand& test : *stands) {
            const std::size_t fold = test.part % kFolds;
            if (!fused[fold]) return std::nullopt;
            const auto error = standError((*folds)[fold].runs[test.run],
                                          fused[fold]->runs[test.run].trajectory, test.stand, options.ties);
            for (std::size_t k = 0; k < 2; ++k) losses[test.part * 2 + k] += error[k];
        }
        return losses;
    };
    return measured;
}

// -------------------------------------------------------------------------------------- the problem

/// Fuses for each new candidate and remembers what came out: searches over other parts begin with the same
/// candidates. Thread-safe.
class RememberedLosses {
  public:
    RememberedLosses(Evaluation evaluate, std::vector<TunableParameter> parameters, PipelineConfig config,
                     std::size_t losses)
        : evaluate_(std::move(evaluate)), config_(std::move(config)), losses_(losses) {
        problem_.parameters = std::move(parameters);
    }

    [[nodiscard]] PartLosses of(std::span<const double> candidate, const std::stop_token& stop) {
        const std::vector<double> key(candidate.begin(), candidate.end());
        {
            const std::lock_guard lock(mutex_);
            if (const auto found = known_.find(key); found != known_.end()) return found->second;
        }
        const PartLosses failed(losses_, kInfinity);
        const auto config = withCandidate(problem_, config_, candidate);
        if (!config) return failed;
        auto losses = evaluate_(config->fusion, stop);
        if (stop.stop_requested()) return failed;
        const std::lock_guard lock(mutex_);
        return known_.emplace(key, losses.value_or(failed)).first->second;
    }

  private:
    Evaluation evaluate_;
    TunableProblem problem_;  // its parameters alone
    PipelineConfig config_;
    std::size_t losses_;
    std::mutex mutex_;
    std::map<std::vector<double>, PartLosses> known_;
};

/// Each component as a share of its sum over all parts before, so that metres of plan do not drown
/// decimetres of height.
std::vector<double> scalesOf(const PartLosses& before, std::size_t components) {
    std::vector<double> scales(components, 0.0);
    for (std::size_t i = 0; i < before.size(); ++i) scales[i % components] += before[i];
    for (double& scale : scales) scale = scale > 0.0 ? scale : 1.0;
    return scales;
}

}  // namespace

Result<TunableProblem> surveyProblem(const Survey& survey, const PipelineConfig& config,
                                     const std::stop_token& stop) {
    const auto measured = measuredAtMarks(survey, config.fusion);
    if (!measured) {
        return badData("the survey stands on fewer than two control marks beside ZERO", survey.project_file,
                       0, "stand on two or more, in stops or at the ends of fixed-point runs");
    }
    TunableProblem problem{.method = std::string(name(config.fusion.method)),
                           .loss_meaning = measured->loss_meaning,
                           .parameters = parametersOf(config),
                           .parts = measured->parts,
                           .marks = measured->marks,
                           .components = measured->components,
                           .profile_points = kProfilePoints,
                           .candidates_at_once = kCandidatesAtOnce,
                           .usual_population = kPopulation,
                           .usual_iterations = kIterations,
                           .left_out_groups = kLeftOutGroups};
    const std::size_t d = problem.parameters.size();
    const std::size_t m = problem.components.size();
    auto remembered = std::make_shared<RememberedLosses>(measured->evaluate, problem.parameters, config,
                                                         problem.parts.size() * m);
    const PartLosses before = remembered->of(problem.start(), stop);
    if (stop.stop_requested()) return cancelled();
    const auto scales = scalesOf(before, m);
    problem.losses = [remembered, scales, d, m](std::span<const double> candidates,
                                                std::span<const std::size_t> parts, std::span<double> losses,
                                                const std::stop_token& of) {
        parallelFor(candidates.size() / d, [&](std::size_t c) {
            const std::span<double> sums = losses.subspan(c * m, m);
            std::fill(sums.begin(), sums.end(), kInfinity);
            if (of.stop_requested()) return;
            const PartLosses each = remembered->of(candidates.subspan(c * d, d), of);
            std::fill(sums.begin(), sums.end(), 0.0);
            for (const std::size_t part : parts) {
                for (std::size_t k = 0; k < m; ++k) sums[k] += each[part * m + k] / scales[k];
            }
        });
    };
    return problem;
}

}  // namespace terrawalk
