#include "mapping/cross_validation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <tuple>

#include "mapping/constrained_tin.hpp"
#include "mapping/delaunay_tin.hpp"
#include "mapping/order_statistics.hpp"
#include "mapping/plan_kd_tree.hpp"
#include "mapping/point_order.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kLeastPoints = 10;
constexpr std::size_t kPlacesBetweenStops = 4096;
/// Points left out one by one share a round when neither is among so many nearest of the other: no local
/// method sees that far.
constexpr std::size_t kApart = 40;
constexpr double kSpacingsPerBlock = 5.0;

/// Indices of points left out together, rising.
using Round = std::vector<std::uint32_t>;

std::vector<std::uint32_t> shuffled(std::size_t count, std::mt19937_64& engine) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[engine() % i]);
    return order;
}

std::vector<Round> leaveOneOutRounds(const std::vector<Eigen::Vector3d>& points_m, std::size_t most_points,
                                     std::size_t most_rounds, std::mt19937_64& engine) {
    const PlanKdTree tree(points_m);
    std::vector<std::uint32_t> waiting = shuffled(points_m.size(), engine);
    waiting.resize(std::min(waiting.size(), most_points));
    std::vector<Round> rounds;
    std::vector<Neighbour> near;
    while (!waiting.empty() && rounds.size() < most_rounds) {
        std::vector<std::uint8_t> blocked(points_m.size(), 0), chosen(points_m.size(), 0);
        std::vector<std::uint32_t> later;
        Round round;
        for (const std::uint32_t point : waiting) {
            tree.nearest(points_m[point].head<2>(), kApart, near);
            const bool apart = blocked[point] == 0 &&
                               std::none_of(near.begin(), near.end(), [&](const Neighbour& neighbour) {
                                   return chosen[neighbour.point] != 0;
                               });
            if (!apart) {
                later.push_back(point);
                continue;
            }
            for (const Neighbour& neighbour : near) blocked[neighbour.point] = 1;
            chosen[point] = 1;
            round.push_back(point);
        }
        std::sort(round.begin(), round.end());
        rounds.push_back(std::move(round));
        waiting = std::move(later);
    }
    return rounds;
}

std::vector<Round> randomRounds(std::size_t count, std::size_t folds, std::mt19937_64& engine) {
    const std::vector<std::uint32_t> order = shuffled(count, engine);
    std::vector<Round> rounds(folds);
    for (std::size_t i = 0; i < count; ++i) rounds[i % folds].push_back(order[i]);
    for (Round& round : rounds) std::sort(round.begin(), round.end());
    return rounds;
}

std::vector<Round> blockRounds(const std::vector<Eigen::Vector3d>& points_m, double block_m,
                               std::size_t folds, std::mt19937_64& engine) {
    // Blocks in the order of rows and columns, dealt out like cards after a shuffle: parts of equal count.
    Eigen::Vector2d low = points_m.front().head<2>();
    for (const Eigen::Vector3d& point : points_m) low = low.cwiseMin(point.head<2>());
    struct InBlock {
        double row;
        double column;
        std::uint32_t point;
    };
    std::vector<InBlock> entries(points_m.size());
    for (std::size_t i = 0; i < points_m.size(); ++i) {
        entries[i] = {std::floor((points_m[i].y() - low.y()) / block_m),
                      std::floor((points_m[i].x() - low.x()) / block_m), static_cast<std::uint32_t>(i)};
    }
    std::sort(entries.begin(), entries.end(), [](const InBlock& a, const InBlock& b) {
        return std::tie(a.row, a.column, a.point) < std::tie(b.row, b.column, b.point);
    });
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const bool starts =
            i == 0 || entries[i].row != entries[i - 1].row || entries[i].column != entries[i - 1].column;
        if (starts) begins.push_back(i);
    }
    begins.push_back(entries.size());
    const std::vector<std::uint32_t> order = shuffled(begins.size() - 1, engine);
    std::vector<Round> rounds(folds);
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t k = begins[order[i]]; k < begins[order[i] + 1]; ++k) {
            rounds[i % folds].push_back(entries[k].point);
        }
    }
    std::erase_if(rounds, [](const Round& round) { return round.empty(); });
    for (Round& round : rounds) std::sort(round.begin(), round.end());
    return rounds;
}

/// What is left, and the places to foretell, in curve order: each near the one before.
struct Split {
    PlacedHeights kept;
    std::vector<Eigen::Vector2d> places_m;
    std::vector<double> heights_m;
    std::shared_ptr<const ConstrainedTin> constrained;  ///< of what is left, along the breaklines
};

Split splitBy(const PlacedHeights& points, const Round& round) {
    Split split;
    auto next = round.begin();
    for (std::uint32_t i = 0; i < points.points_m.size(); ++i) {
        if (next != round.end() && *next == i) {
            ++next;
            split.places_m.emplace_back(points.points_m[i].head<2>());
            split.heights_m.push_back(points.points_m[i].z());
        } else {
            split.kept.points_m.push_back(points.points_m[i]);
            if (!points.sigmas_m.empty()) split.kept.sigmas_m.push_back(points.sigmas_m[i]);
        }
    }
    return split;
}

using Errors = std::vector<double>;

/// Errors of one method in one round; not finite outside the hull.
Result<Errors> errorsOf(InterpolationMethod method, const Split& split,
                        const InterpolationOptions& interpolation, const std::stop_token& stop) {
    SilentProgress silent;
    const auto surface =
        split.constrained && followsBreaklines(method)
            ? fitInterpolator(method, split.constrained, stop)
            : fitInterpolator(method, split.kept.points_m, split.kept.sigmas_m, interpolation, silent, stop);
    if (!surface) return tl::unexpected(surface.error());
    std::vector<HeightEstimate> estimates(split.places_m.size());
    for (std::size_t i = 0; i < estimates.size(); i += kPlacesBetweenStops) {
        if (stop.stop_requested()) return cancelled();
        const std::size_t count = std::min(kPlacesBetweenStops, estimates.size() - i);
        (*surface)->estimate(std::span(split.places_m).subspan(i, count),
                             std::span(estimates).subspan(i, count));
    }
    Errors errors(estimates.size());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        errors[i] = estimates[i].height_m - split.heights_m[i];
    }
    return errors;
}

HoldOutScore scoreOf(const Errors& errors) {
    HoldOutScore score;
    std::vector<double> absolute;
    double squares = 0.0;
    for (const double error : errors) {
        squares += error * error;
        score.mean_m += error;
        score.mean_absolute_m += std::abs(error);
        absolute.push_back(std::abs(error));
    }
    const auto count = static_cast<double>(errors.size());
    score.rmse_m = std::sqrt(squares / count);
    score.mean_m /= count;
    score.mean_absolute_m /= count;
    std::sort(absolute.begin(), absolute.end());
    score.error95_m = quantileOfSorted(absolute, 0.95);
    return score;
}

/// One after another over all rounds; only points that every method foretold count.
HoldOutResult resultOf(HoldOut hold_out, std::size_t method_count,
                       const std::vector<std::vector<Errors>>& errors_by_round) {
    HoldOutResult result{hold_out, errors_by_round.size(), 0, 0, {}};
    std::vector<Errors> all(method_count);
    for (const std::vector<Errors>& round : errors_by_round) {
        for (std::size_t i = 0; i < round.front().size(); ++i) {
            const bool everywhere = std::all_of(
                round.begin(), round.end(), [&](const Errors& errors) { return std::isfinite(errors[i]); });
            ++(everywhere ? result.compared : result.outside);
            if (!everywhere) continue;
            for (std::size_t m = 0; m < method_count; ++m) all[m].push_back(round[m][i]);
        }
    }
    if (result.compared == 0) return result;
    for (const Errors& errors : all) result.scores.push_back(scoreOf(errors));
    return result;
}

/// The triangles of a split along the breaklines, where there are any.
std::optional<Error> followLines(Split& split, const std::vector<Breakline>& breaklines,
                                 const std::stop_token& stop) {
    if (breaklines.empty()) return std::nullopt;
    SilentProgress silent;
    auto tin = buildConstrainedTin(split.kept.points_m, breaklines, {}, silent, stop);
    if (!tin) return tin.error();
    split.constrained = std::make_shared<const ConstrainedTin>(std::move(*tin));
    return std::nullopt;
}

Result<HoldOutResult> runHoldOut(HoldOut hold_out, const std::vector<Round>& rounds,
                                 const PlacedHeights& points, const std::vector<InterpolationMethod>& methods,
                                 const std::vector<Breakline>& breaklines,
                                 const InterpolationOptions& interpolation, Progress& progress,
                                 const std::stop_token& stop) {
    std::vector<std::vector<Errors>> errors(rounds.size(), std::vector<Errors>(methods.size()));
    std::vector<std::optional<Error>> failures(rounds.size() * methods.size());
    std::atomic<std::size_t> done = 0;
    parallelFor(rounds.size(), [&](std::size_t round) {
        Split split = splitBy(points, rounds[round]);
        failures[round * methods.size()] = followLines(split, breaklines, stop);
        if (failures[round * methods.size()]) return;
        parallelFor(methods.size(), [&](std::size_t m) {
            if (stop.stop_requested()) return;
            auto found = errorsOf(methods[m], split, interpolation, stop);
            if (found) {
                errors[round][m] = std::move(*found);
            } else {
                failures[round * methods.size() + m] = found.error();
            }
            progress.report(static_cast<double>(++done) / static_cast<double>(failures.size()),
                            "cross-validating");
        });
    });
    if (stop.stop_requested()) return cancelled();
    for (const std::optional<Error>& failure : failures) {
        if (failure) return tl::unexpected(*failure);
    }
    return resultOf(hold_out, methods.size(), errors);
}

/// Rounds that fit in what may be fitted, at least one.
void limitRounds(std::vector<Round>& rounds, std::size_t points, std::size_t most_fitted_points) {
    const std::size_t affordable = std::max<std::size_t>(1, most_fitted_points / points);
    if (rounds.size() > affordable) rounds.resize(affordable);
}

std::vector<InterpolationMethod> ranked(const CrossValidation& validation) {
    std::vector<double> sum_of_logs(validation.methods.size(), 0.0);
    for (const HoldOutResult& result : validation.results) {
        for (std::size_t m = 0; m < sum_of_logs.size(); ++m) {
            // A method without any error on the points given, as on level ground, is not infinitely good.
            sum_of_logs[m] += std::log(std::max(result.scores[m].rmse_m, 1e-12));
        }
    }
    std::vector<std::size_t> order(sum_of_logs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sum_of_logs[a] < sum_of_logs[b]; });
    std::vector<InterpolationMethod> ranking;
    for (const std::size_t m : order) ranking.push_back(validation.methods[m]);
    return ranking;
}

}  // namespace

std::string_view name(HoldOut hold_out) {
    for (const auto& [candidate, text] : kHoldOuts) {
        if (candidate == hold_out) return text;
    }
    return "unknown";
}

Result<CrossValidation> crossValidate(const std::vector<Eigen::Vector3d>& points_m,
                                      const std::vector<double>& sigmas_m,
                                      const InterpolationOptions& interpolation,
                                      const CrossValidationOptions& options, Progress& progress,
                                      std::stop_token stop) {
    if (options.folds < 2) return usageError("cross-validation needs at least two folds");
    if (!(options.block_m >= 0.0) || !std::isfinite(options.block_m)) {
        return usageError("the side of a block may not be below zero");
    }
    PartialProgress triangulating(progress, 0.0, 0.05);
    const auto tin = DelaunayTin::build(points_m, {}, triangulating, stop);
    if (!tin) return tl::unexpected(tin.error());
    const PlacedHeights points = placedHeights(points_m, sigmas_m);
    const std::size_t count = points.points_m.size();
    if (count < kLeastPoints) {
        return badData(fmt::format("{} points are too few for cross-validation", count), {}, 0,
                       "choose a method by name");
    }
    CrossValidation validation;
    validation.methods = options.methods;
    if (validation.methods.empty()) {
        for (const auto& [method, text] : kInterpolationMethods) validation.methods.push_back(method);
    }
    validation.points = count;
    validation.folds = options.folds;
    validation.seed = options.seed;
    validation.block_m = options.block_m > 0.0
                             ? options.block_m
                             : kSpacingsPerBlock * std::sqrt(tin->area_m2() / static_cast<double>(count));

    // A random engine for each hold-out: none depends on another.
    const auto engineOf = [&](HoldOut hold_out) {
        return std::mt19937_64(options.seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(hold_out));
    };
    double begin = 0.05;
    for (const auto& [hold_out, text] : kHoldOuts) {
        std::mt19937_64 engine = engineOf(hold_out);
        std::vector<Round> rounds;
        switch (hold_out) {
            case HoldOut::LeaveOneOut:
                rounds =
                    leaveOneOutRounds(points.points_m, options.leave_one_out_points,
                                      std::max<std::size_t>(1, options.most_fitted_points / count), engine);
                break;
            case HoldOut::RandomFolds:
                rounds = randomRounds(count, std::min(options.folds, count), engine);
                break;
            case HoldOut::SpatialBlocks:
                rounds = blockRounds(points.points_m, validation.block_m, options.folds, engine);
                break;
        }
        limitRounds(rounds, count, options.most_fitted_points);
        // A round that leaves too few for any surface says nothing.
        std::erase_if(rounds, [&](const Round& round) { return count - round.size() < kLeastPoints / 2; });
        PartialProgress part(progress, begin, begin + 0.95 / kHoldOuts.size());
        begin += 0.95 / kHoldOuts.size();
        auto result = runHoldOut(hold_out, rounds, points, validation.methods, options.breaklines,
                                 interpolation, part, stop);
        if (!result) return tl::unexpected(result.error());
        if (result->compared > 0) validation.results.push_back(std::move(*result));
    }
    if (validation.results.empty()) {
        return badData("no point lies within the hull of the others, so that no method can be judged", {}, 0,
                       "choose a method by name");
    }
    validation.ranking = ranked(validation);
    return validation;
}

}  // namespace terrawalk
