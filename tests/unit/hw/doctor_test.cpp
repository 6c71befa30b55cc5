// The findings of `nezumi doctor` on machines made of folders.
#include "hw/doctor/doctor.hpp"

#include <grp.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <string>
#include <utility>

#include "hw/doctor/machine_queries.hpp"
#include "hw/guard/lease.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// A Raspberry Pi 4 as a complete mouse.
struct MouseMachine {
    MouseMachine() {
        for (const char* node :
             {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0", "rtled0", "rtled1", "rtled2", "rtled3", "rtbuzzer0"})
            folder.write(std::string("dev/") + node, "0\n");
        for (const char* node : {"rtswitch0", "rtswitch1", "rtswitch2"})
            folder.write(std::string("dev/") + node, "1\n");
        folder.write("dev/rtlightsensor0", "12 0 -3 14\n");
        folder.write("dev/rtcounter_l0", "700\n");
        folder.write("dev/rtcounter_r0", "65000\n");
        folder.write("sys/module/rtmouse/version", "3.3.2\n");
        folder.write("sys/firmware/devicetree/base/model", std::string_view("Raspberry Pi 4 Model B Rev 1.4\0", 31));
        folder.write("sys/bus/i2c/devices/i2c-1/name", "bcm2835\n");
        folder.write("proc/sys/kernel/osrelease", "6.1.21-v7+\n");
        folder.write("proc/cpuinfo", "model name : ARMv7 Processor rev 3 (v7l)\n");
        folder.write("udev/rules.d/60-nezumi.rules", "KERNEL==\"rtmotor*\", MODE=\"0660\"\n");
    }
    Examination examine() const {
        MachineRoots roots;
        roots.devices = {.dev = folder.path("dev").string(), .sys = folder.path("sys").string()};
        roots.proc = folder.path("proc").string();
        roots.udev = {folder.path("udev").string()};
        roots.rules = "/usr/share/nezumi/60-nezumi.rules";
        if (!cameras.empty()) roots.load_cameras = [this] { return tl::unexpected(cameras); };
        return hw::examine(roots);
    }
    void remove(const std::string& name) const { std::filesystem::remove_all(folder.path(name)); }

    Scratch folder;
    std::string cameras;  // why nezumi can't use them
};

// The findings that are not good, one line each: "wrong driver: rtmouse is not loaded -> sudo modprobe rtmouse".
std::string not_well(const Examination& examination) {
    std::string text;
    for (const Finding& finding : examination.findings) {
        if (finding.state != Finding::State::wrong) continue;
        text += finding.check + ": " + finding.found + " -> " + finding.advice + "\n";
    }
    return text;
}

std::string found(const Examination& examination, const std::string& check) {
    for (const Finding& finding : examination.findings) {
        if (finding.check == check) return finding.found;
    }
    return "not looked at";
}

}  // namespace

TEST_CASE("for a complete mouse nothing is wrong, and its parts are listed", "[hw][doctor]") {
    const MouseMachine machine;
    const Examination all = machine.examine();
    CHECK(all.driver == "raspimouse");
    CHECK(not_well(all).empty());
    CHECK(found(all, "board") == "Raspberry Pi 4 Model B Rev 1.4");
    CHECK(found(all, "driver") == "rtmouse 3.3.2");
    CHECK(found(all, "nodes") == "all 14 can be used");
    CHECK(found(all, "light sensors") == "12 0 -3 14");
    CHECK(found(all, "wheel counters") == "700 left, 65000 right");
    CHECK(found(all, "udev rules") == machine.folder.path("udev/rules.d/60-nezumi.rules").string());
    CHECK(found(all, "camera") == "not found");
}

TEST_CASE("the examination of a mouse writes nothing", "[hw][doctor][safety]") {
    const MouseMachine machine;
    const auto before = std::filesystem::last_write_time(machine.folder.path("dev/rtmotoren0"));
    static_cast<void>(machine.examine());
    CHECK(std::filesystem::last_write_time(machine.folder.path("dev/rtmotoren0")) == before);
}

TEST_CASE("on a Pi without the driver the advice is to load it", "[hw][doctor]") {
    const MouseMachine machine;
    machine.remove("dev");
    machine.remove("sys/module");
    const std::string text = not_well(machine.examine());
    CHECK(text.find("driver: rtmouse is not loaded -> sudo modprobe rtmouse; if there is no such module, build it: "
                    "https://github.com/rt-net/RaspberryPiMouse\n") != text.npos);
    CHECK(text.find("nodes: 14 of 14 are missing in ") != text.npos);
    CHECK(text.find("-> load the driver: sudo modprobe rtmouse\n") != text.npos);
}

TEST_CASE("a missing node is named", "[hw][doctor]") {
    const MouseMachine machine;
    machine.remove("dev/rtbuzzer0");
    CHECK(not_well(machine.examine()) ==
          "nodes: 1 of 14 are missing in " + machine.folder.path("dev").string() +
              ": rtbuzzer0 -> load the driver again, and look at what dmesg says: sudo modprobe -r rtmouse, then sudo "
              "modprobe rtmouse\n");
}

TEST_CASE("counters that the driver has not found are a matter of I2C", "[hw][doctor]") {
    const MouseMachine machine;
    machine.remove("dev/rtcounter_l0");
    machine.remove("dev/rtcounter_r0");
    CHECK_THAT(not_well(machine.examine()),
               Catch::Contains("rtcounter_l0 and rtcounter_r0 -> the driver has not found the counters on I2C. Is "
                               "dtparam=i2c_arm=on in config.txt"));
}

TEST_CASE("an I2C clock that is faster than the counters' makers ask for is wrong", "[hw][doctor]") {
    const MouseMachine machine;
    machine.folder.write("sys/bus/i2c/devices/i2c-1/of_node/clock-frequency", std::string_view("\0\6\32\200", 4));
    CHECK(
        not_well(machine.examine()) ==
        "I2C clock: 400000 Hz: the manufacturer of the wheel counters allows at most 62500 Hz, else readings fail -> "
        "write "
        "dtparam=i2c_baudrate=62500 into /boot/firmware/config.txt (/boot/config.txt on older systems), and restart\n");
    machine.folder.write("sys/bus/i2c/devices/i2c-1/of_node/clock-frequency", std::string_view("\0\0\364\44", 4));
    CHECK(found(machine.examine(), "I2C clock") == "62500 Hz");
}

TEST_CASE("for light sensors that give only zeros the advice is the overlay, if the kernel needs one", "[hw][doctor]") {
    const MouseMachine machine;
    machine.folder.write("dev/rtlightsensor0", "0 0 0 0\n");
    const std::string zeros =
        "light sensors: they always give 0 0 0 0: that is not a measurement -> switch SPI on (see the finding "
        "'overlay'), and check the boards' connector\n";
    CHECK(not_well(machine.examine()) ==
          zeros +
              "overlay: the converter of the light sensors is not on the SPI bus -> write dtparam=spi=on and "
              "dtoverlay=anyspi:spi0-0,dev=\"microchip,mcp3204\",speed=500000 into /boot/firmware/config.txt "
              "(/boot/config.txt on older systems), and restart\n");
    machine.folder.write("proc/sys/kernel/osrelease", "5.15.84\n");
    CHECK(not_well(machine.examine()).find("write dtparam=spi=on into /boot/firmware/config.txt") != std::string::npos);
    machine.folder.write("sys/bus/spi/devices/spi0.0/modalias", "spi:mcp3204\n");
    const Examination with_overlay = machine.examine();
    CHECK(not_well(with_overlay) == zeros);
    CHECK(found(with_overlay, "overlay") == "spi0.0 is spi:mcp3204");
}

TEST_CASE("for missing wheel counters the advice is I2C", "[hw][doctor]") {
    const MouseMachine machine;
    machine.folder.write("dev/rtcounter_r0", "nonsense\n");
    CHECK(not_well(machine.examine()) ==
          "wheel counters: they can't be read -> look at what dmesg says, and whether "
          "i2cdetect -y 1 shows 10 and 11\n");
    machine.remove("sys/bus/i2c");
    CHECK(not_well(machine.examine()).starts_with("I2C: it is off, and the wheel counters need it -> "));
}

TEST_CASE("computers that can't be used in a mouse are recognised", "[hw][doctor]") {
    const MouseMachine machine;
    machine.folder.write("sys/firmware/devicetree/base/model", "Raspberry Pi 5 Model B Rev 1.0");
    CHECK(not_well(machine.examine()) ==
          "board: Raspberry Pi 5 Model B Rev 1.0: the driver rtmouse does not work on it -> put a Raspberry Pi 2, 3, 4 "
          "or "
          "Zero 2 into the mouse\n");
    machine.folder.write("sys/firmware/devicetree/base/model", "Raspberry Pi Zero W Rev 1.1");
    machine.folder.write("proc/cpuinfo", "model name : ARMv6-compatible processor rev 7 (v6l)\nCPU architecture: 7\n");
    CHECK(not_well(machine.examine()) ==
          "board: Raspberry Pi Zero W Rev 1.1: its processor is an ARMv6, and packages for armhf do not run on it -> "
          "put a "
          "Raspberry Pi 2, 3, 4 or Zero 2 into the mouse\n");
}

TEST_CASE("too little voltage of a Pi is reported, also if it was earlier", "[hw][doctor]") {
    const MouseMachine machine;
    const std::string flags = "sys/devices/platform/soc/soc:firmware/get_throttled";
    machine.folder.write(flags, "50005\n");
    CHECK(not_well(machine.examine()).starts_with("supply: the Pi has too little voltage -> charge "));
    machine.folder.write(flags, "50000\n");
    CHECK(not_well(machine.examine()).empty());
    CHECK(found(machine.examine(), "supply") == "the Pi has had too little voltage since its start");
    machine.remove("sys/devices");
    machine.folder.write("sys/class/hwmon/hwmon1/name", "rpi_volt\n");
    machine.folder.write("sys/class/hwmon/hwmon1/in0_lcrit_alarm", "1\n");
    CHECK(not_well(machine.examine()).starts_with("supply: "));
}

TEST_CASE("programs that have a node open are named, and their counters are not tested", "[hw][doctor]") {
    const MouseMachine machine;
    machine.folder.write("dev/rtcounter_l1", "5\n");
    machine.folder.write("proc/812/comm", "python3\n");
    std::filesystem::create_directories(machine.folder.path("proc/812/fd"));
    std::filesystem::create_symlink(std::filesystem::canonical(machine.folder.path("dev/rtcounter_l1")),
                                    machine.folder.path("proc/812/fd/3"));
    const Examination all = machine.examine();
    CHECK(not_well(all) == "programs: python3 (process 812) has " + machine.folder.path("dev/rtcounter_l1").string() +
                               " open -> end this program before you drive the robot: kill 812\n");
    CHECK(found(all, "wheel counters") == "another program uses them: not tested");
}

TEST_CASE("of a program and its guard only the program is named", "[hw][doctor]") {
    const MouseMachine machine;
    const auto node = std::filesystem::canonical(machine.folder.path("dev/rtmotoren0"));
    for (const auto& [process, parent] : {std::pair("812", "1"), std::pair("813", "812")}) {
        const std::string folder = std::string("proc/") + process;
        machine.folder.write(folder + "/comm", "nezumi\n");
        machine.folder.write(folder + "/status", std::string("Name:\tnezumi\nPPid:\t") + parent + "\n");
        std::filesystem::create_directories(machine.folder.path(folder + "/fd"));
        std::filesystem::create_symlink(node, machine.folder.path(folder + "/fd/3"));
    }
    CHECK(not_well(machine.examine()) == "programs: nezumi (process 812) has " + node.string() +
                                             " open -> end this program before you drive the robot: kill 812\n");
}

TEST_CASE("the lock also shows which program drives the motors", "[hw][doctor]") {
    const MouseMachine machine;
    const std::string node = machine.folder.path("dev/rtmotoren0").string();
    std::array<int, 2> ends{};
    REQUIRE(pipe(ends.data()) == 0);
    const pid_t other = fork();
    if (other == 0) {
        const auto lease = Lease::take("raspimouse", node);
        if (lease && write(ends[1], "1", 1) == 1) pause();
        _exit(1);
    }
    close(ends[1]);
    char taken = 0;
    REQUIRE(read(ends[0], &taken, 1) == 1);
    const std::string text = not_well(machine.examine());
    kill(other, SIGKILL);
    waitpid(other, nullptr, 0);
    close(ends[0]);
    CHECK(text.find("drives this robot's motors -> end it first, then try again\n") != text.npos);
    CHECK(text.find("process " + std::to_string(other)) != text.npos);
}

TEST_CASE("a node that does not answer costs one second and is reported", "[hw][doctor]") {
    const MouseMachine machine;
    machine.remove("dev/rtlightsensor0");
    REQUIRE(mkfifo(machine.folder.path("dev/rtlightsensor0").c_str(), 0666) == 0);
    const std::string text = not_well(machine.examine());
    CHECK(text.find("light sensors: they do not answer -> sudo modprobe -r rtmouse, then sudo modprobe rtmouse\n") !=
          text.npos);
}

TEST_CASE("for nodes without permission the advice is the udev rule", "[hw][doctor]") {
    const MouseMachine machine;
    chmod(machine.folder.path("").c_str(), 0755);
    chmod(machine.folder.path("dev/rtmotoren0").c_str(), 0600);
    const bool was_root = geteuid() == 0;
    if (was_root) {
        REQUIRE(seteuid(65534) == 0);
    } else {
        chmod(machine.folder.path("dev/rtmotoren0").c_str(), 0);
    }
    const std::string text = not_well(machine.examine());
    if (was_root) REQUIRE(seteuid(0) == 0);
    CHECK(text.find("permissions: this user has no permission to use rtmotoren0") != text.npos);
    CHECK(text.find(
              "-> sudo cp /usr/share/nezumi/60-nezumi.rules /etc/udev/rules.d/, then sudo udevadm control --reload, "
              "sudo udevadm trigger, and sudo adduser $USER dialout\n") != text.npos);
}

TEST_CASE("cameras and sound cards are listed", "[hw][doctor]") {
    const MouseMachine machine;
    machine.folder.write("sys/class/video4linux/video0/name", "USB Camera\n");
    machine.folder.write("proc/asound/cards",
                         " 0 [Headphones     ]: bcm2835_headpho - bcm2835 Headphones\n"
                         "                      bcm2835 Headphones\n");
    CHECK(not_well(machine.examine()).starts_with("camera: video0: USB Camera: "));
    machine.folder.write("dev/video0", "");
    CHECK(found(machine.examine(), "camera") == "video0: USB Camera");
    CHECK(found(machine.examine(), "sound") == "bcm2835 Headphones");
}

TEST_CASE("a camera can't be used without nezumi's module for cameras", "[hw][doctor]") {
    MouseMachine machine;
    machine.cameras = "libopencv_videoio.so.406 is not there. Install it";
    CHECK(not_well(machine.examine()).empty());
    machine.folder.write("sys/class/video4linux/video0/name", "USB Camera\n");
    machine.folder.write("dev/video0", "");
    CHECK(found(machine.examine(), "camera") == "video0: USB Camera");
    CHECK(not_well(machine.examine()) ==
          "camera: nezumi can't use it -> libopencv_videoio.so.406 is not there. Install it\n");
    machine.cameras = "";  // the program of this test can use cameras
    CHECK(not_well(machine.examine()).empty());
}

TEST_CASE("motors, sensors and battery of a brick are listed", "[hw][doctor]") {
    const Scratch folder;
    const auto device = [&](const std::string& path, const char* driver, const char* port) {
        folder.write("sys/class/" + path + "/driver_name", std::string(driver) + "\n");
        folder.write("sys/class/" + path + "/address", std::string("ev3-ports:") + port + "\n");
        folder.write("sys/class/" + path + "/command", "");
    };
    device("tacho-motor/motor0", "lego-ev3-l-motor", "outB");
    device("lego-sensor/sensor0", "lego-ev3-gyro", "in2");
    folder.write("sys/class/power_supply/lego-ev3-battery/voltage_now", "5900000\n");
    const auto examine = [&] {
        MachineRoots roots;
        roots.devices = {.dev = folder.path("dev").string(), .sys = folder.path("sys").string()};
        roots.proc = folder.path("proc").string();
        return hw::examine(roots);
    };
    const Examination one = examine();
    CHECK(one.driver == "ev3");
    CHECK(not_well(one) ==
          "motors: 1 of 2 large motors are plugged in: lego-ev3-l-motor at outB -> plug the wheels' large motors into "
          "B and "
          "C, and look at their cables\n"
          "battery: 5.9 V: below 6.2 V the robot does not drive -> charge the battery, or put in fresh batteries\n");
    CHECK(found(one, "sensors") == "lego-ev3-gyro at in2");
    device("tacho-motor/motor1", "lego-ev3-l-motor", "outC");
    folder.write("sys/class/power_supply/lego-ev3-battery/voltage_now", "7900000\n");
    CHECK(not_well(examine()).empty());
    CHECK(found(examine(), "motors") == "lego-ev3-l-motor at outB and lego-ev3-l-motor at outC");
}

TEST_CASE("on a computer that is not a robot the advice is to examine the robot", "[hw][doctor]") {
    const Scratch folder;
    MachineRoots roots;
    roots.devices = {.dev = folder.path("dev").string(), .sys = folder.path("sys").string()};
    roots.proc = folder.path("proc").string();
    const Examination all = hw::examine(roots);
    CHECK(all.driver.empty());
    CHECK(not_well(all) ==
          "robot: this machine is neither a Raspberry Pi Mouse nor an EV3 -> run nezumi doctor on the "
          "robot; here systems are simulated, so nothing more is needed\n");
}

TEST_CASE("the permission of a node is explained by the name of its group", "[hw][doctor]") {
    const Scratch folder;
    folder.write("node", "");
    const std::string node = folder.path("node").string();
    std::filesystem::permissions(node, std::filesystem::perms(0660));
    const group* const devices = getgrnam("dialout");
    if (devices == nullptr || chown(node.c_str(), geteuid(), devices->gr_gid) != 0) {
        WARN("SKIPPED: this user can't give a file to the group dialout");
        return;
    }
    CHECK(group_that_may(node) == "sudo adduser $USER dialout, then log in again");
    std::filesystem::permissions(node, std::filesystem::perms(0640));
    CHECK(group_that_may(node).empty());
}
