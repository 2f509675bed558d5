#include "survey/survey_edits.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace terrawalk {

namespace {

using ChannelRange = std::pair<Channel, Channel>;

/// First and last channel of a sensor.
ChannelRange channelsOf(EditedSensor sensor) {
    switch (sensor) {
        case EditedSensor::Gnss:
            return {Channel::Latitude, Channel::GnssVelocityUp};
        case EditedSensor::Barometer:
            return {Channel::Pressure, Channel::Temperature};
        case EditedSensor::Flow:
            return {Channel::FlowForward, Channel::FlowQuality};
        case EditedSensor::Attitude:
            return {Channel::Roll, Channel::AngularRateZ};
        case EditedSensor::Range:
            return {Channel::Range, Channel::RangeStrength};
        case EditedSensor::All:
            break;
    }
    return {Channel::Latitude, Channel::RangeStrength};
}

std::string_view wordsFor(EditedSensor sensor) {
    switch (sensor) {
        case EditedSensor::Gnss:
            return "GNSS";
        case EditedSensor::Barometer:
            return "barometer";
        case EditedSensor::Flow:
            return "optical flow";
        case EditedSensor::Attitude:
            return "attitude";
        case EditedSensor::Range:
            return "range";
        case EditedSensor::All:
            break;
    }
    return "all readings";
}

Result<void> exclude(Survey& survey, const ExcludedStretch& stretch) {
    const auto run = std::find_if(survey.runs.begin(), survey.runs.end(),
                                  [&](const Run& r) { return r.id == stretch.run; });
    if (run == survey.runs.end()) {
        return usageError(fmt::format("edits name run '{}', which the survey lacks", stretch.run));
    }
    const auto first = std::lower_bound(run->log.time_s.begin(), run->log.time_s.end(), stretch.from_s);
    const auto last = std::upper_bound(first, run->log.time_s.end(), stretch.to_s);
    if (first == last) {
        return usageError(fmt::format("run {} has no records between {} and {} s", stretch.run,
                                      stretch.from_s, stretch.to_s),
                          "take the times from its log");
    }
    const auto [from, to] = channelsOf(stretch.sensor);
    for (auto c = static_cast<std::size_t>(from); c <= static_cast<std::size_t>(to); ++c) {
        auto& values = run->log.channels[c];
        if (values.empty()) continue;
        std::fill(values.begin() + (first - run->log.time_s.begin()),
                  values.begin() + (last - run->log.time_s.begin()), kMissing);
    }
    survey.notes.push_back(fmt::format("Left out by hand: {} of run {} from {:.1f} to {:.1f} s.",
                                       wordsFor(stretch.sensor), stretch.run, stretch.from_s, stretch.to_s));
    return {};
}

Result<void> removeRun(Survey& survey, const std::string& id) {
    if (std::erase_if(survey.runs, [&](const Run& run) { return run.id == id; }) == 0) {
        return usageError(fmt::format("edits name run '{}', which the survey lacks", id));
    }
    survey.notes.push_back(fmt::format("Left out by hand: run {}.", id));
    return {};
}

Result<void> removeMark(Survey& survey, const std::string& mark) {
    if (mark == kZeroMark) return usageError("the zero mark is the survey's origin and cannot be left out");
    if (std::erase_if(survey.marks, [&](const ControlMark& m) { return m.name == mark; }) == 0) {
        return usageError(fmt::format("edits name mark '{}', which the survey lacks", mark));
    }
    for (Run& run : survey.runs) {
        if (run.start == mark) run.start.reset();
        if (run.target == mark) run.target.reset();
        std::erase_if(run.stops, [&](const Stop& stop) { return stop.point == mark; });
    }
    survey.notes.push_back(fmt::format("Left out by hand: mark {}.", mark));
    return {};
}

}  // namespace

Result<Survey> withEdits(Survey survey, const SurveyEdits& edits) {
    for (const ExcludedStretch& stretch : edits.stretches) {
        if (auto done = exclude(survey, stretch); !done) return tl::unexpected(done.error());
    }
    for (const std::string& run : edits.runs) {
        if (auto done = removeRun(survey, run); !done) return tl::unexpected(done.error());
    }
    for (const std::string& mark : edits.marks) {
        if (auto done = removeMark(survey, mark); !done) return tl::unexpected(done.error());
    }
    if (survey.runs.empty()) return usageError("edits leave no run", "take one of them back");
    for (std::size_t i = 0; i < edits.lines.size(); ++i) {
        survey.breaklines.push_back(edits.lines[i]);
        if (survey.breaklines.back().name.empty()) {
            survey.breaklines.back().name = fmt::format("drawn line {}", i + 1);
        }
    }
    if (!edits.lines.empty()) {
        survey.notes.push_back(
            edits.lines.size() == 1
                ? "Drawn by hand: a line of the surface."
                : fmt::format("Drawn by hand: {} lines of the surface.", edits.lines.size()));
    }
    return survey;
}

}  // namespace terrawalk
