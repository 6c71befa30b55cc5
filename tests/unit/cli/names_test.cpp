// Each global has one room: a name that a room exports to Lua can't be the name of a component.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "bindings/scenario/scenario_methods.hpp"
#include "engine/base/names.hpp"
#include "tests/unit/console/session_rig.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;

namespace {

void append(std::vector<std::string>& all, const auto& words) {
    for (const auto& word : words) all.emplace_back(word);
}

// What is in scope where components are: the console as it is, scenarios, system files and scripts.
std::vector<std::string> exported_words() {
    SessionRig console("arena {}", {});
    std::vector<std::string> all = console.complete("").candidates;
    append(all, ScenarioRun::Methods::names(cli::peer_words()));
    append(all, std::vector<std::string>{"scenario", "range"});
    append(all, system_word_names(cli::peer_words()));
    append(all, script_globals());
    return all;
}

}  // namespace

TEST_CASE("a component name equal to a word of the library, the console or a file is refused", "[cli][names]") {
    std::vector<std::string> words = exported_words();
    CHECK(words.size() > 100);
    append(words, sandbox_names());
    append(words, lua_keywords());
    append(words, promised_words());
    for (const std::string& word : words) {
        CHECK(system_files::system_error("behavior '" + word + "' { script = 'robot_controller' }") ==
              "s.lua:1: behavior '" + word + "': '" + word +
                  "' is a keyword of Lua or a command of the console: choose another name");
    }
}

TEST_CASE("every word that a room adds to Lua's own is promised", "[cli][names]") {
    const auto& library = sandbox_names();
    for (const std::string& word : exported_words()) {
        if (std::find(library.begin(), library.end(), word) != library.end()) continue;
        CAPTURE(word);
        CHECK(is_reserved_name(word));
    }
}

TEST_CASE("words for future commands are reserved", "[cli][names]") {
    for (const std::string_view word : {"activate",    "cancel",  "graph",   "hosts",   "line",  "log_level", "marker",
                                        "maze",        "measure", "network", "picture", "probe", "rearm",     "remove",
                                        "robot_model", "ros",     "rtm",     "start",   "stop",  "task",      "wait"}) {
        CAPTURE(word);
        CHECK(is_reserved_name(word));
    }
    CHECK_FALSE(is_reserved_name("controller"));
    CHECK_FALSE(is_reserved_name("mouse"));
}
