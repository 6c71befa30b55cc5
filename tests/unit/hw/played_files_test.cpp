// Logged device files, and a log that replaces devices.
#include "hw/log/played_files.hpp"

#include <fcntl.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>

#include "engine/base/whole_file.hpp"
#include "hw/log/logged_files.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

std::shared_ptr<PlayedFiles> played(const std::string& lines) {
    auto log = read_device_log(device_log_header() + lines, "x.log");
    if (!log) FAIL(describe(log.error()));
    return std::make_shared<PlayedFiles>(std::move(*log), "x.log");
}

std::string said(Node& node) {
    const auto text = node.read();
    return text ? std::string(*text) : describe(text.error());
}

std::string log_text(const Scratch& folder) { return *read_whole(folder.path("x.log"), "x.log"); }

// The lines of a log without their times.
std::vector<std::string> calls_of(const std::string& text) {
    std::vector<std::string> calls;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const auto blank = line.find(' ', line.find(' ') + 1);
        calls.push_back(line.substr(std::min(blank, line.size() - 1) + 1));
    }
    return calls;
}

}  // namespace

TEST_CASE("a log has all accesses of drivers, with paths in /dev and /sys", "[hw][log]") {
    const Scratch folder;
    folder.write("d/rtled0", "1");
    folder.write("s/class/hwmon/hwmon0/name", "rpi_volt\n");
    DeviceRoots roots{.dev = folder.path("d").string(), .sys = folder.path("s").string()};
    auto logged = LoggedFiles::create(folder.path("x.log").string(), roots);
    REQUIRE(logged);
    roots.files = *logged;
    {
        Node led(roots.in_dev() + "/rtled0", Access::write), other(roots.in_dev() + "/rtled1", Access::write),
            name(roots.in_sys() + "/class/hwmon/hwmon0/name", Access::read);
        CHECK(led.write("0"));
        CHECK_FALSE(other.write("1"));
        CHECK(said(name) == "rpi_volt\n");
        CHECK(roots.files->list(roots.sys + "/class/hwmon"));
        CHECK(led.write(std::string(2000, 'x')));
    }
    (*logged)->end();
    CHECK((*logged)->close() == 0);
    const auto calls = calls_of(log_text(folder));
    CHECK(calls == std::vector<std::string>{
                       "log 1", "open-write /dev/rtled0 = ok", "write /dev/rtled0 \"0\" = 1",
                       "open-write /dev/rtled1 = ENOENT", "open-read /sys/class/hwmon/hwmon0/name = ok",
                       "read /sys/class/hwmon/hwmon0/name = \"rpi_volt\\n\"", "list /sys/class/hwmon = \"hwmon0\\n\"",
                       "write /dev/rtled0 \"" + fingerprint(std::string(2000, 'x')) + "\" = 2000", calls.back()});
    CHECK(read_device_log(log_text(folder), "x.log"));
}

TEST_CASE("the older log has another name until the new one is whole", "[hw][log]") {
    const Scratch folder;
    const std::string file = folder.write("x.log", "older\n").string();
    auto logged = LoggedFiles::create(file, {});
    REQUIRE(logged);
    CHECK(text_of_file(file + "~") == "older\n");
    CHECK((*logged)->file().told_of_older() == ", and the previous file is now " + file + "~");
    (*logged)->end();
    CHECK((*logged)->close() == 0);
    CHECK(read_device_log(log_text(folder), "x.log"));
    CHECK_FALSE(std::filesystem::exists(file + "~"));
}

TEST_CASE("a log that can't be written is refused, and a later write error delays no driver", "[hw][log]") {
    const auto none = LoggedFiles::create("/no/such/folder/x.log", {});
    REQUIRE_FALSE(none);
    CHECK(describe(none.error()) == "/no/such/folder/x.log: can't be written: No such file or directory");
    const Scratch folder;
    folder.write("rtled0", "1");
    DeviceRoots roots{.dev = folder.path("").parent_path().string(), .sys = ""};
    auto full = LoggedFiles::create("/dev/full", roots);
    REQUIRE(full);
    roots.files = *full;
    Node led(roots.in_dev() + "/rtled0", Access::write);
    for (int i = 0; i < 100; ++i) CHECK(led.write("1"));
    CHECK(FakeRobot::wait_until([&] { return (*full)->problem() == ENOSPC; }, 5));
    CHECK(led.write("0"));
}

TEST_CASE("a call that never returns is in the log too", "[hw][log][fakes]") {
    FakeMouse fake;
    DeviceRoots roots = fake.roots();
    auto logged = LoggedFiles::create(fake.folder.path("x.log").string(), roots);
    REQUIRE(logged);
    roots.files = *logged;
    fake.fault("rtswitch0", "hang");
    std::thread reader([&] {
        Node node(roots.in_dev() + "/rtswitch0", Access::read);
        static_cast<void>(node.read());
    });
    sleep_for(0.3);
    CHECK((*logged)->close() == 0);
    fake.say("heal");
    reader.join();
    CHECK(log_text(fake.folder).find(" never ") != std::string::npos);
}

TEST_CASE("a replayed reading gives the log's value at the log's time", "[hw][log][wallclock]") {
    const double before = clock_seconds();
    const auto files = played(
        "0 0 open-read /dev/x = ok\n0 0.001 read /dev/x = \"1\"\n0.5 0.1 read /dev/x = \"2\"\n"
        "0.7 0 read /dev/x = EIO\n0.9 0 open-read /dev/x = ENODEV\n1.2 0 open-read /dev/x = ok\n"
        "1.2 0 read /dev/x = \"3\"\n");
    const double begin = clock_seconds();
    const auto at = [&](double tm) { sleep_for(std::max(0.0, begin + tm - clock_seconds())); };
    Node node({"/dev/x", files}, Access::read);
    CHECK(said(node) == "1");
    CHECK(said(node) == "1");  // again: the last known value
    at(0.53);
    CHECK(said(node) == "2");
    CHECK(clock_seconds() - before >= 0.6);  // it took its time
    at(0.8);
    CHECK(said(node) == "/dev/x: input/output error");
    at(1.0);
    CHECK(said(node) == "/dev/x: no such device");
    at(1.3);
    CHECK(said(node) == "3");
    CHECK(files->is_over());
}

TEST_CASE("a device that hung in the log hangs when it is played, until the end", "[hw][log][wallclock]") {
    const auto files = played("0 0 open-read /dev/x = ok\n0 never read /dev/x =\n");
    std::atomic<bool> is_back = false;
    std::thread reader([&] {
        Node node({"/dev/x", files}, Access::read);
        static_cast<void>(node.read());
        is_back = true;
    });
    sleep_for(0.5);
    CHECK_FALSE(is_back);
    files->finish();
    reader.join();
    CHECK(is_back);
}

TEST_CASE("a device that is not in the log does not exist in a replay", "[hw][log]") {
    const auto files = played("0 0 open-read /dev/x = ok\n0 0 list /sys/class/a = \"one\\ntwo\"\n");
    Node other({"/dev/y", files}, Access::read), unread({"/dev/x", files}, Access::read);
    CHECK(said(other) == "/dev/y: no such file or directory");
    CHECK(said(unread) == "/dev/x: no data available");
    CHECK(files->list("/sys/class/b") == tl::make_unexpected(ENOENT));
    CHECK(files->list("/sys/class/a") == std::vector<std::string>{"one", "two"});
    CHECK_FALSE(files->are_real());
}

TEST_CASE("with a robot's log the drivers give the same readings and make the same writes",
          "[hw][log][fakes][wallclock]") {
    const std::string model = GENERATE("raspimouse", "ev3");
    INFO(model);
    const Scratch folder;
    const std::string file = folder.path("x.log").string();
    const auto drive = [](DrivenRobot& robot) {
        robot.run(1);
        robot.run(1.5, {.vx = 0.1});
        robot.run(0.7, {.va = 1});
        robot.run(0.8);
    };
    const char* pose_port = model == "ev3" ? "odometry" : "current_pose_out";
    Pose2D recorded;
    std::vector<std::string> told;
    const auto record = [&](FakeRobot& fake, DeviceRoots roots, const std::string& failing) {
        auto logged = LoggedFiles::create(file, roots);
        REQUIRE(logged);
        roots.files = *logged;
        {
            DrivenRobot robot(shipped_spec(model), roots);
            robot.run(0.5);
            fake.fault(failing, "eio");
            drive(robot);
            recorded = robot.published<Pose2D>(pose_port);
            told = robot.log;
            for (std::string& line : told) {
                for (const auto& [root, name] : {std::pair{roots.dev, "/dev"}, {roots.sys, "/sys"}}) {
                    if (const auto at = line.find(root); at != line.npos) line.replace(at, root.size(), name);
                }
            }
            (*logged)->end();
        }
        CHECK((*logged)->close() == 0);
    };
    if (model == "ev3") {
        FakeEv3 fake;
        record(fake, fake.roots(), "in2/value0");
    } else {
        FakeMouse fake;
        record(fake, fake.roots(), "rtswitch1");
    }
    REQUIRE(recorded.position.x > 0.05);
    REQUIRE(told.size() == 1);
    auto log = read_device_log(*read_whole(file, file), "x.log");
    REQUIRE(log);
    DeviceRoots roots;
    const auto files = std::make_shared<PlayedFiles>(std::move(*log), "x.log");
    roots.files = files;
    DrivenRobot robot(shipped_spec(model), roots);
    robot.run(0.5);
    drive(robot);
    const Pose2D pose = robot.published<Pose2D>(pose_port);
    // A few milliseconds with the other direction make a difference of some pulses.
    CHECK(pose.position.x == Approx(recorded.position.x).margin(0.02));
    CHECK(pose.heading == Approx(recorded.heading).margin(0.2));
    CHECK(robot.log == told);
    std::vector<std::string> differences = files->finish();
    CHECK(differences == std::vector<std::string>{});
    CHECK(files->comparison().compared() > 20);
}
