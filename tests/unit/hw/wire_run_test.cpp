// A rover whose driver is a behaviour, and all that can happen to it.
#include <asm/termbits.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "hw/wire/wire_driver.hpp"
#include "tests/unit/hw/rover_run.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("a rover of one's own drives through its driver, and brakes at the end", "[hw][wire][run][wallclock]") {
    RoverRun run;
    run.get_going();
    // The speed grows within the limits of acceleration.
    double last = 0;
    for (const FakeRover::Line& line : run.rover->lines()) {
        if (line.text.empty()) continue;
        const double speed = std::stod(line.text.substr(2));
        CHECK(speed - last < 0.05);
        last = speed;
    }
    run.program->send(SIGINT);
    CHECK(run.program->wait() == 0);
    CHECK(run.stands_within(0.1));
    CHECK(run.rover->last_line() == "v 0 0");
    CHECK(run.rover->torn_lines().empty());
}

TEST_CASE("when the engine is killed, its last line arrives whole and then the safe bytes",
          "[hw][wire][run][safety][wallclock]") {
    RoverRun run;
    run.get_going();
    const int signal = GENERATE(SIGKILL, SIGSEGV);
    const double begin = clock_seconds();
    run.program->send(signal);
    REQUIRE(run.stands_within(0.25));
    const double time = clock_seconds() - begin;
    CHECK(time < 0.05);
    CHECK(run.rover->last_line() == "v 0 0");
    CHECK(run.rover->torn_lines().empty());
    WARN("the safe bytes came " << time * 1e3 << " ms after signal " << signal);
}

TEST_CASE("when the engine stalls, the safe bytes come within 0.25 s, and it drives again afterwards",
          "[hw][wire][run][safety][wallclock]") {
    RoverRun run;
    run.get_going();
    const double begin = clock_seconds();
    run.program->send(SIGSTOP);
    REQUIRE(holds_within(1, [&] { return run.rover->last_line() == "v 0 0"; }));
    CHECK(clock_seconds() - begin < 0.25);
    run.program->send(SIGCONT);
    CHECK(
        run.program->wait_for_error("rover_line: its safe bytes were sent, as nothing came from the control loop", 5));
    CHECK(holds_within(3, [&] { return run.rover->speed() > 0.19; }));
}

TEST_CASE("a rover whose cable is pulled stops by its own time-out, and drives again when the cable is back",
          "[hw][wire][run][safety][wallclock]") {
    RoverRun run;
    run.get_going();
    run.rover->unplug();
    CHECK(run.stands_within(FakeRover::time_out + 0.1));
    CHECK(run.program->wait_for_error("rover_line: ", 5));
    const auto before = run.rover->lines().size();
    run.rover->plug();
    CHECK(holds_within(5, [&] { return run.rover->speed() > 0.19; }));
    // First what was torn ends, and the device is stopped.
    const auto lines = run.rover->lines();
    REQUIRE(lines.size() > before + 1);
    CHECK(lines[before].text.empty());
    CHECK(lines[before + 1].text == "v 0 0");
    CHECK(run.program->wait_for_error("rover_line: back again", 5));
    CHECK(run.rover->torn_lines().empty());
}

TEST_CASE("a driver that fails sends the safe bytes at once, and nothing after them",
          "[hw][wire][run][safety][wallclock]") {
    RoverRun run;
    run.folder.write("behaviors/rover_driver.lua", R"(
local target = input("target_velocity_in", "TimedVelocity2D")
local velocity = output("current_velocity_out", "TimedVelocity2D")
local line_out = output("line_out", "TimedString")
function on_execute()
  velocity:write(target:read())
  line_out:write(("v %.3f %.3f"):format(target:read().vx, target:read().va))
  if now() > 3 then error("no luck") end
end
)");
    run.get_going();
    REQUIRE(run.program->wait_for_error("no luck", 10));
    CHECK(run.stands_within(0.1));
    usleep(300000);
    CHECK(run.rover->last_line() == "v 0 0");
}

TEST_CASE("when the process that writes to a device is killed, the engine sends the safe bytes and says so",
          "[hw][wire][run][safety][wallclock]") {
    RoverRun run;
    run.get_going();
    pid_t writer = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        std::ifstream stat(entry.path() / "stat");
        std::string pid, command, state, parent;
        stat >> pid >> command >> state >> parent;
        if (command == "(motor-guard)" && parent == std::to_string(run.program->process())) writer = std::stoi(pid);
    }
    REQUIRE(writer > 0);
    kill(writer, SIGKILL);
    CHECK(run.program->wait_for_error("rover_line: the process that writes to it has ended: start the run again", 5));
    CHECK(run.stands_within(0.1));
    usleep(300000);
    CHECK(run.rover->last_line() == "v 0 0");
}

TEST_CASE("a robot with a device that can't be opened or stopped is refused with --hw, by one line",
          "[hw][wire][run]") {
    RoverRun run;
    std::string device = "path = '/dev/ttyACM0', ends = '\\n', safe = 'v 0 0\\n'", expected;
    SECTION("without safe bytes") {
        device = "path = '/dev/ttyACM0', ends = '\\n'";
        expected =
            "component 'rover_line': --hw needs the device's safe bytes: give safe = \"...\", the bytes that stop it, "
            "or safe = false in a robot file (measures_only = true in a system) if it moves nothing";
    }
    SECTION("unplugged") {
        run.rover->unplug();
        expected = "/ttyACM0: no such file or directory: is the device plugged in?";
    }
    SECTION("no serial line") {
        device = "path = '/dev/null', ends = '\\n', safe = 'v 0 0\\n'";
        std::filesystem::create_symlink("/dev/null", run.folder.path("dev/null"));
        expected = "/null: it is not a serial line: expected a device such as /dev/ttyACM0";
    }
    SECTION("two ways to cut messages") {
        device += ", cobs = true";
        expected = "ends, terminator, length and cobs: expected only one of them";
    }
    run.folder.write("behaviors/rover.lua",
                     "return robot_model { mass = 1, drive = { radius = 0.03, track = 0.1 }, "
                     "hardware = { script = 'rover_driver', devices = { line = serial { " +
                         device + " } } } }");
    run.folder.write("behaviors/rover_driver.lua",
                     "local line_out = output('line_out', 'TimedString')\nfunction on_execute() line_out:write '' end");
    run.start();
    CHECK(run.program->wait() == 2);
    INFO(run.program->error);
    CHECK(run.program->error.find(expected) != std::string::npos);
    CHECK(std::count(run.program->error.begin(), run.program->error.end(), '\n') == 1);
}

TEST_CASE("a plain file in place of a serial line has the last message", "[hw][wire][run]") {
    RoverRun run;
    run.rover.reset();
    run.folder.write("dev/ttyACM0", "");
    run.start({"--duration", "1"});
    CHECK(run.program->wait() == 0);
    INFO(run.program->error);
    std::ifstream file(run.node());
    std::string line;
    std::getline(file, line);
    CHECK(line == "v 0 0");
}

TEST_CASE("a plain file of the machine is never opened as a serial line", "[hw][wire][run]") {
    RoverRun run;
    const std::string file = run.folder.path("precious.txt").string();
    run.folder.write("precious.txt", "precious");
    run.copy("engine/robots/rover.lua", "behaviors/rover_base.lua");
    run.folder.write("behaviors/rover.lua",
                     "return robot_model { base = 'rover_base', hardware = { devices = { line = { "
                     "path = '" +
                         file + "' } } } }");
    run.start();
    CHECK(run.program->wait() == 2);
    CHECK(run.program->error.find("precious.txt: it is not a serial line") != std::string::npos);
    std::ifstream stream(file);
    std::string text;
    std::getline(stream, text);
    CHECK(text == "precious");
}

TEST_CASE("without --hw no device of a robot or a system is opened", "[hw][wire][run]") {
    RoverRun run;
    run.copy("engine/robots/rover.lua", "behaviors/rover_base.lua");
    run.folder.write("behaviors/rover.lua",
                     "return robot_model { base = 'rover_base', hardware = { devices = { line = { path = '" +
                         run.node() + "' } } } }");
    run.folder.write("system.lua", rover_system + "component 'lidar' { type = 'Serial', config = { path = '" +
                                       run.node() + "', measures_only = true } }\n");
    run.rover->say("e 1 2");
    const Outcome outcome = run_nezumi({"run", "system.lua", "--headless", "--speed", "max", "--duration", "1",
                                        "--record", "run.csv", "--ports", "lidar.out,rover.current_velocity_out"},
                                       run.folder.path("").string());
    INFO(outcome.error);
    CHECK(outcome.status == 0);
    CHECK(run.rover->lines().empty());
    std::ifstream file(run.folder.path("run.csv"));
    std::string columns;
    std::getline(file, columns);
    CHECK(columns.find("lidar.out") == std::string::npos);
}

TEST_CASE("a serial line has the speed that its robot gives, also one that has no name", "[hw][wire][run][wallclock]") {
    const std::string baud = GENERATE("230400", "250000");
    RoverRun run;
    run.copy("engine/robots/rover.lua", "behaviors/rover_base.lua");
    run.folder.write(
        "behaviors/rover.lua",
        "return robot_model { base = 'rover_base', hardware = { devices = { line = { baud = " + baud + " } } } }");
    run.get_going();
    const int line = open(run.node().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios2 settings{};
    CHECK(ioctl(line, TCGETS2, &settings) == 0);
    close(line);
    CHECK(settings.c_ospeed == static_cast<unsigned>(std::stoi(baud)));
}

TEST_CASE("a rover in the network gets its lines by UDP, and the safe bytes when the engine is killed",
          "[hw][wire][run][safety][wallclock]") {
    RoverRun run;
    run.rover.reset();
    const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    REQUIRE(bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0);
    REQUIRE(getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    run.folder.write("behaviors/rover.lua",
                     "return robot_model { mass = 1, drive = { radius = 0.03, track = 0.1 }, hardware = { script = "
                     "'rover_driver', devices = { line = udp { host = '127.0.0.1', port = " +
                         std::to_string(ntohs(address.sin_port)) + ", ends = '\\n', safe = 'v 0 0\\n' } } } }");
    run.folder.write("behaviors/rover_driver.lua", R"(
local target = input("target_velocity_in", "TimedVelocity2D")
local line_out = output("line_out", "TimedString")
local line_in = input("line_in", "TimedString", nil, { queue = 10 })
function on_execute()
  line_out:write(("v %.3f %.3f"):format(target:read().vx, target:read().va))
  if line_in.is_new then log.info("heard " .. line_in:read()) end
end
)");
    sockaddr_in heard_from{};
    const auto receive = [&](double seconds) {
        pollfd file{.fd = socket, .events = POLLIN, .revents = 0};
        char buffer[64];
        sockaddr_in from{};
        socklen_t length = sizeof from;
        if (poll(&file, 1, static_cast<int>(seconds * 1e3)) != 1) return std::string("nothing");
        const ssize_t got = recvfrom(socket, buffer, sizeof buffer, 0, reinterpret_cast<sockaddr*>(&from), &length);
        sendto(socket, "e 1 2\n", 6, 0, reinterpret_cast<sockaddr*>(&from), length);
        heard_from = from;
        return std::string(buffer, static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    };
    run.start();
    CHECK(holds_within(20, [&] { return receive(1) == "v 0.200 0.000\n"; }));
    CHECK(run.program->wait_for_error("heard e 1 2", 5));
    // What another sender says to the same port is not the device's.
    REQUIRE(heard_from.sin_port != 0);
    const int other = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    for (int i = 0; i < 3; ++i)
        sendto(other, "e 6 6\n", 6, 0, reinterpret_cast<sockaddr*>(&heard_from), sizeof heard_from);
    close(other);
    CHECK_FALSE(run.program->wait_for_error("heard e 6 6", 0.5));
    run.program->send(SIGKILL);
    std::string last;
    for (std::string next = receive(1); next != "nothing"; next = receive(0.3)) last = next;
    CHECK(last == "v 0 0\n");
    close(socket);
}

TEST_CASE("a USB device is found by its vendor's number and its serial number", "[hw][wire]") {
    Scratch folder;
    const auto plug = [&](const std::string& tty, const std::string& place, const std::string& vendor,
                          const std::string& serial) {
        const std::string device = "sys/devices/usb1/" + place;
        folder.write(device + "/idVendor", vendor + "\n");
        folder.write(device + "/serial", serial + "\n");
        std::filesystem::create_directories(folder.path(device + "/" + place + ":1.0"));
        std::filesystem::create_directories(folder.path("sys/class/tty/" + tty));
        std::filesystem::create_directory_symlink(folder.path(device + "/" + place + ":1.0"),
                                                  folder.path("sys/class/tty/" + tty + "/device"));
    };
    plug("ttyACM0", "1-1", "2341", "A1");
    plug("ttyUSB3", "1-2", "10c4", "0001");
    const DeviceRoots roots{.dev = "/dev", .sys = folder.path("sys").string()};
    CHECK(find_usb_serial(roots, "10c4", "") == "/dev/ttyUSB3");
    CHECK(find_usb_serial(roots, "2341", "A1") == "/dev/ttyACM0");
    CHECK(find_usb_serial(roots, "2341", "B2").error() ==
          "no serial line has USB vendor 2341 and serial number B2: there are 10c4 0001, 2341 A1");
    plug("ttyACM1", "1-3", "2341", "B2");
    CHECK(find_usb_serial(roots, "2341", "").error() ==
          "2 serial lines have USB vendor 2341: give serial_number as well (ttyACM0, ttyACM1)");
}
