// What servers leave of a process's descriptors.

#include <catch2/catch.hpp>

#include "engine/base/descriptor.hpp"

using namespace nezumi;

TEST_CASE("servers leave descriptors for files, and the page more of them for consoles", "[engine][base]") {
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_NOFILE, &before) == 0);
    const auto limited_to = [&](rlim_t count) {
        const rlimit limit{count, before.rlim_max};
        REQUIRE(setrlimit(RLIMIT_NOFILE, &limit) == 0);
    };
    limited_to(1024);
    CHECK(leaves_free(991, for_files));
    CHECK_FALSE(leaves_free(992, for_files));
    CHECK(leaves_free(927, for_files_and_consoles));
    CHECK_FALSE(leaves_free(928, for_files_and_consoles));
    limited_to(64);  // where there are few, they leave a part
    CHECK(leaves_free(55, for_files));
    CHECK_FALSE(leaves_free(56, for_files));
    CHECK(leaves_free(47, for_files_and_consoles));
    CHECK_FALSE(leaves_free(48, for_files_and_consoles));
    REQUIRE(setrlimit(RLIMIT_NOFILE, &before) == 0);
}
