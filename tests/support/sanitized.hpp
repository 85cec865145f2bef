// Whether a sanitizer watches, which makes a program take ten to a hundred times as long.
#pragma once

namespace hapbeam::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif
#else
inline constexpr bool sanitized = false;
#endif

/// So many trials, a tenth of them where a sanitizer watches: it sees nothing new in the others.
constexpr int trials(int many) { return sanitized ? many / 10 : many; }

}  // namespace hapbeam::testing
