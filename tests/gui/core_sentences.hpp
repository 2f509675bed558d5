#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace terrawalk::test {

/// A text in a call that makes an error or a note, from the sources. `{}`, or with a format, where names and
/// numbers come.
struct CoreSentence {
    std::filesystem::path file;  ///< relative to the sources
    std::string text;
};

/// All of them that have two words or more, in survey/, fusion/, mapping/, io/ and app/pipeline/.
[[nodiscard]] std::vector<CoreSentence> coreSentences(const std::filesystem::path& sources);

/// The sentence with something in each of its places.
[[nodiscard]] std::string withExamples(const std::string& sentence);

}  // namespace terrawalk::test
