#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace terrawalk {

/// What went wrong, in the terms of who can cure it. The command line maps each kind to one exit code.
enum class ErrorKind {
    Usage,      ///< the request itself is wrong: unknown option, impossible value
    BadData,    ///< an input file is missing, damaged or contradicts itself
    Cancelled,  ///< the user stopped the work
    System,     ///< the machine refused: disk full, no permission
};

/// One error, printed as one line: "file:line: message; cure".
struct Error {
    ErrorKind kind = ErrorKind::BadData;
    std::string message;
    std::filesystem::path file;  ///< empty when no file is to blame
    std::size_t line = 0;        ///< 1-based; 0 when no line is to blame
    std::string cure;            ///< what the user can do about it; may be empty

    /// One line without control characters, whatever bytes the message quotes from a file.
    [[nodiscard]] std::string text() const;
};

/// Text from a file without control characters or broken UTF-8, fit for a terminal: such bytes become \\xNN.
[[nodiscard]] std::string printable(std::string_view text);

template <class T>
using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> badData(std::string message, std::filesystem::path file = {},
                                                   std::size_t line = 0, std::string cure = {}) {
    return tl::unexpected<Error>(
        Error{ErrorKind::BadData, std::move(message), std::move(file), line, std::move(cure)});
}
[[nodiscard]] inline tl::unexpected<Error> usageError(std::string message, std::string cure = {}) {
    return tl::unexpected<Error>(Error{ErrorKind::Usage, std::move(message), {}, 0, std::move(cure)});
}
[[nodiscard]] inline tl::unexpected<Error> systemError(std::string message, std::filesystem::path file = {},
                                                       std::string cure = {}) {
    return tl::unexpected<Error>(
        Error{ErrorKind::System, std::move(message), std::move(file), 0, std::move(cure)});
}
[[nodiscard]] inline tl::unexpected<Error> cancelled() {
    return tl::unexpected<Error>(Error{ErrorKind::Cancelled, "cancelled", {}, 0, {}});
}

}  // namespace terrawalk
