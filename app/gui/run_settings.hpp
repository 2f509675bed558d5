#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/pipeline/config.hpp"
#include "survey/result.hpp"

namespace terrawalk::gui {

/// The configuration as a person turned it: each changed setting as the text that the command line takes
/// after --set, so that both programs read the same number. Never holds a value that is not permitted.
class RunSettings {
  public:
    RunSettings() = default;
    /// What differs from the defaults.
    explicit RunSettings(const PipelineConfig& config);

    /// The default's own text takes a change back. Errors: Usage, as applySetting().
    [[nodiscard]] Result<void> set(const std::string& key, const std::string& text);
    void setEdits(const SurveyEdits& edits);
    [[nodiscard]] std::string text(const std::string& key) const;
    [[nodiscard]] bool changed(const std::string& key) const { return changes_.contains(key); }
    [[nodiscard]] PipelineConfig config() const;
    /// "key=value", by key.
    [[nodiscard]] std::vector<std::string> assignments() const;
    /// Keys of which the other has another value.
    [[nodiscard]] std::vector<std::string> differences(const RunSettings& other) const;
    /// Whether values come from a tuning: its record goes with them, and no command line can say it.
    [[nodiscard]] bool tuned() const { return tuning_ != nullptr; }
    bool operator==(const RunSettings&) const = default;

  private:
    std::map<std::string, std::string> changes_;
    std::shared_ptr<const TuningRecord> tuning_;
};

/// The report's language is the window's, and so none of the settings here.
inline constexpr std::string_view kLanguageKey = "report.language";
/// Every other parameter there is, in the order of `terrawalk config describe`; read once.
[[nodiscard]] const std::vector<ParameterInfo>& knownParameters();
/// Nothing with that key: an empty description.
[[nodiscard]] const ParameterInfo& parameterInfo(std::string_view key);

}  // namespace terrawalk::gui
