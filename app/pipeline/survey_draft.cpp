#include "app/pipeline/survey_draft.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "io/survey_format.hpp"
#include "io/text_input.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

// Long enough to mean GNSS, short enough to lie within a stand.
constexpr double kEnd_s = 2.5;
constexpr double kStep_s = 2.0;
// Between a hand that holds still (0.03) and one that walks (1).
constexpr double kStillAcceleration_mps2 = 0.2;
// GNSS under trees errs by some metres.
constexpr double kNearMark_m = 8.0;
constexpr double kSameStart_m = 10.0;
// Straight runs have 1 to 1.5, walks that cover a field 8 and more.
constexpr double kLongestStraightPath = 2.5;

struct Fix {
    double time_s;
    GeodeticPosition at;  ///< on the ground
};

std::vector<Fix> fixesOf(const ArrayLog& log) {
    std::vector<Fix> fixes;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const double lat = log.value(Channel::Latitude, i), lon = log.value(Channel::Longitude, i);
        const double height_m = log.value(Channel::EllipsoidalHeight, i);
        if (!present(lat) || !present(lon) || !present(height_m)) continue;
        const double range_m = log.value(Channel::Range, i);
        // Where the ground was not seen, a hand's height above it.
        const bool seen = present(range_m) && range_m > 0.0 && range_m < 3.0;
        fixes.push_back({log.time_s[i], {lat, lon, height_m - (seen ? range_m : 1.2)}});
    }
    return fixes;
}

std::optional<GeodeticPosition> meanOf(const std::vector<Fix>& fixes, double from_s, double to_s) {
    GeodeticPosition sum;
    double n = 0.0;
    for (const Fix& fix : fixes) {
        if (fix.time_s < from_s || fix.time_s > to_s) continue;
        sum.lat_deg += fix.at.lat_deg;
        sum.lon_deg += fix.at.lon_deg;
        sum.h_ell_m += fix.at.h_ell_m;
        ++n;
    }
    if (n == 0.0) return std::nullopt;
    return GeodeticPosition{sum.lat_deg / n, sum.lon_deg / n, sum.h_ell_m / n};
}

/// Whether the array is at rest: a hand that walks shakes it. Not known counts as no.
bool stands(const ArrayLog& log, double from_s, double to_s) {
    double n = 0.0, sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (log.time_s[i] < from_s || log.time_s[i] > to_s) continue;
        const double a =
            std::hypot(log.value(Channel::AccelerationX, i), log.value(Channel::AccelerationY, i),
                       log.value(Channel::AccelerationZ, i));
        if (!present(a)) continue;
        ++n;
        sum += a;
        squares += a * a;
    }
    if (n < 3.0) return false;
    const double mean = sum / n;
    return std::sqrt(std::max(0.0, squares / n - mean * mean)) < kStillAcceleration_mps2;
}

double horizontal(const GeodeticPosition& from, const GeodeticPosition& to) {
    return LocalFrame(from).toEnu(to).head<2>().norm();
}

/// Letters and digits of a name in pieces: "F03-P07" gives F03 and P07.
std::vector<std::string> wordsOf(const std::string& name) {
    std::vector<std::string> words(1);
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           (static_cast<unsigned char>(c) >= 0x80U);
        if (plain) {
            words.back() += c;
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    return words;
}

std::optional<std::string> markInName(const std::string& stem, const std::vector<ControlMark>& marks) {
    // The last one: "ZERO_P03" walks to P03.
    std::optional<std::string> found;
    for (const std::string& word : wordsOf(stem)) {
        for (const ControlMark& mark : marks) {
            if (mark.name == word) found = word;
        }
    }
    return found;
}

struct NearMark {
    std::string name;
    double distance_m = HUGE_VAL;
};
NearMark nearest(const Eigen::Vector2d& at_m, const std::vector<ControlMark>& marks,
                 const std::function<bool(const ControlMark&)>& wanted) {
    NearMark best;
    for (const ControlMark& mark : marks) {
        const double distance_m = (mark.enu_m.head<2>() - at_m).norm();
        if (wanted(mark) && distance_m < best.distance_m) best = {mark.name, distance_m};
    }
    return best;
}

bool nearZero(const std::optional<GeodeticPosition>& place, const LocalFrame& frame) {
    return place && frame.toEnu(*place).head<2>().norm() <= kNearMark_m;
}

std::string safeId(const std::string& stem) {
    std::string id;
    for (const char c : stem) {
        const bool safe = isSafeRunId(std::string{'a', c});
        id += safe ? c : '_';
    }
    id = id.substr(0, 64);
    if (!isSafeRunId(id)) id = "run" + id.substr(0, 60);
    return id;
}

void guessFixedPoint(const LogOutline& outline, const std::vector<ControlMark>& marks,
                     const LocalFrame& frame, DraftRun& run) {
    run.kind = RunKind::FixedPoint;
    run.start = std::string(kZeroMark);
    if (auto named = markInName(outline.file.stem().string(), marks)) {
        run.target = std::move(named);
        run.reason = fmt::format("its name says {}", *run.target);
        return;
    }
    if (!outline.last) return;
    const Eigen::Vector2d end_m = frame.toEnu(*outline.last).head<2>();
    // Walks to known points are walked to control marks; check marks lie on the way of others.
    NearMark mark = nearest(end_m, marks, [](const ControlMark& m) { return m.role == MarkRole::Control; });
    if (mark.distance_m > kNearMark_m) mark = nearest(end_m, marks, [](const ControlMark&) { return true; });
    if (mark.distance_m > kNearMark_m) {
        run.reason = "it walks straight, but no mark lies near its end";
        return;
    }
    run.target = mark.name;
    run.reason = fmt::format("it walks straight and ends {:.1f} m by GNSS from {}", mark.distance_m,
                             printable(mark.name));
}

}  // namespace

LooseKind looseKind(std::string_view head) {
    const std::string_view text = withoutByteOrderMark(head);
    const char* const end = text.data() + text.size();
    for (const char* at = text.data(); at != end;) {
        const char* const line_end = findLineEnd(at, end);
        const std::string_view line = trimmed({at, static_cast<std::size_t>(line_end - at)});
        at = afterLineEnd(line_end, end);
        if (line.empty() || line.front() == '#') continue;
        const auto fields = splitCsvLine(line);
        if (!fields) return LooseKind::Other;
        const auto has = [&](std::string_view name) {
            return std::find(fields->begin(), fields->end(), name) != fields->end();
        };
        if (has(kControlColumns[0]) && has(kControlColumns[1])) return LooseKind::Marks;
        if (!has(kTimeColumn)) return LooseKind::Other;
        return has(kTrajectoryColumns[1]) && has(kTrajectoryColumns[2]) ? LooseKind::Trajectory
                                                                        : LooseKind::Log;
    }
    return LooseKind::Other;
}

LogOutline outlineOf(const ArrayLog& log) {
    LogOutline outline;
    outline.file = log.file;
    if (log.size() == 0) return outline;
    const double first_s = log.time_s.front(), last_s = log.time_s.back();
    outline.duration_s = last_s - first_s;
    outline.stands_first = stands(log, first_s, first_s + kEnd_s);
    outline.stands_last = stands(log, last_s - kEnd_s, last_s);
    const std::vector<Fix> fixes = fixesOf(log);
    if (fixes.empty()) return outline;
    outline.first = meanOf(fixes, first_s, first_s + kEnd_s);
    outline.last = meanOf(fixes, last_s - kEnd_s, last_s);
    const LocalFrame frame(fixes.front().at);
    std::optional<Eigen::Vector2d> before;
    Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL), high = -low;
    for (std::size_t i = 0; i < fixes.size();) {
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        double n = 0.0;
        const double until_s = fixes[i].time_s + kStep_s;
        for (; i < fixes.size() && fixes[i].time_s < until_s; ++i, ++n)
            sum += frame.toEnu(fixes[i].at).head<2>();
        const Eigen::Vector2d at = sum / n;
        if (before) outline.path_m += (at - *before).norm();
        before = at;
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
    }
    outline.extent_m = (high - low).norm();
    return outline;
}

std::optional<ZeroPointGuess> guessZeroPoint(const std::vector<LogOutline>& outlines) {
    std::vector<GeodeticPosition> starts, best;
    for (const LogOutline& outline : outlines) {
        if (outline.first) starts.push_back(*outline.first);
    }
    for (const GeodeticPosition& middle : starts) {
        std::vector<GeodeticPosition> near;
        std::copy_if(
            starts.begin(), starts.end(), std::back_inserter(near),
            [&](const GeodeticPosition& other) { return horizontal(middle, other) <= kSameStart_m; });
        if (near.size() > best.size()) best = std::move(near);
    }
    if (best.empty()) return std::nullopt;
    ZeroPointGuess guess;
    guess.walks = best.size();
    const auto n = static_cast<double>(best.size());
    for (const GeodeticPosition& p : best) {
        guess.position.lat_deg += p.lat_deg / n;
        guess.position.lon_deg += p.lon_deg / n;
        guess.position.h_ell_m += p.h_ell_m / n;
    }
    for (const GeodeticPosition& p : best)
        guess.spread_m = std::max(guess.spread_m, horizontal(guess.position, p));
    // Centimetres: more is noise, and hard to compare with what a surveyor has on paper.
    guess.position.lat_deg = std::round(guess.position.lat_deg * 1e7) / 1e7;
    guess.position.lon_deg = std::round(guess.position.lon_deg * 1e7) / 1e7;
    guess.position.h_ell_m = std::round(guess.position.h_ell_m * 1e2) / 1e2;
    return guess;
}

std::string utmZone(const GeodeticPosition& place) {
    if (!(place.lat_deg >= -80.0 && place.lat_deg <= 84.0)) return {};
    int zone = static_cast<int>(std::floor((place.lon_deg + 180.0) / 6.0)) % 60 + 1;
    const double lat = place.lat_deg, lon = place.lon_deg;
    // South-west Norway and Svalbard.
    if (lat >= 56.0 && lat < 64.0 && lon >= 3.0 && lon < 12.0) zone = 32;
    if (lat >= 72.0 && lon >= 0.0 && lon < 42.0)
        zone = lon < 9.0 ? 31 : lon < 21.0 ? 33 : lon < 33.0 ? 35 : 37;
    return fmt::format("EPSG:{}", (lat < 0.0 ? 32700 : 32600) + zone);
}

DraftRun guessRun(const LogOutline& outline, const std::vector<ControlMark>& marks, const LocalFrame& frame) {
    DraftRun run;
    run.id = safeId(outline.file.stem().string());
    run.log = outline.file;
    run.duration_s = outline.duration_s;
    const bool straight = outline.extent_m > 0.0 && outline.path_m < kLongestStraightPath * outline.extent_m;
    if (straight && !marks.empty()) {
        guessFixedPoint(outline, marks, frame, run);
        return run;
    }
    run.reason = outline.path_m > 0.0
                     ? fmt::format("it walks {:.0f} m within {:.0f} m", outline.path_m, outline.extent_m)
                     : "it has no positions";
    // Only where the array stood: a tie to a mark that it passed would pull the track.
    if (outline.stands_first && nearZero(outline.first, frame)) run.start = std::string(kZeroMark);
    if (outline.stands_last && nearZero(outline.last, frame)) run.target = std::string(kZeroMark);
    return run;
}

std::optional<Error> problemOf(const SurveyDraft& draft, std::size_t index) {
    const DraftRun& run = draft.runs[index];
    const auto bad = [&](std::string message, std::string cure) {
        return badData(std::move(message), run.log, 0, std::move(cure)).value();
    };
    if (!isSafeRunId(run.id)) {
        return bad(fmt::format("{} cannot be the name of a run", inQuotes(run.id)),
                   "use letters, digits, '-', '_' and '.', the first one no '.'");
    }
    const auto same = std::count_if(draft.runs.begin(), draft.runs.end(),
                                    [&](const DraftRun& other) { return other.id == run.id; });
    if (same > 1) return bad(fmt::format("two runs are named {}", run.id), "give each run its own name");
    if (run.kind == RunKind::FixedPoint && (!run.start || !run.target)) {
        return bad(
            fmt::format("the fixed-point run {} has no {} mark", run.id, run.start ? "target" : "start"),
            "name the mark, or make it an area walk");
    }
    for (const auto& mark : {run.start, run.target}) {
        if (!mark || *mark == kZeroMark) continue;
        const bool known = std::any_of(draft.marks.begin(), draft.marks.end(),
                                       [&](const ControlMark& m) { return m.name == *mark; });
        if (!known) {
            return bad(fmt::format("run {} names the mark {}, which is not known", run.id, inQuotes(*mark)),
                       "correct the name, or give the table with that mark");
        }
    }
    return std::nullopt;
}

fs::path commonFolder(const std::vector<fs::path>& files) {
    fs::path common;
    bool any = false;
    for (const fs::path& file : files) {
        std::error_code error;
        const fs::path folder = fs::weakly_canonical(fs::absolute(file, error).parent_path(), error);
        if (!std::exchange(any, true)) {
            common = folder;
            continue;
        }
        const auto apart = std::mismatch(common.begin(), common.end(), folder.begin(), folder.end()).first;
        fs::path shared;
        for (auto part = common.begin(); part != apart; ++part) shared /= *part;
        common = shared;
    }
    return common;
}

}  // namespace terrawalk
