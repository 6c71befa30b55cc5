// Defines NEZUMI_THREAD_SANITIZER and NEZUMI_ADDRESS_SANITIZER if this is built with ThreadSanitizer or
// AddressSanitizer, which clang and g++ announce differently. AddressSanitizer checks only blocks of `malloc`, so
// a build with it must not use memory pools.
#pragma once

#if defined(__SANITIZE_THREAD__)
#define NEZUMI_THREAD_SANITIZER
#elif defined(__SANITIZE_ADDRESS__)
#define NEZUMI_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define NEZUMI_THREAD_SANITIZER
#elif __has_feature(address_sanitizer)
#define NEZUMI_ADDRESS_SANITIZER
#endif
#endif
