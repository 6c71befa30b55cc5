// Opens the node of a device on a wire, if it is one.
#pragma once

#include <memory>
#include <string>

#include "engine/base/descriptor.hpp"
#include "hw/wire/wire_driver.hpp"

namespace nezumi::hw {

/// Which nodes are of a kind of device.
struct NodeKind {
    std::string subsystem;  ///< of the kernel, as in /sys/class: "i2c-dev"; "": not checked
    std::string what;       ///< "a serial line"
    std::string example;    ///< "/dev/ttyACM0"
    std::string when_missing;
    std::string group;    ///< of the users that may use it: "dialout"
    std::string module;   ///< makes the nodes: "i2c-dev"; "": no module
    std::string node;     ///< how the nodes' names begin: "i2c-"
    std::string adapter;  ///< in /sys, without a module too: "bus/i2c/devices/i2c-" and the rest of the node's name
};

/// Opens a node: a character device of this kind, or, under another root than /dev, a plain file in its place
/// (`is_plain`). It is checked before it is opened, as opening may wake, rewind or block other devices.
struct WireNode {
    Descriptor file;
    bool is_plain = false;
};
OrWhy<WireNode> open_node(const std::string& path, const DeviceRoots& roots, const NodeKind& kind);

/// An error of a node, with what to do.
std::string with_wire_advice(const std::string& path, int error, const NodeKind& kind);
/// "/dev/null: it is not a serial line: expected a device such as /dev/ttyACM0".
std::string not_of_kind(const std::string& path, const NodeKind& kind);

/// A plain file in place of a device, for tests: each message replaces the one before, and nothing is ever read.
std::unique_ptr<OpenWire> plain_wire(Descriptor file);

}  // namespace nezumi::hw
