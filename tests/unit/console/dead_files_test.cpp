// A file system that does not answer costs the line that asks for it, no tick, no other line and not the end.
#include <catch2/catch.hpp>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

namespace {

using Clock = std::chrono::steady_clock;

// The disk, until nothing below the name comes back any more, as from a server that is gone.
class DeadFiles final : public ProjectFiles {
public:
    std::filesystem::path working_folder() const override { return disk().working_folder(); }
    std::string what_is(const std::filesystem::path& path) const override { return wait(path), disk().what_is(path); }
    std::vector<std::string> names_in(const std::filesystem::path& folder) const override {
        return wait(folder), disk().names_in(folder);
    }
    Expected<std::string> read(const std::filesystem::path& path, const std::string& shown) const override {
        wait(path);
        return disk().read(path, shown);
    }

    void die(std::string name) {
        const std::lock_guard lock(mutex_);
        name_ = std::move(name);
    }
    bool is_asked() const {
        const std::lock_guard lock(mutex_);
        return asked_;
    }

private:
    void wait(const std::filesystem::path& path) const {
        std::unique_lock lock(mutex_);
        if (name_.empty() || path.filename() != name_) return;
        asked_ = true;
        never_.wait(lock, [] { return false; });
    }

    mutable std::mutex mutex_;
    mutable std::condition_variable never_;
    mutable bool asked_ = false;
    std::string name_;
};

// Threads wait for it until the process ends.
DeadFiles& dead_files() { return *new DeadFiles; }

void serve(SessionRig& it) {
    it.session->serve(Clock::now() + std::chrono::milliseconds(5));
    it.turn();
}

}  // namespace

TEST_CASE(
    "reload() and restart() of files that never answer delay no tick and no other console, and can be interrupted",
    "[console][files]") {
    const std::string line = GENERATE("reload()", "restart()");
    const std::string file = GENERATE("counter.lua", "system.lua");
    if (line == "reload()" && file == "system.lua") return;  // it does not look there
    CAPTURE(line, file);
    DeadFiles& files = dead_files();
    SessionRig it(counter_system, {{"counter", counter_behavior}}, {}, files);
    auto other = std::move(Session::create(*it.live, it, {}).value());
    files.die(file);

    it.session->submit(line);
    const std::int64_t before = it.live->system().now().tick;
    const auto until = Clock::now() + std::chrono::milliseconds(300);
    while (Clock::now() < until || !files.is_asked()) serve(it);
    CHECK(it.session->is_busy());
    CHECK(it.live->system().now().tick > before + 10);

    other->submit("controller.state.count");
    while (other->is_busy()) other->advance();

    it.session->interrupt();
    CHECK(it.shown == "! interrupted");
    CHECK(it.live->starts() == 1);
    CHECK(it.type("1 + 1") == "! the interrupted command did not end: definitions made in this console are lost\n2");

    it.session->submit(line);
    for (int i = 0; i < 20; ++i) serve(it);
    const auto ending = Clock::now();
    it.session.reset();
    CHECK(Clock::now() - ending < std::chrono::seconds(10));
}

TEST_CASE("adding a component from files that never answer delays no tick, and can be interrupted",
          "[console][files]") {
    const auto [file, line] = GENERATE(
        table<std::string, std::string>({{"late.lua", "behavior 'x' { script = 'late' }"},
                                         {"part.lua", "behavior 'x' { script = 'whole' }"},
                                         {"model.lua", "robot 'x' { model = 'model', pose = { x = -1 } }"},
                                         {"x.calibration.lua", "robot 'x' { model = 'raspimouse', calibrated = true }"},
                                         {"table.csv", "robot 'x' { model = 'tabled', pose = { x = -1 } }"}}));
    CAPTURE(file, line);
    DeadFiles& files = dead_files();
    const std::string sensor = "sensors = { right_front = { table = 'table.csv' } }";
    SessionRig it(counter_system,
                  {{"counter", counter_behavior},
                   {"late", counter_behavior},
                   {"part", "return {}"},
                   {"whole", "require 'part'\nfunction on_execute() end"},
                   {"model", "return robot_model { base = 'raspimouse' }"},
                   {"tabled", "return robot_model { base = 'raspimouse', " + sensor + " }"}},
                  {}, files);
    it.folder.write("behaviors/table.csv", "0,100\n1,0\n");
    files.die(file);

    it.session->submit(line);
    const std::int64_t before = it.live->system().now().tick;
    const auto until = Clock::now() + std::chrono::milliseconds(200);
    while (Clock::now() < until || !files.is_asked()) serve(it);
    CHECK(it.session->is_busy());
    CHECK(it.live->system().now().tick > before + 10);

    it.session->interrupt();
    CHECK(it.shown == "! interrupted");
    CHECK(it.live->system().find("x") == nullptr);
}

TEST_CASE("restart() reports an error of the system file, and nothing has changed", "[console][files]") {
    SessionRig it;
    it.folder.write("system.lua", "while true do end");
    CHECK(it.type("restart()").find("endless loop") != std::string::npos);
    it.folder.write("system.lua", "robot \"mouse\" { model = \"raspimous\" }");
    CHECK(it.type("restart()").find("there is no robot model 'raspimous' (did you mean 'raspimouse'?)") !=
          std::string::npos);
    it.folder.write("system.lua", counter_system);
    it.folder.write("behaviors/counter.lua", "function on_execute( end");
    CHECK(it.type("restart()").find("counter.lua:1:") != std::string::npos);
    CHECK(it.live->starts() == 1);
    it.folder.write("behaviors/counter.lua", counter_behavior);
    CHECK(it.type("restart()") == "restarted, time is 0");
    CHECK(it.live->starts() == 2);
}
