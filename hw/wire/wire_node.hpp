// Opens the device node of a device on a wire, after checking that it is of the right kind.
#pragma once

#include <memory>
#include <string>

#include "engine/base/descriptor.hpp"
#include "hw/wire/wire_driver.hpp"

namespace nezumi::hw {

/// A kind of device node.
struct NodeKind {
    std::string subsystem;  ///< of the kernel, as in /sys/class: "i2c-dev"; "": not checked
    std::string what;       ///< "a serial line"
    std::string example;    ///< "/dev/ttyACM0"
    std::string when_missing;
    std::string group;    ///< the users of this group may use it: "dialout"
    std::string module;   ///< the kernel module that makes the nodes: "i2c-dev"; "": none
    std::string node;     ///< beginning of the nodes' names: "i2c-"
    std::string adapter;  ///< beginning of a path in /sys that exists also without the module: "bus/i2c/devices/i2c-"
};

/// Opens a node: a character device of this kind. With another root than /dev, it may also be a plain file
/// (`is_plain`). The node is checked before it is opened, because opening may wake, rewind or block a device of another
/// kind.
struct WireNode {
    Descriptor file;
    bool is_plain = false;
};
OrWhy<WireNode> open_node(const std::string& path, const DeviceRoots& roots, const NodeKind& kind);

/// Describes an error of a node, with what to do.
std::string with_wire_advice(const std::string& path, int error, const NodeKind& kind);
/// The error for a node of another kind: "/dev/null: it is not a serial line: expected a device such as /dev/ttyACM0".
std::string not_of_kind(const std::string& path, const NodeKind& kind);

/// A plain file that replaces a device in tests: each message replaces the one before, and no messages are received.
std::unique_ptr<OpenWire> plain_wire(Descriptor file);

}  // namespace nezumi::hw
