#include "app/gui/run_settings.hpp"

#include <algorithm>

namespace terrawalk::gui {

RunSettings::RunSettings(const PipelineConfig& config) {
    if (config.tuning) tuning_ = std::make_shared<const TuningRecord>(*config.tuning);
    for (const ParameterInfo& info : knownParameters()) {
        std::string text = settingText(config, info.key);
        if (text != info.default_value) changes_[info.key] = std::move(text);
    }
}

Result<void> RunSettings::set(const std::string& key, const std::string& text) {
    PipelineConfig trial = config();
    if (auto done = applySetting(trial, key + "=" + text); !done) return done;
    if (text == parameterInfo(key).default_value) {
        changes_.erase(key);
    } else {
        changes_[key] = text;
    }
    return {};
}

void RunSettings::setEdits(const SurveyEdits& edits) {
    PipelineConfig edited;
    edited.edits = edits;
    for (const ParameterInfo& info : knownParameters()) {
        if (!info.key.starts_with("edits.")) continue;
        // What the program wrote itself is permitted.
        static_cast<void>(set(info.key, settingText(edited, info.key)));
    }
}

std::string RunSettings::text(const std::string& key) const {
    const auto found = changes_.find(key);
    return found != changes_.end() ? found->second : parameterInfo(key).default_value;
}

PipelineConfig RunSettings::config() const {
    PipelineConfig config;
    for (const std::string& assignment : assignments()) {
        // set() has tried it already.
        static_cast<void>(applySetting(config, assignment));
    }
    if (tuning_) config.tuning = *tuning_;
    return config;
}

std::vector<std::string> RunSettings::assignments() const {
    std::vector<std::string> list;
    for (const auto& [key, text] : changes_) list.push_back(key + "=" + text);
    return list;
}

std::vector<std::string> RunSettings::differences(const RunSettings& other) const {
    std::vector<std::string> keys;
    for (const ParameterInfo& info : knownParameters()) {
        if (text(info.key) != other.text(info.key)) keys.push_back(info.key);
    }
    return keys;
}

const std::vector<ParameterInfo>& knownParameters() {
    static const std::vector<ParameterInfo> all = [] {
        std::vector<ParameterInfo> known = describeParameters();
        std::erase_if(known, [](const ParameterInfo& info) { return info.key == kLanguageKey; });
        return known;
    }();
    return all;
}

const ParameterInfo& parameterInfo(std::string_view key) {
    static const ParameterInfo none;
    const auto& all = knownParameters();
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.key == key; });
    return found == all.end() ? none : *found;
}

}  // namespace terrawalk::gui
