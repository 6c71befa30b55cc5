// The gamepad's driver on event devices that behave like Linux.
#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>

#include "engine/devices/joystick.hpp"
#include "hw/gamepad/evdev_gamepad.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/command_output.hpp"
#include "tests/unit/hw/fake_robot_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

using Floats = std::vector<float>;

struct FakeGamepad : FakeRobot {
    FakeGamepad() : FakeRobot("fake_gamepad", "") {}
    void set(const std::string& name, int value) { REQUIRE(say("set " + name + " " + std::to_string(value)).empty()); }
    DeviceRoots roots() const { return {.dev = mount(), .sys = ""}; }
};

// A joystick with the driver behind it, at 100 ticks per second of real time.
struct DrivenStick {
    explicit DrivenStick(const DeviceRoots& roots, const ParameterValues& config = {})
        : system({.rate = 100, .real_time = true}, [this](const LogLine& line) { log.push_back(line.text); }) {
        ComponentEntry entry;
        entry.name = "stick";
        auto made = device_drivers(roots).at("Joystick").at("gamepad")(entry, system);
        REQUIRE(made);
        stick = dynamic_cast<Joystick*>(made->get());
        REQUIRE(stick->parameters().set_all(config));
        REQUIRE(system.add(std::move(*made)));
        REQUIRE(stick->activate(system.now()));
    }
    bool run(double seconds, const std::function<bool()>& until = nullptr) { return run_paced(system, seconds, until); }
    template <class T = Floats>
    const OutPort<T>& port(const char* name) const {
        return static_cast<const OutPort<T>&>(*stick->find_out_port(name));
    }
    const Floats& pos() const { return port("pos").read(); }
    bool points_to(const Floats& place, double within = 3) {
        return run(within, [&] { return pos() == place; });
    }
    int times_said(const std::string& part) const {
        return static_cast<int>(
            std::count_if(log.begin(), log.end(), [&](const auto& line) { return line.find(part) != line.npos; }));
    }
    std::string all_log() const {
        std::string all;
        for (const auto& line : log) all += line + "\n";
        return all;
    }

    std::vector<std::string> log;
    System system;
    Joystick* stick = nullptr;
};

}  // namespace

TEST_CASE("a gamepad's stick, axes and buttons arrive on the ports", "[hw][gamepad][fakes][threads][wallclock]") {
    FakeGamepad fake;
    DrivenStick driven(fake.roots());
    REQUIRE(driven.points_to({0, 0}));
    fake.set("ABS_X", 32767);
    CHECK(driven.points_to({150, 0}));
    fake.set("ABS_X", 128);  // a released stick is slightly beside its middle
    fake.set("ABS_Y", -32768);
    CHECK(driven.points_to({0, 150}));
    CHECK(driven.port("vel").read()[0] == Approx(150 * std::sqrt(0.5F)));
    fake.set("ABS_X", -16448);
    CHECK(driven.run(3, [&] { return std::abs(driven.pos()[0] + 75) < 0.1F; }));
    fake.set("ABS_RZ", 255);
    fake.set("ABS_HAT0X", 1);
    CHECK(driven.run(3, [&] { return driven.port("axes").read().at(6) == 1; }));
    CHECK(driven.port("axes").read().size() == 8);
    CHECK(driven.port("axes").read()[1] == -1);  // on Linux, down is positive
    CHECK(driven.port("axes").read()[2] == -1);  // ABS_Z, a released trigger
    CHECK(driven.port("axes").read()[5] == 1);
    fake.set("BTN_WEST", 1);
    CHECK(driven.run(3, [&] { return driven.port<std::vector<bool>>("buttons").read().at(3); }));
    CHECK(driven.port<std::vector<bool>>("buttons").read().size() == 11);
    INFO(driven.all_log());
    CHECK(driven.log.empty());
}

TEST_CASE("changes of a gamepad are seen even if its events were lost", "[hw][gamepad][fakes][wallclock]") {
    FakeGamepad fake;
    DrivenStick driven(fake.roots());
    fake.set("ABS_Y", -32768);
    REQUIRE(driven.points_to({0, 150}));
    CHECK(fake.say("unseen ABS_Y 0").empty());
    CHECK(driven.points_to({0, 0}));
}

TEST_CASE("an unplugged gamepad sends its middle position once, is silent, and is used again",
          "[hw][gamepad][fakes][safety][threads][wallclock]") {
    FakeGamepad fake;
    DrivenStick driven(fake.roots());
    fake.set("ABS_Y", -32768);
    REQUIRE(driven.points_to({0, 150}));
    fake.say("unplug");
    REQUIRE(driven.points_to({0, 0}, 0.5));
    const auto count = driven.port("pos").count(), axes = driven.port("axes").count();
    driven.run(1.5);
    CHECK(driven.port("pos").count() == count);
    CHECK(driven.port("axes").count() == axes);
    INFO(driven.all_log());
    CHECK(driven.times_said("gamepad: ") == 1);
    CHECK(driven.times_said("input/event3: no such device: it is unplugged: plug it in again") == 1);
    // The stick on the screen can be used without the dead-man button.
    driven.stick->find_in_port("stick")->inject(Floats{0, 50});
    CHECK(driven.points_to({0, 50}, 0.1));
    CHECK(driven.points_to({0, 0}, 0.1));

    fake.say("plug");
    CHECK(driven.run(EvdevGamepad::search_period + Health::proven_after + 1,
                     [&] { return driven.times_said("gamepad: back again") == 1; }));
    fake.set("ABS_X", 32767);
    CHECK(driven.points_to({150, 0}));
}

TEST_CASE("without a gamepad the run continues and reports what is missing", "[hw][gamepad][fakes][wallclock]") {
    FakeGamepad fake;
    fake.say("unplug");
    DrivenStick driven(fake.roots());
    driven.run(1.5);
    CHECK(driven.port("pos").count() == 0);
    CHECK(driven.all_log() == "gamepad: none is connected: there is none in " + fake.mount() + "/input\n");
    fake.say("plug");
    CHECK(driven.points_to({0, 0}));
}

TEST_CASE("a stick with a dead-man button works only while the button is held",
          "[hw][gamepad][fakes][safety][wallclock]") {
    FakeGamepad fake;
    DrivenStick driven(fake.roots(), {{"dead_man_button", std::string("BTN_TL")}});
    fake.set("ABS_Y", -32768);
    REQUIRE(driven.run(3, [&] { return driven.port("axes").count() > 0 && driven.port("axes").read()[1] == -1; }));
    CHECK(driven.pos() == Floats{0, 0});
    fake.set("BTN_TL", 1);
    CHECK(driven.points_to({0, 150}));
    fake.set("BTN_TL", 0);
    CHECK(driven.points_to({0, 0}));
    CHECK(driven.port("axes").read()[1] == -1);
}

TEST_CASE("the emergency stop works each time it is pressed, and the stick then has no effect",
          "[hw][gamepad][fakes][safety][wallclock]") {
    FakeGamepad fake;
    DrivenStick driven(fake.roots(), {{"stop_button", std::string("BTN_SELECT")}});
    fake.set("ABS_Y", -32768);
    REQUIRE(driven.points_to({0, 150}));
    fake.set("BTN_SELECT", 1);
    CHECK(driven.run(3, [&] { return driven.stick->stops() == 1; }));
    CHECK(driven.points_to({0, 0}));
    fake.set("BTN_SELECT", 0);
    CHECK(driven.points_to({0, 150}));
    CHECK(fake.say("unseen BTN_SELECT 1").empty());  // its event was lost
    CHECK(driven.run(3, [&] { return driven.stick->stops() == 2; }));
}

TEST_CASE("a gamepad without its safety button is not used, and the button is named",
          "[hw][gamepad][fakes][safety][wallclock]") {
    FakeGamepad fake;
    DrivenStick driven(fake.roots(), {{"dead_man_button", std::string("BTN_TL2")}});
    REQUIRE(driven.run(3, [&] { return !driven.log.empty(); }));
    CHECK(driven.log[0] ==
          "gamepad: " + fake.mount() +
              "/input/event3 (Microsoft X-Box 360 pad) is not used: it has no button 'BTN_TL2'; it has "
              "BTN_SOUTH, BTN_EAST, BTN_NORTH, BTN_WEST, BTN_TL, BTN_TR, BTN_SELECT, BTN_START, "
              "BTN_MODE, BTN_THUMBL, BTN_THUMBR");
    CHECK(driven.port("pos").count() == 0);
}

TEST_CASE("the requested gamepad is used, and the reason is reported if this is impossible",
          "[hw][gamepad][fakes][wallclock]") {
    FakeGamepad fake;
    const auto told = [&](const std::string& device) {
        DrivenStick driven(fake.roots(), {{"device", device}});
        driven.run(3, [&] { return !driven.log.empty() || driven.port("pos").count() > 0; });
        return driven.all_log();
    };
    CHECK(told("/dev/input/event3").empty());
    CHECK(told("/dev/input/event0") ==
          "gamepad: " + fake.mount() +
              "/input/event0 (Plain Keyboard) is not a gamepad: it has no stick or no buttons\n");
    CHECK(told("/dev/input/event9") == "gamepad: " + fake.mount() +
                                           "/input/event9: no such file or directory: it is unplugged: plug it in "
                                           "again\n");
    fake.say("fault denied");
    CHECK(told("") ==
          "gamepad: " + fake.mount() +
              "/input/event3: permission denied: this user has no permission to use it. Try: sudo adduser $USER input, "
              "and log in again\n");
}

TEST_CASE("a gamepad that fails or hangs releases its stick and is used again",
          "[hw][gamepad][fakes][safety][threads][wallclock]") {
    const std::string fault = GENERATE("eio", "hang");
    FakeGamepad fake;
    DrivenStick driven(fake.roots());
    fake.set("ABS_Y", -32768);
    REQUIRE(driven.points_to({0, 150}));
    CHECK(fake.say("fault " + fault).empty());
    INFO(fault);
    CHECK(driven.points_to({0, 0}, 2));
    const auto count = driven.port("pos").count();
    driven.run(0.3);
    CHECK(driven.port("pos").count() == count);
    CHECK(driven.times_said("gamepad: ") == 1);
    fake.say("heal");
    CHECK(driven.points_to({0, 150}));
}

TEST_CASE("a foreign program can use the fake gamepad", "[hw][gamepad][fakes][wallclock]") {
    if (std::system("command -v evtest > /dev/null") != 0)
        throw std::runtime_error("SKIPPED: evtest is not installed: sudo apt install evtest");
    FakeGamepad fake;
    const std::string device = fake.mount() + "/input/event3";
    std::thread mover([&] {
        for (int i = 1; i <= 8; ++i) {
            sleep_for(0.1);
            fake.set("ABS_Y", 1000 * i);
        }
    });
    const std::string text = output_of("timeout -s INT 1 evtest " + device + " 2>&1");
    mover.join();
    INFO(text);
    CHECK(text.find("Input device name: \"Microsoft X-Box 360 pad\"") != text.npos);
    CHECK(text.find("Event code 0 (ABS_X)") != text.npos);
    CHECK(text.find("Min   -32768") != text.npos);
    CHECK(text.find("type 3 (EV_ABS), code 1 (ABS_Y), value ") != text.npos);
}

namespace {

// Runs a Python program on the fake gamepad while its stick moves; skipped if a needed module is missing.
std::string output_of_python(const std::string& needs, const std::string& package, const std::string& program) {
    if (std::system(("/usr/bin/python3 -c '" + needs + "' 2> /dev/null").c_str()) != 0)
        throw std::runtime_error("SKIPPED: " + package + " is not installed: sudo apt install " + package);
    FakeGamepad fake;
    const std::string file = fake.folder.write("reader.py", program).string();
    std::thread mover([&] {
        for (int i = 1; i <= 20; ++i) {
            sleep_for(0.1);
            fake.set("ABS_Y", 1000 * i);
        }
    });
    std::string text = output_of("timeout 10 /usr/bin/python3 -B " + file + " " + fake.mount() + "/input/event3 2>&1");
    mover.join();
    return text;
}

}  // namespace

TEST_CASE("libevdev's binding to Python reads the fake gamepad as a gamepad", "[hw][gamepad][fakes][wallclock]") {
    const std::string text = output_of_python("import libevdev", "python3-libevdev", R"(
import libevdev, os, sys, time
file = open(sys.argv[1], "rb")
os.set_blocking(file.fileno(), False)
device = libevdev.Device(file)
print(device.name)
stick = device.absinfo[libevdev.EV_ABS.ABS_X]
print("from", stick.minimum, "to", stick.maximum)
print("button", device.has(libevdev.EV_KEY.BTN_SOUTH), "key", device.has(libevdev.EV_KEY.KEY_A))
end, values = time.monotonic() + 5, []
while not values and time.monotonic() < end:
    time.sleep(0.01)
    values += [event.value for event in device.events() if event.matches(libevdev.EV_ABS.ABS_Y)]
print("moved", 0 < values[0] <= 20000)
)");
    CHECK(text == "Microsoft X-Box 360 pad\nfrom -32768 to 32767\nbutton True key False\nmoved True\n");
}

TEST_CASE("SDL2 reads the fake gamepad as a gamepad", "[hw][gamepad][fakes][wallclock]") {
    const std::string text = output_of_python(R"(import ctypes; ctypes.CDLL("libSDL2-2.0.so.0"))", "libsdl2-2.0-0", R"(
import ctypes, os, sys, time
os.environ.update(SDL_JOYSTICK_DEVICE=sys.argv[1], SDL_JOYSTICK_HIDAPI="0", SDL_VIDEODRIVER="dummy")
sdl = ctypes.CDLL("libSDL2-2.0.so.0")
sdl.SDL_JoystickNameForIndex.restype = ctypes.c_char_p
sdl.SDL_JoystickOpen.restype = ctypes.c_void_p
sdl.SDL_JoystickGetAxis.restype = ctypes.c_short
for ask in (sdl.SDL_JoystickNumAxes, sdl.SDL_JoystickNumHats, sdl.SDL_JoystickNumButtons):
    ask.argtypes = [ctypes.c_void_p]
sdl.SDL_JoystickGetAxis.argtypes = [ctypes.c_void_p, ctypes.c_int]
if sdl.SDL_Init(0x200) != 0:
    sys.exit("SDL_Init failed")
names = [sdl.SDL_JoystickNameForIndex(i).decode() for i in range(sdl.SDL_NumJoysticks())]
print(names)
stick = sdl.SDL_JoystickOpen(0)
print(sdl.SDL_JoystickNumAxes(stick), "axes", sdl.SDL_JoystickNumHats(stick), "hat",
      sdl.SDL_JoystickNumButtons(stick), "buttons")
end = time.monotonic() + 5
while sdl.SDL_JoystickGetAxis(stick, 1) < 5000 and time.monotonic() < end:
    sdl.SDL_JoystickUpdate()
    time.sleep(0.01)
print("moved", sdl.SDL_JoystickGetAxis(stick, 1) >= 5000)
)");
    INFO(text);
    CHECK(text.find("360") != text.npos);
    CHECK(text.find("6 axes 1 hat 11 buttons\nmoved True\n") != text.npos);
}

TEST_CASE("a real gamepad drives a simulated mouse by --hw, and its button stops all robots",
          "[hw][gamepad][run][fakes][safety][wallclock]") {
    FakeGamepad fake;
    fake.folder.write("system.lua",
                      "robot 'mouse' { model = 'raspimouse' }\n"
                      "component 'stick' { type = 'Joystick', config = { stop_button = 'BTN_SELECT' } }\n"
                      "behavior 'converter' { script = 'float_seq_to_velocity' }\n"
                      "connect('stick.pos', 'converter.in')\nconnect('converter.out', 'mouse.target_velocity_in')\n");
    fake.set("ABS_Y", -32768);
    Program program({"run", "system.lua", "--hw=stick", "--headless", "--dev-root", fake.mount(), "--duration", "4",
                     "--record", "x.csv", "--ports", "mouse.truth.pose.position.x,mouse.truth.velocity.vx"},
                    fake.folder.path("").string());
    sleep_for(2.5);
    fake.set("BTN_SELECT", 1);
    CHECK(program.wait_for_error("emergency stop by joystick stick: rearm() lets the robots drive again", 10));
    REQUIRE(program.wait() == 0);
    std::ifstream file(fake.folder.path("x.csv"));
    std::string row;
    for (std::string line; std::getline(file, line);) row = line;
    INFO(row);
    const auto comma = row.rfind(','), before = row.rfind(',', comma - 1);
    CHECK(std::stod(row.substr(before + 1)) > 0.2);
    CHECK(std::abs(std::stod(row.substr(comma + 1))) < 0.001);
}
