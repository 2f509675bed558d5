#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

// What the files of a walk say of the survey that they make, where nobody wrote a survey.json yet. All
// functions are pure and safe from any thread.

/// What a table is, by its header row.
enum class LooseKind { Log, Marks, Trajectory, Other };
/// @param head  the first lines of the file
[[nodiscard]] LooseKind looseKind(std::string_view head);

/// As much of a log as a guess needs.
struct LogOutline {
    std::filesystem::path file;
    double duration_s = 0.0;
    std::optional<GeodeticPosition> first;  ///< ground below the first seconds, mean of GNSS
    std::optional<GeodeticPosition> last;
    bool stands_first = false;  ///< whether the accelerometer is at rest there
    bool stands_last = false;
    double path_m = 0.0;    ///< of the walk, steps of two seconds
    double extent_m = 0.0;  ///< diagonal of the rectangle round the walk
};
[[nodiscard]] LogOutline outlineOf(const ArrayLog& log);

/// The place where most walks start: what a surveyor calls zero point unless told otherwise.
struct ZeroPointGuess {
    GeodeticPosition position;
    std::size_t walks = 0;  ///< that start there
    double spread_m = 0.0;  ///< largest distance of one of them from their mean
};
/// Nothing where no log has positions.
[[nodiscard]] std::optional<ZeroPointGuess> guessZeroPoint(const std::vector<LogOutline>& outlines);

/// The UTM zone of a place, as "EPSG:32649"; empty beyond 84 degrees, where there is none.
[[nodiscard]] std::string utmZone(const GeodeticPosition& place);

/// A run as guessed, for a person to correct.
struct DraftRun {
    std::string id;
    RunKind kind = RunKind::Area;
    std::filesystem::path log;
    std::optional<std::string> start;
    std::optional<std::string> target;
    double duration_s = 0.0;
    std::string reason;  ///< what the guess rests on
};
/// An area walk covers ground: its path is long beside its extent. A fixed-point run goes straight from a
/// mark to another, and its target is the mark that its file is named by, or else the nearest to its end.
[[nodiscard]] DraftRun guessRun(const LogOutline& outline, const std::vector<ControlMark>& marks,
                                const LocalFrame& frame);

/// A survey that is not written yet.
struct SurveyDraft {
    std::filesystem::path project_file;  ///< to be written; logs and marks lie in its folder or below
    std::string name;
    bool has_zero_point = false;  ///< said, or guessed
    GeodeticPosition zero_point;
    std::string crs;
    std::string vertical_datum = "local";
    std::filesystem::path marks_file;  ///< empty: none
    std::vector<ControlMark> marks;
    std::vector<DraftRun> runs;
    std::vector<Error> bad_files;    ///< that cannot be used, with what cures them
    std::vector<std::string> notes;  ///< what was guessed, and from what
};

/// What is wrong with one run of a draft; nothing where it is good. Errors: BadData that names its log.
[[nodiscard]] std::optional<Error> problemOf(const SurveyDraft& draft, std::size_t run);

/// The folder that holds all files, by their absolute names; empty without any.
[[nodiscard]] std::filesystem::path commonFolder(const std::vector<std::filesystem::path>& files);

}  // namespace terrawalk
