// Every field is described once: what the readers take, editors are told and the documentation's tables say is the
// same.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/console/console_fields.hpp"
#include "bindings/lua/files/robot_file.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/stubs/annotations.hpp"
#include "bindings/lua/stubs/record_annotations.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/ports/setting.hpp"
#include "engine/system/act_fields.hpp"
#include "tests/unit/cli/doc_tables.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;

// Every described structure.
std::vector<RecordShape> all_records() {
    std::vector<RecordShape> records = file_records(cli::peer_words());
    records.insert(records.end(), scenario_records().begin(), scenario_records().end());
    for (RecordShape& record : console_records()) records.push_back(std::move(record));
    return records;
}

// Where a structure's fields are written: "%" stands for them. What selects the kind stands before them.
const std::map<std::string, std::string> systems{
    {"box", "arena { box { % } }"},
    {"wall", "arena { wall { % } }"},
    {"cylinder", "arena { cylinder { % } }"},
    {"marker", "arena { marker { % } }"},
    {"maze", "arena { maze { % } }"},
    {"maze_plan", "arena { maze { generate = { % } } }"},
    {"floor", "arena { floor { % } }"},
    {"line", "arena { size = { 2, 2 }, line { % } }"},
    {"border", "arena { border = { % } }"},
    {"arena", "arena { % }"},
    {"limit_changes", "robot 'm' { model = 'raspimouse', limits = { % } }"},
    {"robot", "robot 'm' { model = 'raspimouse', % }"},
    {"behavior", "behavior 'b' { % }"},
    {"component", "component 'c' { % }"},
    {"physics", "physics { % }"},
    {"network", "network { % }"},
    {"ros", "ros { % }"},
    {"ros_topic", "ros { node = 'n', subscribe = { ['/a'] = { % } } }"},
    {"rtm", "rtm { % }"},
};
const std::string wheels = "return robot_model { mass = 1, drive = { radius = 0.02, track = 0.1 }, ";
const std::map<std::string, std::string> robots{
    {"robot_model", "return robot_model { % }"},
    {"body", wheels + "body = { % } }"},
    {"limits", "return robot_model { mass = 1, drive = { radius = 0.02, track = 0.1, limits = { % } } }"},
    {"drive", "return robot_model { mass = 1, drive = { % } }"},
    {"sensor", wheels + "sensors = { s = { % } } }"},
    {"actuator", wheels + "actuators = { a = { % } } }"},
    {"port", wheels + "ports = { p = { % } } }"},
};

// What a reader says of a structure with these fields; nothing when it is not written in a system or robot file.
std::string said_of(const RecordShape& record, const std::string& fields) {
    const auto fill = [&](std::string text) { return text.replace(text.find('%'), 1, fields); };
    const Project project = Project::of(root / "behaviors/systems/s.lua", {root});
    if (const auto system = systems.find(record.name); system != systems.end()) {
        const auto read = read_system_text(fill(system->second), "behaviors/systems/s.lua", project,
                                           {.peer_words = cli::peer_words()});
        return read ? "no error" : read.error().message;
    }
    if (const auto robot = robots.find(record.name); robot != robots.end()) {
        const auto read = read_robot_text(fill(robot->second), "engine/robots/r.lua", project);
        return read ? "no error" : read.error().message;
    }
    return "";
}

// What must stand before a field so that it counts: the kind, or what it is about.
std::string before(const RecordShape& record, const FieldRow& row) {
    const std::string kind = row.kinds.substr(0, row.kinds.find(','));
    if (record.name == "port")
        return row.name == "from" || row.name == "to" ? ""
               : kind == "in-port"                    ? "to = 'drive', "
                                                      : "from = 'velocity', ";
    if (kind.empty()) return "";
    const bool about_values = row.name == "nothing" || row.name == "min_value" || row.name == "max_value";
    return (record.name == "body" ? "shape = '" : "kind = '") + kind + "', " +
           (about_values ? "table = { { 0.1, 2 }, { 0.2, 1 } }, " : "");
}

}  // namespace

TEST_CASE("the readers take every field that is described, and no other", "[cli][fields]") {
    std::size_t tried = 0;
    for (const RecordShape& record : file_records(cli::peer_words())) {
        if (said_of(record, "").empty()) continue;
        for (const FieldRow& row : record.rows) {
            CAPTURE(record.name, row.name);
            // A thread can't be the value of any field. The field is known, so its value is what is wrong.
            const std::string said =
                said_of(record, before(record, row) + row.name + " = coroutine.create(function() end)");
            CAPTURE(said);
            CHECK(said.find("unknown field") == std::string::npos);
            CHECK(said.find(row.name) != std::string::npos);
            CHECK(said.find("got thread") != std::string::npos);
            ++tried;
        }
        CHECK(said_of(record, "zzzzzzzzz = 1").find("zzzzzzzzz'") != std::string::npos);
    }
    CHECK(tried > 80);
}

TEST_CASE("a number that is described with a bound is refused beyond it, and one without is not", "[cli][fields]") {
    std::size_t bounded = 0, free = 0;
    for (const RecordShape& record : file_records(cli::peer_words())) {
        if (said_of(record, "").empty()) continue;
        for (const FieldRow& row : record.rows) {
            const bool is_bounded = row.values == "a number from 0 to 1";
            if (!is_bounded && row.values != "a number from 0 on") continue;
            CAPTURE(record.name, row.name);
            const std::string said = said_of(record, before(record, row) + row.name + " = 1000");
            CAPTURE(said);
            CHECK((said.find("expected a number from 0 to 1, got 1000") != std::string::npos) == is_bounded);
            CHECK((is_bounded || said.find("expected a number") == std::string::npos));
            ++(is_bounded ? bounded : free);
        }
    }
    CHECK(bounded == 3);  // the noise of a model and of a robot, and the loss of neighbours
    CHECK(free > 10);
}

TEST_CASE("the editor annotations contain every described field", "[cli][fields]") {
    const std::string text = annotations(scenario_records(), cli::peer_words());
    for (const RecordShape& record : all_records()) {
        if (record.name == "port_options") continue;  // a class for each type, tried with the types
        // Of the console, which no file is written for.
        if (record.name == "plot_options" || record.name == "resume_options") continue;
        const std::size_t begin = text.find("---@class (exact) " + class_of(record.name) + "\n");
        REQUIRE(begin != std::string::npos);
        const std::string own = text.substr(begin, text.find("\n\n", begin) - begin);
        for (const FieldRow& row : record.rows) {
            CAPTURE(record.name, row.name);
            CHECK(own.find("---@field " + row.name + (row.required ? " " : "? ")) != std::string::npos);
        }
    }
    CHECK(text.find("---@field backend? string") != std::string::npos);
    CHECK(text.find("---@field widget? \"slider\"|\"spin\"|\"radio\"|\"checkbox\"|\"ordered_list\"|\"text\"") !=
          std::string::npos);
}

TEST_CASE("the documentation's tables are those of the descriptions", "[cli][fields]") {
    std::string all;
    for (const auto& entry : fs::directory_iterator(root / "docs")) {
        if (entry.path().extension() != ".md") continue;
        const auto page = read_whole(entry.path(), entry.path().string());
        REQUIRE(page.has_value());
        const auto fresh = with_field_tables(*page, all_records()).and_then(with_member_tables);
        INFO((fresh ? "run this test with NEZUMI_RENEW=1 in the environment to bring the page up to date"
                    : fresh.error().message));
        REQUIRE(fresh.has_value());
        if (std::getenv("NEZUMI_RENEW") != nullptr) std::ofstream(entry.path(), std::ios::binary) << *fresh;
        CHECK(*fresh == *page);
        all += *page;
    }
    for (const RecordShape& record : all_records()) {
        CAPTURE(record.name);
        CHECK(all.find("<!-- fields: " + record.name + " -->") != std::string::npos);
    }
    CHECK(all.find("<!-- members: component -->") != std::string::npos);
    CHECK(all.find("<!-- members: port -->") != std::string::npos);
}

TEST_CASE("every optional number field has a documented default", "[cli][fields]") {
    std::size_t numbers = 0;
    for (const RecordShape& record : all_records()) {
        for (const FieldRow& row : record.rows) {
            if (row.required || (row.type != "number" && row.type != "integer")) continue;
            CAPTURE(record.name, row.name);
            CHECK_FALSE(row.fallback.empty());
            ++numbers;
        }
    }
    CHECK(numbers > 60);
}

TEST_CASE("the pages tell all that disturb takes", "[cli][fields]") {
    const auto page = [](const fs::path& name) { return read_whole(root / "docs" / name, name.string()).value(); };
    CHECK_THAT(page("console.md"),
               Catch::Contains(":disturb " + usage_of<VelocityConstraint>(Describe<VelocityConstraint>::at_once)));
    CHECK_THAT(page("scenarios.md"),
               Catch::Contains("s:disturb(robot, " +
                               usage_of<VelocityConstraint>(Describe<VelocityConstraint>::in_scenarios) + ")"));
}

TEST_CASE("a page of documentation that asks for unknown fields or members is an error", "[cli][fields]") {
    CHECK(
        with_field_tables("a\n<!-- fields: bxo -->\n<!-- end -->\n", file_records(cli::peer_words())).error().message ==
        "there are no fields of 'bxo'");
    CHECK(with_field_tables("<!-- fields: box -->\n", file_records(cli::peer_words())).error().message ==
          "a marker for fields has no end");
    CHECK(with_member_tables("<!-- members: prot -->\n<!-- end -->\n").error().message ==
          "there are no members of 'prot'");
    CHECK(with_field_tables("no table", file_records(cli::peer_words())) == "no table");
    CHECK(with_field_tables("x\n<!-- fields: border -->\nold\n<!-- end -->\ny\n", file_records(cli::peer_words())) ==
          "x\n<!-- fields: border -->\n| field | value | default | meaning |\n|---|---|---|---|\n"
          "| `thickness` | a positive number [m] | `0.02` |  |\n| `height` | a positive number [m] | `0.1` |  |\n"
          "<!-- end -->\ny\n");
}
