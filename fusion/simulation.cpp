#include "fusion/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "fusion/disturbance.hpp"
#include "fusion/random_numbers.hpp"
#include "fusion/simulated_sensors.hpp"
#include "fusion/simulated_terrain.hpp"
#include "fusion/simulated_walk.hpp"

namespace terrawalk {
namespace {

constexpr GeodeticPosition kZeroPoint{23.182753, 113.399795, 38.0};  // the orchard of paper 000, section 2.1

constexpr double kNearestTarget_m = 10.0;
constexpr double kFarthestTarget_m = 45.0;
constexpr double kEdge_m = 1.0;  // marks and the ends of lines keep this far from the border
constexpr double kStartStand_s = 3.4;
constexpr double kTargetStand_s = 2.6;
constexpr double kStopStand_s = 5.0;
constexpr double kStopInset_s = 0.5;  // what is noted of a stop is surely still
constexpr double kSlowest_mps = 0.5;
constexpr double kEasy_mps = 0.6;
constexpr double kFastest_mps = 1.0;
constexpr double kPlumbing_m = 0.02;  // how well a hand holds the array over a mark, 1 sigma per axis
constexpr double kLeastFixedPoint_s = 15.0;

enum class Stream : std::uint64_t {
    Terrain = 1,
    Targets,
    Checks,
    ControlErrors,
    CheckErrors,
    Detours,
    Plumbing,
    Hand,
    Meander
};

RandomNumbers stream(std::uint64_t seed, std::uint64_t run, Stream purpose) {
    return RandomNumbers({seed, run, static_cast<std::uint64_t>(purpose)});
}

struct Rectangle {
    double west_m, east_m, south_m, north_m;
    [[nodiscard]] bool contains(const Eigen::Vector2d& en_m, double edge_m) const {
        return en_m.x() >= west_m + edge_m && en_m.x() <= east_m - edge_m && en_m.y() >= south_m + edge_m &&
               en_m.y() <= north_m - edge_m;
    }
};

Rectangle site(const SimulationOptions& options) {
    return {-0.5 * options.area_east_m, 0.5 * options.area_east_m, -options.area_north_m / 6.0,
            options.area_north_m * 5.0 / 6.0};
}

double plannedDuration_s(std::size_t epochs, const SimulationOptions& options) {
    return static_cast<double>(epochs - 1) * options.sample_interval_s;
}

std::optional<Error> refusal(const SimulationOptions& options) {
    const auto refuse = [](std::string message, std::string cure) {
        return std::optional<Error>(Error{ErrorKind::Usage, std::move(message), {}, 0, std::move(cure)});
    };
    const auto between = [](double value, double low, double high) {
        return value >= low && value <= high;
    };
    if (!between(options.noise_scale, 0.0, 100.0))
        return refuse(fmt::format("noise scale {} is not between 0 and 100", options.noise_scale),
                      "1 is as the tables say");
    if (!between(options.area_east_m, 10.0, 1000.0) || !between(options.area_north_m, 10.0, 1000.0))
        return refuse(fmt::format("an area of {} x {} m cannot be simulated", options.area_east_m,
                                  options.area_north_m),
                      "each side must be 10 to 1000 m");
    if (!between(options.line_spacing_m, 1.5, 0.5 * options.area_north_m))
        return refuse(fmt::format("lines {} m apart do not fit the area", options.line_spacing_m),
                      "choose 1.5 m to half of the area's depth");
    if (!between(options.sample_interval_s, 0.005, 1.0))
        return refuse(
            fmt::format("a sample interval of {} s is not between 0.005 and 1 s", options.sample_interval_s),
            "the paper's array samples every 0.2 s");
    if (!between(options.mark_sigma_h_m, 0.0, 1.0) || !between(options.mark_sigma_v_m, 0.0, 1.0))
        return refuse("the sigma of a mark is not between 0 and 1 m", "a total station reaches 0.005 m");
    if (!between(options.range_lever_arm_m.norm(), 0.0, 0.5) ||
        !between(options.gnss_lever_arm_m.norm(), 0.0, 2.0))
        return refuse("a lever arm is too long for an array held by hand",
                      "the range finder can be 0.5 m from the origin, the antenna 2 m");
    constexpr std::size_t kMost = 1'000'000;
    if (options.fixed_point_rounds == 0 || options.fixed_point_rounds > 999 ||
        options.fixed_point_runs * options.fixed_point_rounds > 999 || options.check_points > 100'000 ||
        options.area_epochs > kMost || options.fixed_point_epochs > kMost)
        return refuse("the survey is too large to simulate",
                      "at most 999 fixed-point runs, 100000 check points, 1000000 epochs in a run");
    if (options.fixed_point_runs == 0 && options.area_epochs == 0)
        return refuse("nothing to simulate: no fixed-point run and no area walk", "ask for one of them");
    if (options.fixed_point_runs > 0 &&
        (options.fixed_point_epochs < 2 ||
         plannedDuration_s(options.fixed_point_epochs, options) < kLeastFixedPoint_s))
        return refuse(
            fmt::format("{} epochs are too few to stand, walk and stand again", options.fixed_point_epochs),
            fmt::format("a fixed-point run must last {} s at least", kLeastFixedPoint_s));
    if (options.area_epochs == 0 && options.control_stops + options.check_stops > 0)
        return refuse("stops need an area walk", "set both numbers of stops to 0");
    if (options.control_stops > options.fixed_point_runs)
        return refuse(fmt::format("{} stops on control marks, but only {} such marks", options.control_stops,
                                  options.fixed_point_runs),
                      "each fixed-point run makes one control mark");
    if (options.check_stops > options.check_points)
        return refuse(fmt::format("{} stops on check marks, but only {} such marks", options.check_stops,
                                  options.check_points),
                      "ask for more check points");
    return std::nullopt;
}

/// The marks as they lie on the ground.
struct TrueMark {
    std::string name;
    Eigen::Vector2d en_m;
    MarkRole role;
};

// Targets lie at all distances that can be reached, on ground on which one can stand, apart from each other.
std::vector<TrueMark> placeTargets(const SimulationOptions& options, const TerrainModel& terrain) {
    std::vector<TrueMark> targets;
    if (options.fixed_point_runs == 0) return targets;
    const Rectangle area = site(options);
    const double walking_s =
        plannedDuration_s(options.fixed_point_epochs, options) - kStartStand_s - kTargetStand_s;
    const double reach_m =
        std::min({kFarthestTarget_m, 0.92 * kFastest_mps * walking_s,
                  0.95 * std::hypot(0.5 * options.area_east_m - kEdge_m, area.north_m - kEdge_m)});
    const double nearest_m = std::min(kNearestTarget_m, 0.5 * reach_m);
    const double apart_m = std::min(5.0, 0.15 * (options.area_east_m + options.area_north_m));
    RandomNumbers random = stream(options.seed, 0, Stream::Targets);
    for (std::size_t k = 0; k < options.fixed_point_runs; ++k) {
        const double share =
            (static_cast<double>(k) + random.uniform()) / static_cast<double>(options.fixed_point_runs);
        double distance_m = nearest_m + (reach_m - nearest_m) * share;
        std::optional<Eigen::Vector2d> best;
        double best_cost = 0.0;
        for (int attempt = 0; attempt < 48; ++attempt) {
            const double direction_rad = random.uniform(0.0, 2.0 * kPi);
            const Eigen::Vector2d en_m =
                distance_m * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
            if (!area.contains(en_m, kEdge_m)) {
                if (!best && attempt >= 24) distance_m *= 0.95;  // few directions lead that far: come nearer
                continue;
            }
            double nearest_other_m = apart_m;
            for (const TrueMark& other : targets)
                nearest_other_m = std::min(nearest_other_m, (other.en_m - en_m).norm());
            const double cost = terrain.slope(en_m.x(), en_m.y()) + (1.0 - nearest_other_m / apart_m);
            if (!best || cost < best_cost) {
                best = en_m;
                best_cost = cost;
            }
        }
        if (!best) best = Eigen::Vector2d(0.0, nearest_m);
        targets.push_back({fmt::format("P{:02}", k + 1), *best, MarkRole::Control});
    }
    return targets;
}

// One in each cell of a grid over the area, so that every part of it is checked, risers as well as treads.
std::vector<TrueMark> placeCheckPoints(const SimulationOptions& options) {
    std::vector<TrueMark> checks;
    if (options.check_points == 0) return checks;
    const Rectangle area = site(options);
    const double width_m = area.east_m - area.west_m - 2.0 * kEdge_m;
    const double depth_m = area.north_m - area.south_m - 2.0 * kEdge_m;
    const auto n = static_cast<double>(options.check_points);
    const double rows = std::max(1.0, std::round(std::sqrt(n * depth_m / width_m)));
    RandomNumbers random = stream(options.seed, 0, Stream::Checks);
    for (std::size_t k = 0; k < options.check_points; ++k) {
        // The points are dealt out over the rows as evenly as whole numbers go.
        const double row = std::floor(static_cast<double>(k) * rows / n);
        const double first = std::ceil(row * n / rows);
        const double in_row = std::ceil((row + 1.0) * n / rows) - first;
        const double column = static_cast<double>(k) - first;
        const double e_m = area.west_m + kEdge_m + (column + random.uniform(0.1, 0.9)) / in_row * width_m;
        const double n_m = area.south_m + kEdge_m + (row + random.uniform(0.1, 0.9)) / rows * depth_m;
        checks.push_back({fmt::format("C{:02}", k + 1), {e_m, n_m}, MarkRole::Check});
    }
    return checks;
}

ControlMark measured(const TrueMark& mark, const TerrainModel& terrain, const SimulationOptions& options,
                     RandomNumbers& random) {
    const double error_e = random.normal();
    const double error_n = random.normal();
    const double error_u = random.normal();
    const double h_m = options.noise_scale * options.mark_sigma_h_m;
    const double v_m = options.noise_scale * options.mark_sigma_v_m;
    return {mark.name,
            {mark.en_m.x() + h_m * error_e, mark.en_m.y() + h_m * error_n,
             terrain.height_m(mark.en_m.x(), mark.en_m.y()) + v_m * error_u},
            options.mark_sigma_h_m,
            options.mark_sigma_v_m,
            mark.role};
}

Eigen::Vector2d plumbed(const Eigen::Vector2d& en_m, const SimulationOptions& options,
                        RandomNumbers& random) {
    const double e = random.normal();
    const double n = random.normal();
    return en_m + options.noise_scale * kPlumbing_m * Eigen::Vector2d(e, n);
}

// To the target by a way that bends to one side and then to the other. What time is left is spent standing.
WalkPlan planFixedPoint(const SimulationOptions& options, const Eigen::Vector2d& target_m,
                        std::uint64_t run) {
    RandomNumbers random = stream(options.seed, run, Stream::Detours);
    RandomNumbers plumbing = stream(options.seed, run, Stream::Plumbing);
    const Eigen::Vector2d left(-target_m.y(), target_m.x());
    WalkPlan plan;
    plan.duration_s = plannedDuration_s(options.fixed_point_epochs, options);
    plan.stands.push_back({plumbed(Eigen::Vector2d::Zero(), options, plumbing), kStartStand_s});
    plan.stands.push_back({plumbed(target_m, options, plumbing), kTargetStand_s});
    const double bend = random.uniform(-0.1, 0.1);
    plan.corners.push_back({random.uniform(0.25, 0.4) * target_m + bend * left,
                            random.uniform(0.6, 0.75) * target_m - random.uniform(0.2, 0.8) * bend * left});
    const double walking_s = plan.duration_s - kStartStand_s - kTargetStand_s;
    const double spare_s = std::max(0.0, walking_s - walkedLength_m(plan) / kSlowest_mps);
    plan.stands[0].duration_s += 0.5 * spare_s;
    plan.stands[1].duration_s += 0.5 * spare_s;
    return plan;
}

struct AreaPlan {
    WalkPlan walk;
    std::vector<std::string> stops;  ///< names of the marks of the stands between the first and the last
};

/// A point on the way, and whether one stops there.
struct WayPoint {
    Eigen::Vector2d en_m;
    const TrueMark* stop = nullptr;
};

std::vector<double> lineNorthings(const SimulationOptions& options) {
    const Rectangle area = site(options);
    const double depth_m = area.north_m - area.south_m - 2.0 * kEdge_m;
    const auto gaps = std::max(1.0, std::round(depth_m / options.line_spacing_m));
    std::vector<double> northings;
    for (double i = 0.0; i <= gaps; i += 1.0)
        northings.push_back(area.south_m + kEdge_m + depth_m * i / gaps);
    return northings;
}

// Along the terraces from the south, to and fro; marks are visited from the line next to them.
std::vector<WayPoint> lines(const SimulationOptions& options, const std::vector<const TrueMark*>& stops) {
    constexpr double kAside_m = 1.2;
    const Rectangle area = site(options);
    const std::vector<double> northings = lineNorthings(options);
    const double gap_m = northings[1] - northings[0];
    std::vector<WayPoint> way;
    for (std::size_t i = 0; i < northings.size(); ++i) {
        const double sense = i % 2 == 0 ? 1.0 : -1.0;
        const double from_m = sense > 0.0 ? area.west_m + kEdge_m : area.east_m - kEdge_m;
        const double to_m = sense > 0.0 ? area.east_m - kEdge_m : area.west_m + kEdge_m;
        std::vector<const TrueMark*> here;
        for (const TrueMark* stop : stops) {
            if (std::lround((stop->en_m.y() - northings[0]) / gap_m) == static_cast<long>(i))
                here.push_back(stop);
        }
        std::stable_sort(here.begin(), here.end(), [&](const TrueMark* a, const TrueMark* b) {
            return sense * a->en_m.x() < sense * b->en_m.x();
        });
        way.push_back({{from_m, northings[i]}});
        double reached_m = sense * from_m;
        for (const TrueMark* stop : here) {
            const double at_m = sense * stop->en_m.x();
            if (at_m - kAside_m > reached_m) way.push_back({{sense * (at_m - kAside_m), northings[i]}});
            way.push_back({stop->en_m, stop});
            reached_m = at_m;
            if (at_m + kAside_m < sense * to_m) {
                reached_m = at_m + kAside_m;
                way.push_back({{sense * reached_m, northings[i]}});
            }
        }
        if (sense * to_m > reached_m) way.push_back({{to_m, northings[i]}});
    }
    return way;
}

// Back across all lines, in as many passes as asked, a zigzag from the end of the last line to the other
// side.
void addCrossings(const SimulationOptions& options, std::size_t passes, std::vector<WayPoint>& way) {
    const Rectangle area = site(options);
    const double from_e_m = way.back().en_m.x() > 0.0 ? area.east_m - kEdge_m : area.west_m + kEdge_m;
    for (std::size_t i = 1; i <= passes; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(passes);
        way.push_back(
            {{from_e_m * (1.0 - 2.0 * share), i % 2 == 1 ? area.south_m + kEdge_m : area.north_m - kEdge_m}});
    }
}

// Nobody walks along a ruler: every few metres a step to one side.
void addMeander(const SimulationOptions& options, std::uint64_t run, std::vector<WayPoint>& way) {
    constexpr double kEvery_m = 5.0;
    constexpr double kAside_m = 0.3;
    RandomNumbers random = stream(options.seed, run, Stream::Meander);
    std::vector<WayPoint> meandering{way.front()};
    for (std::size_t i = 1; i < way.size(); ++i) {
        const Eigen::Vector2d step = way[i].en_m - way[i - 1].en_m;
        const double pieces = std::floor(step.norm() / kEvery_m);
        const Eigen::Vector2d left = Eigen::Vector2d(-step.y(), step.x()).normalized();
        for (double k = 1.0; k < pieces; k += 1.0)
            meandering.push_back(
                {way[i - 1].en_m + k / pieces * step + random.uniform(-kAside_m, kAside_m) * left});
        meandering.push_back(way[i]);
    }
    way = std::move(meandering);
}

AreaPlan planWay(const SimulationOptions& options, const std::vector<const TrueMark*>& stops,
                 std::size_t passes, std::uint64_t run) {
    RandomNumbers plumbing = stream(options.seed, run, Stream::Plumbing);
    std::vector<WayPoint> way = lines(options, stops);
    addCrossings(options, passes, way);
    addMeander(options, run, way);
    AreaPlan plan;
    plan.walk.duration_s = plannedDuration_s(options.area_epochs, options);
    plan.walk.stands.push_back({plumbed(Eigen::Vector2d::Zero(), options, plumbing), kStartStand_s});
    const Eigen::Vector2d end_m =
        options.end_on_zero ? plumbed(Eigen::Vector2d::Zero(), options, plumbing) : way.back().en_m;
    if (!options.end_on_zero) way.pop_back();
    plan.walk.corners.emplace_back();
    for (const WayPoint& point : way) {
        if (point.stop == nullptr) {
            plan.walk.corners.back().push_back(point.en_m);
            continue;
        }
        plan.walk.stands.push_back({plumbed(point.en_m, options, plumbing), kStopStand_s});
        plan.stops.push_back(point.stop->name);
        plan.walk.corners.emplace_back();
    }
    plan.walk.stands.push_back({end_m, kStartStand_s});
    return plan;
}

double walking_s(const WalkPlan& plan) {
    double time_s = plan.duration_s;
    for (const WalkPlan::Stand& stand : plan.stands) time_s -= stand.duration_s;
    return time_s;
}

// At least one pass back across the lines, and as many more as it takes to fill the time at an easy pace.
Result<AreaPlan> planArea(const SimulationOptions& options, const std::vector<const TrueMark*>& stops,
                          std::uint64_t run) {
    std::size_t passes = 1;
    AreaPlan plan = planWay(options, stops, passes, run);
    const double spare_s = walking_s(plan.walk) - walkedLength_m(plan.walk) / kFastest_mps;
    if (spare_s < 0.0) {
        const double needed_s = plan.walk.duration_s - spare_s;
        return usageError(
            fmt::format("{} epochs are too few to walk {} x {} m in lines {} m apart", options.area_epochs,
                        options.area_east_m, options.area_north_m, options.line_spacing_m),
            fmt::format("ask for {} epochs or more, or for wider lines",
                        static_cast<std::size_t>(std::ceil(needed_s / options.sample_interval_s)) + 1));
    }
    const double longest_pass_m = std::hypot(options.area_east_m, options.area_north_m);
    for (;;) {
        const double missing_m = kEasy_mps * walking_s(plan.walk) - walkedLength_m(plan.walk);
        if (missing_m <= 0.0) return plan;
        passes += std::max<std::size_t>(1, static_cast<std::size_t>(missing_m / longest_pass_m));
        plan = planWay(options, stops, passes, run);
    }
}

// Marks to stop on: spread evenly over the field from south to north, which is the order in which it is
// walked.
std::vector<const TrueMark*> chooseStops(const std::vector<TrueMark>& marks, std::size_t count) {
    std::vector<const TrueMark*> by_northing;
    for (const TrueMark& mark : marks) by_northing.push_back(&mark);
    std::stable_sort(by_northing.begin(), by_northing.end(),
                     [](const TrueMark* a, const TrueMark* b) { return a->en_m.y() < b->en_m.y(); });
    std::vector<const TrueMark*> chosen;
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(by_northing[(2 * i + 1) * by_northing.size() / (2 * count)]);
    return chosen;
}

struct SimulatedRun {
    Run run;
    Trajectory truth;
};

class Simulator {
  public:
    Simulator(const SimulationOptions& options, std::shared_ptr<const TerrainModel> terrain,
              std::stop_token stop)
        : options_(options), terrain_(std::move(terrain)), stop_(std::move(stop)) {}

    [[nodiscard]] Result<SimulatedRun> fixedPoint(std::size_t index, const TrueMark& target) const {
        SimulatedRun simulated;
        simulated.run.id = fmt::format("F{:02}", index + 1);
        simulated.run.kind = RunKind::FixedPoint;
        simulated.run.start = std::string(kZeroMark);
        simulated.run.target = target.name;
        const std::uint64_t number = index + 1;
        const WalkPlan plan = planFixedPoint(options_, target.en_m, number);
        return walkAndSense(plan, options_.fixed_point_epochs, number, {}, std::move(simulated));
    }

    [[nodiscard]] Result<SimulatedRun> area(const std::vector<const TrueMark*>& stops) const {
        SimulatedRun simulated;
        simulated.run.id = "S01";
        simulated.run.kind = RunKind::Area;
        simulated.run.start = std::string(kZeroMark);
        if (options_.end_on_zero) simulated.run.target = std::string(kZeroMark);
        constexpr std::uint64_t kAreaRun = 0;
        const Result<AreaPlan> plan = planArea(options_, stops, kAreaRun);
        if (!plan) return tl::unexpected(plan.error());
        return walkAndSense(plan->walk, options_.area_epochs, kAreaRun, plan->stops, std::move(simulated));
    }

  private:
    Result<SimulatedRun> walkAndSense(const WalkPlan& plan, std::size_t epochs, std::uint64_t number,
                                      const std::vector<std::string>& stops, SimulatedRun simulated) const {
        const Walk walk(plan, *terrain_, stream(options_.seed, number, Stream::Hand));
        const std::vector<std::uint64_t> ticks =
            keptTicks(epochs, sensorErrors(options_.faults).lost_row_chance, options_.seed, number);
        std::vector<WalkSample> walked;
        walked.reserve(ticks.back() + 1);
        for (std::uint64_t tick = 0; tick <= ticks.back(); ++tick) {
            if (tick % 1024 == 0 && stop_.stop_requested()) return cancelled();
            walked.push_back(walk.sample(static_cast<double>(tick) * options_.sample_interval_s));
        }
        const ArrayLog all =
            senseWalk(walked, *terrain_, LocalFrame(kZeroPoint), options_, number, plan.duration_s, stop_);
        if (stop_.stop_requested()) return cancelled();
        simulated.run.log = keepRows(all, ticks);
        simulated.run.log.device = fmt::format("simulated array, seed {}", options_.seed);
        for (std::size_t i = 0; i < stops.size(); ++i) {
            const Walk::Interval& stood = walk.standTimes()[i + 1];
            const auto milliseconds = [](double time_s) {
                return std::round(time_s * 1000.0) / 1000.0;
            };
            simulated.run.stops.push_back({stops[i], milliseconds(stood.from_s + kStopInset_s),
                                           milliseconds(stood.to_s - kStopInset_s)});
        }
        simulated.truth.run_id = simulated.run.id;
        for (const std::uint64_t tick : ticks) {
            TrajectoryEpoch epoch;
            epoch.time_s = walked[tick].time_s;
            epoch.position_enu_m = walked[tick].position_m;
            epoch.velocity_enu_mps = walked[tick].velocity_mps;
            epoch.attitude = walked[tick].attitude;
            simulated.truth.epochs.push_back(epoch);
        }
        return simulated;
    }

    const SimulationOptions& options_;
    std::shared_ptr<const TerrainModel> terrain_;
    std::stop_token stop_;
};

template <class Names, class Value>
std::string_view nameIn(const Names& names, Value value) {
    for (const auto& [known, text] : names) {
        if (known == value) return text;
    }
    return {};
}

}  // namespace

std::string_view name(SimulatedTerrain terrain) {
    return nameIn(kSimulatedTerrainNames, terrain);
}
std::string_view name(FaultLevel level) {
    return nameIn(kFaultLevelNames, level);
}
std::string_view name(GnssMode mode) {
    return nameIn(kGnssModeNames, mode);
}

Result<SimulatedSurvey> simulateSurvey(const SimulationOptions& options, Progress& progress,
                                       std::stop_token stop) {
    if (std::optional<Error> error = refusal(options)) return tl::unexpected(std::move(*error));
    const auto terrain = std::make_shared<const TerrainModel>(
        options.terrain, scramble({options.seed, static_cast<std::uint64_t>(Stream::Terrain)}));
    const std::vector<TrueMark> targets = placeTargets(options, *terrain);
    const std::vector<TrueMark> checks = placeCheckPoints(options);

    SimulatedSurvey simulated;
    simulated.terrain_height_m = [terrain](double e_m, double n_m) {
        return terrain->height_m(e_m, n_m);
    };
    Survey& survey = simulated.survey;
    survey.name = fmt::format("Simulated survey: {}, seed {}", name(options.terrain), options.seed);
    survey.zero_point = kZeroPoint;
    survey.crs = "EPSG:32649";
    survey.notes.push_back(fmt::format(
        "Simulated, not measured: terrain {}, faults {}, GNSS {}, noise scale {}, seed {}.",
        name(options.terrain), name(options.faults), name(options.gnss), options.noise_scale, options.seed));
    RandomNumbers control_errors = stream(options.seed, 0, Stream::ControlErrors);
    RandomNumbers check_errors = stream(options.seed, 0, Stream::CheckErrors);
    for (const TrueMark& mark : targets)
        survey.marks.push_back(measured(mark, *terrain, options, control_errors));
    for (const TrueMark& mark : checks)
        survey.marks.push_back(measured(mark, *terrain, options, check_errors));

    const Simulator simulator(options, terrain, stop);
    const std::size_t total =
        options.fixed_point_runs * options.fixed_point_rounds * options.fixed_point_epochs +
        options.area_epochs;
    std::size_t done = 0;
    const auto add = [&](Result<SimulatedRun>&& run) -> std::optional<Error> {
        if (!run) return run.error();
        done += run->run.log.size();
        progress.report(static_cast<double>(done) / static_cast<double>(total), "simulating " + run->run.id);
        survey.runs.push_back(std::move(run->run));
        simulated.truth.push_back(std::move(run->truth));
        return std::nullopt;
    };
    for (std::size_t i = 0; i < targets.size() * options.fixed_point_rounds; ++i) {
        if (auto error = add(simulator.fixedPoint(i, targets[i % targets.size()]))) {
            return tl::unexpected(std::move(*error));
        }
    }
    if (options.area_epochs > 0) {
        std::vector<const TrueMark*> stops = chooseStops(targets, options.control_stops);
        const std::vector<const TrueMark*> check_stops = chooseStops(checks, options.check_stops);
        stops.insert(stops.end(), check_stops.begin(), check_stops.end());
        if (auto error = add(simulator.area(stops))) return tl::unexpected(std::move(*error));
    }
    for (const Disturbance disturbance : options.disturbances) {
        disturb(survey, disturbance, options.seed);
        survey.notes.push_back(fmt::format("Disturbed: {}.", name(disturbance)));
    }
    return simulated;
}

}  // namespace terrawalk
