// Parts of the program that are loaded on first use.
#include "engine/base/module.hpp"

#include <catch2/catch.hpp>

#include <string>

#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("a module that is not built has another error than one that can't be loaded", "[engine][module]") {
    const Scratch scratch;
    const auto error_of = [](const std::string& file) {
        const auto loaded = load_function({.file = file, .function = "f", .part = "pictures", .needs = "libpicture"});
        REQUIRE_FALSE(loaded);
        return loaded.error().message;
    };
    const std::string file = scratch.path("nezumi_pictures.so").string();
    CHECK(error_of(file) == "this build of nezumi has no support for pictures: there is no " + file);
    scratch.write("nezumi_pictures.so", "no library");
    const std::string broken = error_of(file);
    CHECK(broken.starts_with("the part of nezumi for pictures can't be loaded: " + file));
    CHECK(broken.ends_with(". Install nezumi again, with what it needs: sudo apt install libpicture"));
}
