// Whether this is built with AddressSanitizer, which clang and g++ say in different ways: NEZUMI_ADDRESS_SANITIZER.
// It knows the blocks of `malloc` and no others.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define NEZUMI_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define NEZUMI_ADDRESS_SANITIZER
#endif
#endif
