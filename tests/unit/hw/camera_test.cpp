// The camera's driver with OpenCV's capture on a fake Video4Linux node.
#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "engine/devices/camera.hpp"
#include "engine/world/chessboard.hpp"
#include "hw/camera/video_camera.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/command_output.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// A Camera component with its driver, at 100 ticks per second in real time.
struct DrivenCamera {
    explicit DrivenCamera(const DeviceRoots& roots, const ParameterValues& config = {})
        : system({.rate = 100, .real_time = true}, [this](const LogLine& line) { log.push_back(line.text); }) {
        ComponentEntry entry;
        entry.name = "eye";
        auto made = device_drivers(roots).at("Camera").begin()->second(entry, system);
        REQUIRE(made);
        camera = made->get();
        REQUIRE(camera->parameters().set_all(small));
        REQUIRE(camera->parameters().set_all(config));
        REQUIRE(system.add(std::move(*made)));
        REQUIRE(camera->activate(system.now()));
    }
    bool run(double seconds, const std::function<bool()>& until = nullptr) { return run_paced(system, seconds, until); }
    template <class T = CameraImage>
    const OutPort<T>& port(const char* name) const {
        return static_cast<const OutPort<T>&>(*std::as_const(*camera).find_out_port(name));
    }
    const OutPort<CameraImage>& out() const { return port("out"); }
    bool sees(double within = 8) {
        const auto before = out().count();
        return run(within, [&] { return out().count() > before; });
    }
    bool is_back_again() {
        return run(1, [&] { return times_said("camera: back again") == 1; });
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

    // Fast to paint.
    static inline const ParameterValues small{{"width", std::int64_t{320}}, {"height", std::int64_t{240}}};

    std::vector<std::string> log;
    System system;
    Component* camera = nullptr;
};

// Mean of the three colours around the middle.
std::array<int, 3> middle(const CameraImage& image) {
    const std::size_t at = 3 * (static_cast<std::size_t>(image.height / 2) * image.width + image.width / 2);
    return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

}  // namespace

TEST_CASE("a real camera's pictures carry the time at which each was taken", "[hw][camera][fakes][wallclock]") {
    FakeMouse fake;
    DrivenCamera driven(fake.roots());
    INFO(driven.all_log());
    REQUIRE(driven.sees());
    std::vector<double> stamps;
    double oldest = 0;
    REQUIRE(driven.run(10, [&] {
        const double tm = driven.out().tm();
        if (stamps.empty() || tm != stamps.back()) {
            stamps.push_back(tm);
            oldest = std::max(oldest, driven.system.now().seconds - tm);
            CHECK(tm <= driven.system.now().seconds);
        }
        return stamps.size() > 15;
    }));
    CHECK(driven.out().read().width == 320);
    CHECK(driven.out().read().height == 240);
    CHECK(driven.out().read().format == "rgb8");
    CHECK(driven.out().read().pixels.size() == 320 * 240 * 3);
    CHECK(oldest < 0.3);
    // The intervals of pictures are at least the camera's, independent of ticks, except for two or three when a fake
    // camera on a busy machine catches up.
    int nearer = 0;
    for (std::size_t i = 1; i < stamps.size(); ++i) nearer += stamps[i] - stamps[i - 1] < 0.02 ? 1 : 0;
    CHECK(nearer <= 3);
    CHECK(driven.port<CameraIntrinsics>("intrinsics").tm() == driven.out().tm());
    CHECK(driven.port<CameraIntrinsics>("intrinsics").read() == pinhole(320, 240, 1.0472));
    CHECK(driven.all_log() == "");
}

TEST_CASE("a real camera's pictures are red, green and blue, or grey on request", "[hw][camera][fakes][wallclock]") {
    FakeMouse fake({"0.3"});  // a wall of #8a8f98
    {
        DrivenCamera driven(fake.roots());
        REQUIRE(driven.sees());
        const auto [red, green, blue] = middle(driven.out().read());
        CHECK(blue > red + 3);
        CHECK(green < blue);
        CHECK(green > red);
    }
    DrivenCamera driven(fake.roots(), {{"format", std::string("gray8")}});
    REQUIRE(driven.sees());
    CHECK(driven.out().read().bpp == 8);
    CHECK(driven.out().read().pixels.size() == 320 * 240);
}

TEST_CASE("a camera that is faster than requested gives the requested number of pictures",
          "[hw][camera][fakes][wallclock]") {
    FakeMouse fake;
    DrivenCamera driven(fake.roots(), {{"frame_rate", 10.0}});  // of 30, 15 and 5 Hz it chooses 15 or 5
    REQUIRE(driven.sees());
    const double since = driven.out().tm();
    const auto before = driven.out().count();
    driven.run(3);
    const double rate = static_cast<double>(driven.out().count() - before) / (driven.out().tm() - since);
    CHECK(rate < 11);
}

TEST_CASE("an unplugged camera is silent, reported once, and used again when it is back",
          "[hw][camera][fakes][threads][wallclock]") {
    FakeMouse fake;
    DrivenCamera driven(fake.roots());
    REQUIRE(driven.sees());
    CHECK(fake.say("unplug video0").empty());
    REQUIRE(driven.run(5, [&] { return !driven.log.empty(); }));
    const auto count = driven.out().count();
    driven.run(2.5);
    CHECK(driven.out().count() == count);
    CHECK(driven.all_log() ==
          "camera: " + fake.mount() + "/video0: no such file or directory: it is unplugged: plug it in again\n");
    CHECK(fake.say("plug video0").empty());
    CHECK(driven.sees(VideoCamera::search_period + 5));
    CHECK(driven.is_back_again());
}

TEST_CASE("without a camera the run continues and reports what is missing", "[hw][camera][fakes][wallclock]") {
    FakeMouse fake;
    CHECK(fake.say("unplug video0").empty());
    DrivenCamera driven(fake.roots());
    driven.run(2.2);
    CHECK(driven.out().count() == 0);
    CHECK(driven.all_log() == "camera: none is connected: there is none in " + fake.mount() + "\n");
    CHECK(fake.say("plug video0").empty());
    CHECK(driven.sees(VideoCamera::search_period + 5));
}

TEST_CASE("a camera's fault is reported once with what to do, and pictures come when it is over",
          "[hw][camera][fakes][wallclock]") {
    struct Fault {
        std::string name, said;
    };
    const auto fault = GENERATE(values<Fault>({
        {"denied",
         "permission denied: this user has no permission to use it. Try: sudo adduser $USER video, and log in again"},
        {"busy", "device or resource busy: another program uses it: fuser -v DEV/video0 says which"},
        {"enodev", "no such device: it is unplugged: plug it in again"},
        {"small",
         "it gives 160 x 120 pixels, not 320 x 240: set width = 160 and height = 120, or another size that it has: "
         "v4l2-ctl --list-formats-ext"},
    }));
    INFO(fault.name);
    FakeMouse fake;
    fake.fault("video0", fault.name);
    DrivenCamera driven(fake.roots());
    driven.run(2.5);
    CHECK(driven.out().count() == 0);
    std::string said = driven.all_log();
    for (std::size_t at = said.find(fake.mount()); at != said.npos; at = said.find(fake.mount()))
        said.replace(at, fake.mount().size(), "DEV");
    CHECK(said == "camera: DEV/video0: " + fault.said + "\n");
    fake.fault("video0", "none");
    CHECK(driven.sees());
    CHECK(driven.is_back_again());
}

TEST_CASE("a camera that fails, stops or hangs does not delay a tick, and is used again",
          "[hw][camera][fakes][threads][wallclock]") {
    const std::string fault = GENERATE("eio", "enodev", "silent", "hang");
    INFO(fault);
    FakeMouse fake;
    DrivenCamera driven(fake.roots());
    REQUIRE(driven.sees());
    fake.fault("video0", fault);
    double longest = 0, before = clock_seconds();
    CHECK(driven.run(VideoCamera::slowest_opening + 3, [&] {
        const double now = clock_seconds();
        longest = std::max(longest, now - std::exchange(before, now));
        return driven.times_said("camera: ") == 1;
    }));
    CHECK(longest < 0.2);
    driven.run(1.5);
    const auto count = driven.out().count();
    driven.run(1);
    CHECK(driven.out().count() == count);
    INFO(driven.all_log());
    CHECK(driven.times_said("camera: ") == 1);
    fake.fault("video0", "none");
    CHECK(driven.sees());
    CHECK(driven.is_back_again());
}

TEST_CASE("the requested camera is used, and a device that is not a camera is refused",
          "[hw][camera][fakes][wallclock]") {
    FakeMouse fake;
    const auto told = [&](const std::string& device) {
        DrivenCamera driven(fake.roots(), {{"device", device}});
        driven.run(8, [&] { return !driven.log.empty() || driven.out().count() > 0; });
        return driven.all_log();
    };
    CHECK(told("/dev/video0") == "");
    CHECK(told("/dev/rtled0") == "camera: " + fake.mount() + "/rtled0 is not a camera: it can't take pictures\n");
    CHECK(told("/dev/video7") ==
          "camera: " + fake.mount() + "/video7: no such file or directory: it is unplugged: plug it in again\n");
}

TEST_CASE("a real camera's pictures are undistorted on request", "[hw][camera][fakes][wallclock]") {
    FakeMouse fake({"0.9"});
    CHECK(fake.say("lens 1.2 -0.4 0.1 0 0 0").empty());
    const ParameterValues lens{{"field_of_view", 1.2}, {"k1", -0.4}, {"k2", 0.1}};
    // The wall's upper edge in a column; the camera is 6 cm high, the wall 30 cm high and 80 cm away.
    const auto edge = [](const CameraImage& image, int column) {
        for (int row = 0; row < image.height; ++row) {
            const std::uint8_t* pixel = &image.pixels[3 * (static_cast<std::size_t>(row) * image.width + column)];
            if (pixel[0] < 160) return row;
        }
        return -1;
    };
    const auto bend = [&](ParameterValues config) {
        config.insert(lens.begin(), lens.end());
        DrivenCamera driven(fake.roots(), config);
        REQUIRE(driven.sees());
        driven.run(0.3);
        CHECK(driven.port<CameraIntrinsics>("intrinsics").read().k1 == (config.contains("undistort") ? 0 : -0.4));
        return edge(driven.out().read(), 20) - edge(driven.out().read(), 160);
    };
    CHECK(bend({}) > 3);
    CHECK(std::abs(bend({{"undistort", true}})) <= 1);
}

TEST_CASE("the module for cameras is loaded only when a camera is opened", "[hw][camera]") {
    const auto libraries = [](const std::string& program) { return output_of("ldd " + program + " 2>&1"); };
    const std::string all = libraries(nezumi_program());
    CHECK(all.find("libstdc++") != all.npos);
    CHECK(all.find("opencv_core") != all.npos);
    CHECK(all.find("videoio") == all.npos);
    CHECK(all.find("imgcodecs") == all.npos);
}

TEST_CASE("a foreign program can use the fake camera", "[hw][camera][fakes][wallclock]") {
    if (std::system("command -v v4l2-ctl > /dev/null") != 0)
        throw std::runtime_error("SKIPPED: v4l2-ctl is not installed: sudo apt install v4l-utils");
    if (geteuid() != 0)
        throw std::runtime_error("SKIPPED: v4l2-ctl wants a device with a number, which root can give it");
    FakeMouse fake;
    // OpenCV asks sysfs for a device with this number; a regular file has 0:0.
    const std::string as_device =
        "unshare -m sh -c 'mount -t tmpfs none /sys/dev/char && mkdir /sys/dev/char/0:0 && "
        "echo DEVNAME=video0 > /sys/dev/char/0:0/uevent && exec timeout 20 v4l2-ctl -d " +
        fake.mount() + "/video0 ";
    if (output_of("unshare -m true 2>&1") != "")
        throw std::runtime_error("SKIPPED: there are no mount namespaces here for v4l2-ctl");
    const std::string about = output_of(as_device + "--info --list-formats-ext' 2>&1");
    INFO(about);
    CHECK(about.find("Card type        : Plain Camera") != about.npos);
    CHECK(about.find("'YUYV' (YUYV 4:2:2)") != about.npos);
    CHECK(about.find("Size: Discrete 640x480") != about.npos);
    CHECK(about.find("(30.000 fps)") != about.npos);
    const std::string frames = fake.folder.path("frames.yuv").string();
    const std::string streamed = output_of(as_device +
                                           "--set-fmt-video width=320,height=240 --stream-mmap=3 "
                                           "--stream-poll --stream-count=5 --stream-to=" +
                                           frames + "' 2>&1");
    INFO(streamed);
    struct stat status {};
    REQUIRE(stat(frames.c_str(), &status) == 0);
    CHECK(status.st_size == 5 * 320 * 240 * 2);
}

TEST_CASE("the mouse follows a marker that its real camera sees", "[hw][camera][run][fakes][wallclock]") {
    FakeMouse fake;
    fake.folder.write("system.lua",
                      "robot 'mouse' { model = 'raspimouse' }\n"
                      "component 'eye' { type = 'Camera', on = 'mouse', at = { 0.05, 0, 0.06 } }\n"
                      "component 'detector' { type = 'MarkerDetector', config = { tag_size = 0.1 } }\n"
                      "behavior 'follower' { script = 'marker_follower' }\n"
                      "connect('eye.out', 'detector.image')\nconnect('detector.pos', 'follower.marker_pos')\n"
                      "connect('follower.target_vel', 'mouse.target_velocity_in')\n");
    CHECK(fake.say("marker 1 0 0.06 3.14159265").empty());
    Program program({"run", "system.lua", "--hw", "--headless", "--dev-root", fake.dev(), "--sys-root",
                     fake.folder.path("sys").string(), "--duration", "15"},
                    fake.folder.path("").string());
    // It starts 0.95 m from the marker and stops at 0.5 m, within 0.05 m.
    CHECK(FakeRobot::wait_until([&] { return fake.truth().position.x > 0.38; }, 14));
    sleep_for(1);
    CHECK(fake.truth().position.x < 0.52);
    CHECK(std::abs(fake.truth().position.y) < 0.05);
}

TEST_CASE("a camera without pictures is reported, and its first picture is used", "[hw][camera][fakes][wallclock]") {
    FakeMouse fake;
    fake.fault("video0", "silent");
    DrivenCamera driven(fake.roots());
    CHECK(driven.run(VideoCamera::slowest_opening + 2, [&] { return driven.times_said("camera: ") == 1; }));
    CHECK(driven.all_log() == "camera: no answer for 3 s: unplug it and plug it in again\n");
    fake.fault("video0", "none");
    CHECK(driven.sees(12));
    CHECK(driven.is_back_again());
}

TEST_CASE("nezumi calibrate camera measures a real camera with a chessboard and keeps earlier measurements",
          "[hw][camera][calibration][fakes][wallclock]") {
    FakeMouse fake({"board"});
    CHECK(fake.say("lens 1.15 -0.22 0.06 0 0 0").empty());
    fake.folder.write("system.lua",
                      "robot 'mouse' { model = 'raspimouse' }\ncomponent 'eye' { type = 'Camera', on = 'mouse', "
                      "config = { width = 320, height = 240 } }\n");
    fake.folder.write("mouse.calibration.lua",
                      "calibration { robot = 'mouse', model = 'raspimouse',\n"
                      "  odometry = { track = 0.095, left_radius = 0.024, right_radius = 0.024 } }\n");
    Program program({"calibrate", "camera", "system.lua", "--yes", "--dev-root", fake.dev()},
                    fake.folder.path("").string());
    for (int i = 0, views = 0; i < 200 && views < 20; ++i) {
        const CameraMount held = view_of_chessboard({}, i);
        CHECK(fake.say(fmt::format("look {} {} {} {} {}", held.at.x, held.at.y, held.at.z, held.yaw, held.pitch))
                  .empty());
        // Independent of the machine's speed: moving on before a view was taken would give too few different views.
        if (program.wait_for_error(fmt::format("view {} of 20", views + 1), 2)) ++views;
    }
    const int status = program.wait();
    INFO(program.error);
    REQUIRE(status == 0);
    std::ifstream file(fake.folder.path("mouse.calibration.lua"));
    std::stringstream text;
    text << file.rdbuf();
    INFO(text.str());
    const auto number = [&](const std::string& name) {
        const std::size_t at = text.str().find(" " + name + " = ");
        REQUIRE(at != std::string::npos);
        return std::stod(text.str().substr(at + name.size() + 4));
    };
    CHECK(number("track") == 0.095);
    const double truth = 160 / std::tan(1.15 / 2);
    CHECK(number("width") == 320);
    // A busy machine gets fewer and other views; another test checks the accuracy.
    CHECK(number("fx") == Approx(truth).epsilon(0.03));
    CHECK(number("fy") == Approx(truth).epsilon(0.03));
    CHECK(number("cx") == Approx(159.5).margin(3));
    CHECK(number("k1") == Approx(-0.22).margin(0.05));
}
