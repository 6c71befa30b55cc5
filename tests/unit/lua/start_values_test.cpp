// Values of parameters that whoever starts a system gives.
#include "bindings/lua/files/start_values.hpp"

#include <catch2/catch.hpp>

#include "bindings/lua/files/system_file.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace std::string_literals;

namespace {

struct ValueRig {
    ValueRig() {
        folder.write("behaviors/it.lua", "param('speed', 0.1)\nparam('name', 'a')\n");
        file = folder.write("system.lua",
                            "behavior 'it' { script = 'it', config = { speed = 0.2 },\n"
                            "  sets = { fast = { speed = 0.9 }, slow = { speed = 0.01 } }, set = 'fast' }\n"
                            "behavior 'other' { script = 'it' }\n");
    }
    // What 'it' has after these, or the error.
    Expected<BehaviorEntry> with(const StartValues& values) const {
        const Project project = Project::of(file, {});
        auto spec = read_system_file(file, project);
        if (!spec) return Unexpected(spec.error());
        if (auto ok = apply(values, *spec, project); !ok) return Unexpected(ok.error());
        return std::get<BehaviorEntry>(spec->entries.front());
    }
    ParameterValue value(const std::string& text) const {
        return with({.set = {"it.name=" + text}}).value().config.at("name");
    }

    Scratch folder;
    std::filesystem::path file;
};

}  // namespace

TEST_CASE("a value is what Lua would read, and any other word a text", "[lua][files]") {
    const ValueRig rig;
    CHECK(rig.value("30") == ParameterValue{std::int64_t{30}});
    CHECK(rig.value("-0.5") == ParameterValue{-0.5});
    CHECK(rig.value("true") == ParameterValue{true});
    CHECK(rig.value("fast") == ParameterValue{"fast"s});
    CHECK(rig.value("\"5\"") == ParameterValue{"5"s});
    CHECK(rig.value("a=b") == ParameterValue{"a=b"s});
    CHECK(rig.value("{ 1.0, 0.5 }") == ParameterValue{std::vector<double>{1.0, 0.5}});
    CHECK(rig.value("inf") == ParameterValue{"inf"s});
}

TEST_CASE("the last value counts, over the file's and over the set in use", "[lua][files]") {
    const ValueRig rig;
    const auto entry = rig.with({.set = {"it.speed=0.3", "it.speed=0.4"}});
    REQUIRE(entry);
    CHECK(entry->config.at("speed") == ParameterValue{0.4});
    CHECK(entry->sets.at("fast").at("speed") == ParameterValue{0.4});
    CHECK(entry->sets.at("slow").at("speed") == ParameterValue{0.01});
    CHECK(entry->places.at("config.speed").file == "--set it.speed=0.4");
}

TEST_CASE("a saved system's parameters and sets hold, and a value set by hand over them", "[lua][files]") {
    const ValueRig rig;
    const std::string saved = rig.folder
                                  .write("saved.lua",
                                         "behavior 'it' { script = 'it', config = { speed = 0.6, name = 'b' } }\n"
                                         "behavior 'gone' { script = 'it' }\n")
                                  .string();
    const auto entry = rig.with({.file = saved, .set = {"it.name=c"}});
    REQUIRE(entry);
    CHECK(entry->config.at("speed") == ParameterValue{0.6});
    CHECK(entry->config.at("name") == ParameterValue{"c"s});
    CHECK(entry->set.empty());
    CHECK(entry->sets.empty());

    const std::string other =
        rig.folder.write("other.lua", "\nbehavior 'ohter' { script = 'it', config = { speed = 1 } }\n").string();
    const auto refused = rig.with({.file = other});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().place.line == 2);
    CHECK(refused.error().message.ends_with(
        " has no behavior 'ohter' (did you mean 'other'?): --params wants a file that save has written of it"));
}
