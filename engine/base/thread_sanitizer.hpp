// Defines NEZUMI_THREAD_SANITIZER if this is built with ThreadSanitizer, which clang and g++ announce differently.
#pragma once

#if defined(__SANITIZE_THREAD__)
#define NEZUMI_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define NEZUMI_THREAD_SANITIZER
#endif
#endif
