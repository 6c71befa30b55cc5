// A lease on a robot's motors: only one program of a machine may drive them.
#pragma once

#include <string>
#include <utility>

#include "engine/base/error.hpp"

namespace nezumi::hw {

/// The lease is a socket name, which can exist only once per machine; it does not depend on the robot's nodes.
/// Processes forked from the holder hold the lease too: it is free when the last of them has closed it or ended. A
/// container with a separate network counts as a machine.
class Lease {
public:
    /// Takes the lease on the robot that `driver` reaches by `node`, a device node or a folder of them. A machine has
    /// one robot per driver; robots under other roots than /dev and /sys are separate. Fails if the node does not
    /// exist, or if another program holds the lease; the error names its process.
    static Expected<Lease> take(const std::string& driver, const std::string& node);
    /// A lease without a robot; it never conflicts.
    static Expected<Lease> of_nothing();
    ~Lease();
    Lease(Lease&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    Lease& operator=(Lease&&) = delete;

    int file() const { return file_; }

private:
    explicit Lease(int file) : file_(file) {}

    int file_;
};

}  // namespace nezumi::hw
