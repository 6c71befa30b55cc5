// Saving a file changes the running robot; a bad save is told and changes nothing; no tick waits for either.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "bindings/lua/reload/lua_host.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "engine/live/running_system.hpp"

using namespace nezumi;
using Catch::Matchers::EndsWith;

namespace {

namespace fs = std::filesystem;
using Text = std::string;
using Clock = std::chrono::steady_clock;

// Whole, by renaming: on a busy machine a file that is written in place may be read while it is still empty.
void write(const Text& path, const Text& text) {
    std::ofstream(path + ".new") << text;
    fs::rename(path + ".new", path);
}

// A system that ticks at 100 Hz by the clock.
struct Live {
    explicit Live(const Text& text, const Text& system = "behavior 'it' { script = 'it' }") {
        fs::remove_all(folder);
        fs::create_directories(folder);
        write(file, text);
        write(system_file, system);
        LiveOptions options;
        options.scripts = &lua_scripts();
        options.watch = true;
        options.build.log = [this](const LogLine& line) { log.push_back(line.text); };
        live = std::move(RunningSystem::load(system_file, std::move(options)).value());
        live->activate();
        run(10);
    }
    ~Live() {
        live.reset();
        fs::remove_all(folder);
    }

    void run(int ticks) {
        for (; ticks > 0; --ticks) {
            std::this_thread::sleep_until(next);
            const std::int64_t began = thread_time();
            live->tick();
            longest = std::max(longest, static_cast<double>(thread_time() - began) * 1e-9);
            next = std::max(next + std::chrono::milliseconds(10), Clock::now());
        }
    }
    bool says(const Text& part) {
        const auto end = Clock::now() + std::chrono::seconds(20);
        for (; Clock::now() < end; ++ticks_until_said) {
            for (const Text& line : log) {
                if (line.find(part) != Text::npos) return true;
            }
            run(1);
        }
        for (const Text& line : log) UNSCOPED_INFO(line);
        return false;
    }
    std::int32_t value(const Text& name = "it") const {
        return live->system().find(name)->find_out_port("out")->value().get<std::int32_t>();
    }

    fs::path folder = fs::temp_directory_path() / ("nezumi_live_" + std::to_string(::getpid()));
    Text file = (folder / "it.lua").string();
    Text system_file = (folder / "system.lua").string();
    std::vector<Text> log;
    std::unique_ptr<RunningSystem> live;
    Clock::time_point next = Clock::now();
    int ticks_until_said = 0;
    double longest = 0;  // [s] of CPU time that a tick took
};

Text writes(const Text& value, const Text& more = "") {
    return more + "local out = output('out', 'TimedLong') function on_execute() out:write(" + value + ") end\n";
}

}  // namespace

TEST_CASE("saving a file changes the running behaviour", "[lua][reload]") {
    Live it(writes("1"));
    CHECK(it.value() == 1);
    write(it.file, writes("2"));
    CHECK(it.says("it.lua: version 2 runs in it"));
    it.run(1);
    CHECK(it.value() == 2);
}

TEST_CASE("a saved file with an error is reported, and the next correct one runs", "[lua][reload]") {
    Live it(writes("1"));
    write(it.file, "function on_execute( end");
    CHECK(it.says("it.lua:1: <name> or '...' expected near 'end'; still running version 1"));
    it.run(5);
    CHECK(it.value() == 1);
    CHECK(std::count_if(it.log.begin(), it.log.end(),
                        [](const Text& line) { return line.find("still running") != Text::npos; }) == 1);
    write(it.file, writes("3"));
    CHECK(it.says("version 2 runs in it"));
}

TEST_CASE("a script that becomes a FIFO is reported once, and reloads when it is a file again", "[lua][reload]") {
    Live it(writes("1"));
    fs::remove(it.file);
    REQUIRE(::mkfifo(it.file.c_str(), 0600) == 0);
    CHECK(it.says("it.lua: is a FIFO, expected a file: the loaded version continues"));
    it.log.clear();
    it.run(120);
    CHECK(it.log.empty());
    CHECK(it.value() == 1);
    const auto refused = it.live->act(Reload{}, {});
    REQUIRE_FALSE(refused);
    CHECK_THAT(describe(refused.error()), EndsWith("it.lua: is a FIFO, expected a file; still running version 1"));
    fs::remove(it.file);
    write(it.file, writes("2"));
    CHECK(it.says("version 2 runs in it"));
}

TEST_CASE("a deleted system file is reported once", "[lua][reload]") {
    Live it(writes("1"));
    fs::remove(it.system_file);
    CHECK(it.says("system.lua: there is no such file: the loaded version continues"));
    it.log.clear();
    it.run(120);
    CHECK(it.log.empty());
}

TEST_CASE("a script whose top level never ends delays no tick", "[lua][reload][watchdog]") {
    Live it(writes("1"));
    it.longest = 0;
    write(it.file, writes("2") + "while true do end");
    CHECK(it.says("it.lua:2: ran for more than 0.1 s: is there an endless loop?; still running version 1"));
    CHECK(it.longest < paced_budget.seconds);  // it does not load the file itself,
    CHECK(it.ticks_until_said > 5);            // nor wait for who does
    CHECK(it.value() == 1);
    write(it.file, writes("4"));
    CHECK(it.says("version 2 runs in it"));
}

TEST_CASE("a file that is saved during another reload is reloaded as well", "[lua][reload][watchdog]") {
    Live it(writes("1"));
    write(it.file, writes("2") + "while true do end");
    it.run(4);
    write(it.file, writes("5"));
    CHECK(it.says("version 2 runs in it"));
    it.run(1);
    CHECK(it.value() == 5);
}

TEST_CASE("a script that takes long to load is used", "[lua][reload]") {
    Live it(writes("1"));
    write(it.file, writes("6", "for i = 1, 3000000 do end "));
    CHECK(it.says("version 2 runs in it"));
    it.run(1);
    CHECK(it.value() == 6);
}

TEST_CASE("a new or corrected module reloads the scripts that require it", "[lua][reload]") {
    Live it(writes("1"));
    write(it.file, writes("require_me", "local require_me = require 'module' "));
    CHECK(it.says("still running version 1"));
    it.log.clear();
    write((it.folder / "module.lua").string(), "return = 7");
    CHECK(it.says("module.lua:1: unexpected symbol near '='; still running version 1"));
    write((it.folder / "module.lua").string(), "return 7");
    CHECK(it.says("version 2 runs in it"));
    it.run(1);
    CHECK(it.value() == 7);
    // The save that put it right is not loaded again as one that changed a file.
    write((it.folder / "module.lua").string(), "return 8");
    CHECK(it.says("version 3 runs in it"));
    it.run(1);
    CHECK(it.value() == 8);
}

TEST_CASE("a changed system file is reported with the command to use it", "[lua][reload]") {
    Live it(writes("1"));
    write(it.system_file, "another system");
    CHECK(it.says("system.lua has changed: restart() to use it"));
}

TEST_CASE("loading a file for many behaviours delays no tick", "[lua][reload][watchdog]") {
    constexpr int many = 40;
    Text system;
    for (int i = 1; i <= many; ++i) system += "behavior 'b" + std::to_string(i) + "' { script = 'it' }\n";
    const Text slow = "for i = 1, 1000000 do end ";
    Live it(writes("1", slow), system);
    const std::int64_t began = thread_time();
    REQUIRE(it.live->act(Reload{.files = {it.file}}, {}));
    const double at_once = static_cast<double>(thread_time() - began) * 1e-9;
    it.longest = 0;
    write(it.file, writes("2", slow));
    CHECK(it.says("it.lua: version 3 runs in b1, b2, b3, b4, b5 and 35 more"));
    it.run(1);
    CHECK(it.value("b1") == 2);
    CHECK(it.value("b40") == 2);
    CHECK(it.longest < at_once / 4);
}
