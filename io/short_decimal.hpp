#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace terrawalk {

/// Reads [-]digits[.digits] at `at`, the form in which loggers write nearly all of their numbers. The
/// character after the number must be readable (a line end will do). Returns the end of the number, or null
/// when the text is of another form or too long to be exact here; then a general parser has to look at it.
///
/// The value is the correctly rounded one: up to 2^53 the digits are exact in a double, and so are the powers
/// of ten up to 10^22, so that one division rounds once (Clinger 1990, "How to read floating point numbers
/// accurately").
[[nodiscard]] inline const char* readShortDecimal(const char* at, double& value) {
    constexpr std::array<double, 20> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,
                                                   1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13,
                                                   1e14, 1e15, 1e16, 1e17, 1e18, 1e19};
    constexpr std::uint64_t exact = std::uint64_t{1} << 53U;
    const auto digit = [](char c) {
        return static_cast<unsigned>(c) - unsigned{'0'};
    };

    const bool negative = *at == '-';
    if (negative) ++at;
    std::uint64_t digits = 0;
    const char* const whole_begin = at;
    for (unsigned d = digit(*at); d <= 9; d = digit(*at)) {
        digits = 10 * digits + d;
        ++at;
    }
    auto count = at - whole_begin;
    std::ptrdiff_t decimals = 0;
    if (*at == '.') {
        const char* const decimals_begin = ++at;
        for (unsigned d = digit(*at); d <= 9; d = digit(*at)) {
            digits = 10 * digits + d;
            ++at;
        }
        decimals = at - decimals_begin;
        count += decimals;
    }
    // More than 19 digits may have overflowed.
    if (count == 0 || count > 19 || digits > exact) return nullptr;
    const double magnitude = static_cast<double>(digits) / powers_of_ten[static_cast<std::size_t>(decimals)];
    value = negative ? -magnitude : magnitude;
    return at;
}

}  // namespace terrawalk
