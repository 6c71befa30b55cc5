// Reads a Raspberry Pi's name from its device tree, and low voltage from a flag of its firmware.
#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <sstream>

#include "hw/doctor/examine.hpp"
#include "hw/doctor/machine_queries.hpp"

namespace nezumi::hw {
namespace {

using enum Finding::State;

// The kernel names the processor of a Pi 1 and Zero "ARMv6-compatible processor rev 7 (v6l)".
bool is_armv6(const std::string& proc) {
    std::ifstream file(proc + "/cpuinfo");
    std::stringstream text;
    text << file.rdbuf();
    return text.str().find("ARMv6") != std::string::npos;
}

// The firmware's bits: 0: under-voltage now; 16: under-voltage since the start (documentation of vcgencmd
// get_throttled).
void examine_supply(const MachineRoots& roots, Findings& findings) {
    const std::string& sys = roots.devices.sys;
    std::string text = first_line(sys + "/devices/platform/soc/soc:firmware/get_throttled");
    unsigned long bits = 0;
    bool is_known = !text.empty();
    if (is_known) {
        if (text.starts_with("0x")) text.erase(0, 2);
        is_known = std::from_chars(text.data(), text.data() + text.size(), bits, 16).ec == std::errc{};
    }
    for (const std::string& name : names_in(sys + "/class/hwmon")) {
        const std::string folder = fmt::format("{}/class/hwmon/{}", sys, name);
        if (first_line(folder + "/name") != "rpi_volt") continue;
        is_known = true;
        if (first_line(folder + "/in0_lcrit_alarm") == "1") bits |= 1UL;
    }
    if (!is_known) return;
    const std::string advice = "charge or change the battery, and look at its cable: the Pi slows down and may restart";
    if ((bits & 1UL) != 0) {
        findings.push_back({"supply", wrong, "the Pi has too little voltage", advice});
    } else if ((bits & (1UL << 16U)) != 0) {
        findings.push_back({"supply", note, "the Pi has had too little voltage since its start", advice});
    } else {
        findings.push_back({"supply", good, "the Pi has enough voltage", ""});
    }
}

}  // namespace

std::string examine_board(const MachineRoots& roots, Findings& findings) {
    std::string board = first_line(roots.devices.sys + "/firmware/devicetree/base/model");
    if (board.starts_with("Raspberry Pi 5") || board.starts_with("Raspberry Pi Compute Module 5")) {
        findings.push_back({"board", wrong, board + ": the driver rtmouse does not work on it",
                            "put a Raspberry Pi 2, 3, 4 or Zero 2 into the mouse"});
    } else if (is_armv6(roots.proc)) {
        findings.push_back({"board", wrong,
                            (board.empty() ? "this computer" : board) +
                                ": its processor is an ARMv6, and packages for armhf do not run on it",
                            "put a Raspberry Pi 2, 3, 4 or Zero 2 into the mouse"});
    } else if (!board.empty()) {
        findings.push_back({"board", good, board, ""});
    }
    examine_supply(roots, findings);
    return board;
}

}  // namespace nezumi::hw
