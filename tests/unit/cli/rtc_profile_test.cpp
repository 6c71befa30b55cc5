// Behaviours from RTCBuilder's profiles, and back.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/new/behavior.hpp"
#include "bindings/cli/new/profile_behavior.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "engine/project/project.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(const fs::path& folder, std::string_view extension) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == extension) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

// The profile of a behaviour's text, as XML.
std::string profile_text(const fs::path& file, const std::string& text) {
    ScriptContext context{.component = "it"};
    context.find_module = modules_of(Project::of(file, {root}));
    const auto script = Script::load({file.string(), file.string(), text}, std::move(context));
    REQUIRE(script);
    const auto written = openrtm::write_component_profile(profile_of(**script), "2026-01-31T12:00:00Z");
    REQUIRE(written);
    return *written;
}

}  // namespace

TEST_CASE("each kind of profile becomes a behaviour whose scenario passes", "[cli][new][rtc]") {
    const Scratch folder;
    folder.write("behaviors/readme.txt", "");
    const auto profiles = files_in(root / "tests/golden/rtc_profiles", ".xml");
    CHECK(profiles.size() == 10);
    for (const fs::path& profile : profiles) {
        const auto made = run_nezumi({"new", "behavior", "--rtc", profile.string()}, folder.path().string());
        INFO(profile << "\n" << made.error);
        CHECK(made.status == 0);
    }
    const auto tested = run_nezumi({"test"}, folder.path().string());
    INFO(tested.out << tested.error);
    CHECK(tested.status == 0);
    CHECK(tested.out.find("10 runs: 10 passed") != std::string::npos);
}

TEST_CASE("a shipped behaviour that goes through a profile declares the same as before", "[cli][new][rtc]") {
    std::size_t count = 0;
    for (const fs::path& file : files_in(root / "behaviors", ".lua")) {
        const std::string before = profile_text(file, text_of_file(file.string()));
        const auto profile = openrtm::read_component_profile(before, "RTC.xml");
        REQUIRE(profile);
        std::vector<std::string> remarks;
        const auto texts = write_behavior({.name = "", .base = parts_of(*profile, new_messages(), remarks)});
        INFO(file << "\n" << (texts ? texts->behavior : texts.error().message));
        REQUIRE(texts);
        // A behaviour without on_execute gets one; all else is as it was.
        const std::string never = "<rtc:OnExecute xsi:type=\"rtcDoc:action_status_doc\" rtc:implemented=\"false\" />";
        std::string expected = before;
        if (const std::size_t at = expected.find(never); at != std::string::npos)
            expected.replace(at, never.size(), never.substr(0, never.size() - 9) + "true\" />");
        CHECK(profile_text(file, texts->behavior) == expected);
        ++count;
    }
    CHECK(count > 10);
}

TEST_CASE("options of the command line are added to a profile", "[cli][new][rtc]") {
    openrtm::ComponentProfile profile{.name = "Base", .vendor = "theirs", .category = "test"};
    profile.ports = {{.name = "in", .type = "TimedLong"}};
    std::vector<std::string> remarks;
    const auto texts = write_behavior({.name = "Other",
                                       .outputs = {"out:TimedLong"},
                                       .about = {.vendor = "mine"},
                                       .base = parts_of(profile, new_messages(), remarks)});
    REQUIRE(texts);
    CHECK(texts->name == "other");
    CHECK(texts->behavior.find("about { vendor = \"mine\", category = \"test\" }") != std::string::npos);
    CHECK(texts->behavior.find("input(\"in\"") != std::string::npos);
    CHECK(texts->behavior.find("output(\"out\"") != std::string::npos);
    const auto twice =
        write_behavior({.name = "", .inputs = {"in:TimedLong"}, .base = parts_of(profile, new_messages(), remarks)});
    REQUIRE_FALSE(twice);
    CHECK(twice.error().message == "--in 'in': the name is given twice");
}
