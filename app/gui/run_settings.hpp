#pragma once

#include <map>
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
    /// The default's own text takes a change back. Errors: Usage, as applySetting().
    [[nodiscard]] Result<void> set(const std::string& key, const std::string& text);
    [[nodiscard]] std::string text(const std::string& key) const;
    [[nodiscard]] bool changed(const std::string& key) const { return changes_.contains(key); }
    [[nodiscard]] PipelineConfig config() const;
    /// "key=value", by key.
    [[nodiscard]] std::vector<std::string> assignments() const;
    bool operator==(const RunSettings&) const = default;

  private:
    std::map<std::string, std::string> changes_;
};

/// Every parameter there is, in the order of `terrawalk config describe`; read once.
[[nodiscard]] const std::vector<ParameterInfo>& knownParameters();
/// Nothing with that key: an empty description.
[[nodiscard]] const ParameterInfo& parameterInfo(std::string_view key);

}  // namespace terrawalk::gui
