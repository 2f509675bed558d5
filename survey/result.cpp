#include "survey/result.hpp"

#include <fmt/format.h>

namespace terrawalk {

// Bytes quoted from a damaged file must not reach a terminal as control codes or as broken UTF-8.
std::string printable(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = byte < 0x80                   ? 1
                                   : byte >= 0xC2 && byte < 0xE0 ? 2
                                   : byte >= 0xE0 && byte < 0xF0 ? 3
                                   : byte >= 0xF0 && byte < 0xF5 ? 4
                                                                 : 0;
        bool whole = length > 0 && i + length <= text.size() && byte >= 0x20 && byte != 0x7F;
        for (std::size_t k = 1; whole && k < length; ++k) {
            whole = (static_cast<unsigned char>(text[i + k]) & 0xC0) == 0x80;
        }
        // U+0080..U+009F are control codes as well.
        if (whole && length == 2 && byte == 0xC2 && static_cast<unsigned char>(text[i + 1]) < 0xA0)
            whole = false;
        if (whole) {
            out.append(text.substr(i, length));
            i += length;
        } else {
            out += fmt::format("\\x{:02x}", byte);
            ++i;
        }
    }
    return out;
}

std::string Error::text() const {
    std::string out;
    if (!file.empty()) {
        out += file.string();
        if (line > 0) out += fmt::format(":{}", line);
        out += ": ";
    }
    out += message;
    if (!cure.empty()) out += "; " + cure;
    return printable(out);
}

}  // namespace terrawalk
