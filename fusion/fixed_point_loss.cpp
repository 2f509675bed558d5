#include "fusion/fixed_point_loss.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "fusion/batch_filter_input.hpp"
#include "fusion/filter_family.hpp"
#include "fusion/positioning_model.hpp"
#include "survey/mark_stands.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array<double, 3> kLowestUnscented{0.001, 0.001, 0.001};  // alpha, beta, kappa
constexpr std::array<double, 3> kHighestUnscented{1.0, 10.0, 3.0};

// The nine numbers of the step noise in the order of a candidate.
template <class Noise>
auto noiseFields(Noise& noise) {
    return std::array{&noise.position_e_m2,        &noise.position_n_m2,        &noise.position_u_m2,
                      &noise.velocity_e_m2ps2,     &noise.velocity_n_m2ps2,     &noise.velocity_u_m2ps2,
                      &noise.acceleration_e_m2ps4, &noise.acceleration_n_m2ps4, &noise.acceleration_u_m2ps4};
}

template <class Unscented>
auto unscentedFields(Unscented& unscented) {
    return std::array{&unscented.alpha, &unscented.beta, &unscented.kappa};
}

double squared(double x) {
    return x * x;
}

// A run that takes part, as the full filters and as the kernels read it.
struct PreparedRun {
    FixedPointRun info;
    MeasuredRun measured;
    std::vector<BatchEpoch> epochs;
    std::size_t first_at_target = 0;  // of the epochs at the target, the last ones
    std::size_t last_at_target = 0;
    Eigen::Vector3d array_at_target_enu_m = Eigen::Vector3d::Zero();

    double targetCount() const { return static_cast<double>(last_at_target - first_at_target + 1); }
    SquaredError error(const Eigen::Vector3d& position_sum) const {
        const Eigen::Vector3d d = position_sum / targetCount() - array_at_target_enu_m;
        if (!d.allFinite()) return {kInfinity, kInfinity};
        return {squared(d.x()) + squared(d.y()), squared(d.z())};
    }
};

double median(std::vector<double> values) {
    if (values.empty()) return kMissing;
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

// The stand at the target that a run is walked for; nothing when the run takes no part in the loss.
std::optional<MarkStand> targetStand(const Survey& survey, const Run& run, const StandOptions& options) {
    if (run.kind != RunKind::FixedPoint) return std::nullopt;
    std::optional<MarkStand> target;
    for (const MarkStand& stand : markStands(survey, run, options)) {
        if (stand.place == StandPlace::Stop) continue;
        if (stand.mark.role == MarkRole::Check) return std::nullopt;
        if (stand.place == StandPlace::Target) target = stand;
    }
    return target;
}

Result<PreparedRun> preparedRun(const Survey& survey, const Run& run, const MarkStand& target,
                                const FusionOptions& options) {
    RunNotes notes;
    SensorLedger ledger;
    const std::vector<EpochAttitude> attitudes = epochAttitudes(run.log, options.attitude, notes);
    const auto reference = runReference(survey, run, options, attitudes, notes);
    if (!reference) return tl::unexpected<Error>(reference.error());
    PreparedRun prepared;
    prepared.info = {run.id, target.mark.name, run.log.size()};
    prepared.measured = measuredRun(survey, run, options, attitudes, *reference, ledger);
    prepared.epochs = batchEpochs(prepared.measured, options.aukf);

    const auto& times = run.log.time_s;
    prepared.first_at_target =
        static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), target.from_s) - times.begin());
    prepared.last_at_target = run.log.size() - 1;
    std::vector<double> heights;
    for (std::size_t i = prepared.first_at_target; i <= prepared.last_at_target; ++i) {
        prepared.epochs[i].at_target = 1;
        const double height_m = heightAboveGround(run.log, i, attitudes[i].attitude, options.ties);
        if (present(height_m)) heights.push_back(height_m);
    }
    const double height_m = heights.empty() ? options.ties.assumed_height_m : median(std::move(heights));
    prepared.array_at_target_enu_m = target.mark.enu_m + height_m * Eigen::Vector3d::UnitZ();
    return prepared;
}

// Whether a kernel is this filter. The square-root form is the same filter with other rounding, the adaptive
// one another filter; both run as they are.
bool hasKernel(FilterKind filter) {
    return filter == FilterKind::Ukf || filter == FilterKind::Ckf || filter == FilterKind::Ekf;
}

SquaredError fullError(const PreparedRun& run, const AukfOptions& options) {
    const auto filtered = filterRun(run.measured, options);
    if (!filtered) return {kInfinity, kInfinity};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = run.first_at_target; i <= run.last_at_target; ++i) {
        sum += filtered->states[i].block(StateBlock::Position);
    }
    return run.error(sum);
}

}  // namespace

CandidateBounds candidateBounds(std::size_t dimensions, double lowest_log10_noise,
                                double highest_log10_noise) {
    assert(dimensions == kNoiseDimensions || dimensions == kAllDimensions);
    CandidateBounds bounds;
    bounds.lower.assign(kNoiseDimensions, lowest_log10_noise);
    bounds.upper.assign(kNoiseDimensions, highest_log10_noise);
    if (dimensions == kAllDimensions) {
        bounds.lower.insert(bounds.lower.end(), kLowestUnscented.begin(), kLowestUnscented.end());
        bounds.upper.insert(bounds.upper.end(), kHighestUnscented.begin(), kHighestUnscented.end());
    }
    return bounds;
}

std::vector<double> candidateOf(const AukfOptions& options, std::size_t dimensions) {
    assert(dimensions == kNoiseDimensions || dimensions == kAllDimensions);
    std::vector<double> candidate;
    for (const double* q : noiseFields(options.noise)) candidate.push_back(std::log10(*q));
    if (dimensions == kAllDimensions) {
        for (const double* parameter : unscentedFields(options.unscented)) candidate.push_back(*parameter);
    }
    return candidate;
}

AukfOptions withCandidate(AukfOptions options, std::span<const double> candidate) {
    assert(candidate.size() == kNoiseDimensions || candidate.size() == kAllDimensions);
    const auto noise = noiseFields(options.noise);
    for (std::size_t i = 0; i < noise.size(); ++i) *noise[i] = std::pow(10.0, candidate[i]);
    if (candidate.size() == kAllDimensions) {
        const auto unscented = unscentedFields(options.unscented);
        for (std::size_t i = 0; i < unscented.size(); ++i) *unscented[i] = candidate[kNoiseDimensions + i];
    }
    return options;
}

struct FixedPointLoss::Prepared {
    AukfOptions options;
    std::vector<PreparedRun> runs;
};

FixedPointLoss::FixedPointLoss(std::shared_ptr<const Prepared> prepared, std::vector<std::size_t> chosen)
    : prepared_(std::move(prepared)), chosen_(std::move(chosen)) {
    for (const std::size_t run : chosen_) runs_.push_back(prepared_->runs[run].info);
}

Result<FixedPointLoss> FixedPointLoss::prepare(const Survey& survey, const FusionOptions& options) {
    FusionOptions aukf = options;
    aukf.method = FusionMethod::Aukf;
    auto prepared = std::make_shared<Prepared>();
    prepared->options = options.aukf;
    for (const Run& run : survey.runs) {
        const auto target = targetStand(survey, run, options.stands);
        if (!target) continue;
        auto ready = preparedRun(survey, run, *target, aukf);
        if (!ready) return tl::unexpected<Error>(std::move(ready.error()));
        prepared->runs.push_back(std::move(*ready));
    }
    if (prepared->runs.empty()) {
        return badData("the survey has no fixed-point run between control marks", survey.project_file, 0,
                       "tuning needs runs of kind fixed_point whose target is a control mark");
    }
    std::vector<std::size_t> all(prepared->runs.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return FixedPointLoss(std::move(prepared), std::move(all));
}

std::size_t FixedPointLoss::epochs() const {
    return std::accumulate(runs_.begin(), runs_.end(), std::size_t{0},
                           [](std::size_t n, const FixedPointRun& run) { return n + run.epochs; });
}

FixedPointLoss FixedPointLoss::over(std::span<const std::size_t> runs) const {
    std::vector<std::size_t> chosen;
    for (const std::size_t run : runs) chosen.push_back(chosen_.at(run));
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return {prepared_, std::move(chosen)};
}

FixedPointLoss FixedPointLoss::without(std::size_t run) const {
    std::vector<std::size_t> chosen = chosen_;
    chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(run));
    return {prepared_, std::move(chosen)};
}

void FixedPointLoss::errors(std::span<const double> candidates, std::size_t dimensions,
                            std::span<SquaredError> errors) const {
    assert(dimensions == kNoiseDimensions || dimensions == kAllDimensions);
    const std::size_t n = candidates.size() / dimensions;
    const std::size_t runs = chosen_.size();
    assert(candidates.size() == n * dimensions && errors.size() == n * runs);
    std::vector<AukfOptions> options(n);
    for (std::size_t c = 0; c < n; ++c) {
        options[c] = withCandidate(prepared_->options, candidates.subspan(c * dimensions, dimensions));
    }
    const auto run = [&](std::size_t r) -> const PreparedRun& {
        return prepared_->runs[chosen_[r]];
    };
    if (!hasKernel(prepared_->options.filter)) {
        parallelFor(n * runs, [&](std::size_t task) {
            errors[task] = fullError(run(task % runs), options[task / runs]);
        });
        return;
    }
    const InstructionSet set = widestInstructionSet();
    const std::size_t lanes = laneCount(set);
    const std::size_t groups = (n + lanes - 1) / lanes;
    std::vector<BatchCandidate> batch(n);
    std::transform(options.begin(), options.end(), batch.begin(), batchCandidate);
    parallelFor(groups * runs, [&](std::size_t task) {
        const std::size_t r = task % runs;
        const std::size_t first = task / runs * lanes;
        const std::size_t count = std::min(lanes, n - first);
        std::array<double, 3 * kMostLanes> sums{};
        filterBatch(set, batchRun(run(r).measured, run(r).epochs, prepared_->options), &batch[first], count,
                    sums.data(), nullptr);
        for (std::size_t i = 0; i < count; ++i) {
            errors[(first + i) * runs + r] = run(r).error(Eigen::Map<const Eigen::Vector3d>(&sums[3 * i]));
        }
    });
}

void FixedPointLoss::losses(std::span<const double> candidates, std::size_t dimensions,
                            std::span<double> losses) const {
    const std::size_t n = candidates.size() / dimensions;
    assert(losses.size() == 2 * n);
    std::vector<SquaredError> each(n * chosen_.size());
    errors(candidates, dimensions, each);
    for (std::size_t c = 0; c < n; ++c) {
        SquaredError sum;
        for (std::size_t r = 0; r < chosen_.size(); ++r) {
            sum.horizontal_m2 += each[c * chosen_.size() + r].horizontal_m2;
            sum.vertical_m2 += each[c * chosen_.size() + r].vertical_m2;
        }
        losses[2 * c] = sum.horizontal_m2;
        losses[2 * c + 1] = sum.vertical_m2;
    }
}

SquaredError FixedPointLoss::loss(std::span<const double> candidate) const {
    std::array<double, 2> sums{};
    losses(candidate, candidate.size(), sums);
    return {sums[0], sums[1]};
}

std::vector<SquaredError> FixedPointLoss::runLosses(std::span<const double> candidate) const {
    std::vector<SquaredError> each(chosen_.size());
    errors(candidate, candidate.size(), each);
    return each;
}

double FixedPointLoss::rmse(double loss_m2) const {
    return std::sqrt(loss_m2 / static_cast<double>(chosen_.size()));
}

}  // namespace terrawalk
