// Error messages for each kind of trouble with the mouse's nodes.
#include "hw/raspimouse/advice.hpp"

#include <fmt/format.h>

#include <cerrno>

#include "engine/base/error.hpp"

namespace nezumi::hw {

std::string with_mouse_advice(const NodeError& error) {
    switch (error.code) {
        case ENOENT:
        case ENODEV:
        case ENXIO: return describe(error) + ": is the driver loaded? Try: sudo modprobe rtmouse";
        case EACCES:
        case EPERM:
            return describe(error) +
                   ": this user has no permission to use it. Try: sudo chmod a+rw /dev/rt*, or write a udev rule for "
                   "it";
        case EISDIR: return describe(error) + " and no device: is --dev-root right?";
        default: return describe(error) + ": look at the robot's power and cables, and at what dmesg says";
    }
}

std::string not_understood(const Node& node, std::string_view said, std::string_view expected) {
    return fmt::format("{}: expected {}, got '{}': is it the node of another driver?", node.path(), expected,
                       shown(said));
}

}  // namespace nezumi::hw
