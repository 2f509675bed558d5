#pragma once

namespace terrawalk::test {

/// What sanitizers cost: limits of time are as many times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int kSlack = 10;
#else
inline constexpr int kSlack = 1;
#endif

}  // namespace terrawalk::test
