// Defines NEZUMI_ADDRESS_SANITIZER if this is built with AddressSanitizer, which clang and g++ announce differently. It
// checks only blocks of `malloc`.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define NEZUMI_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define NEZUMI_ADDRESS_SANITIZER
#endif
#endif
