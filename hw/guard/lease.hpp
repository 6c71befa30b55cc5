// A lease on a robot's motors: only one program of a machine may drive them.
#pragma once

#include <string>
#include <utility>

#include "engine/base/error.hpp"

namespace nezumi::hw {

/// A socket name that can exist only once per machine: independent of the robot's nodes. Processes forked from the
/// holder hold it too: it is free when the last of them has closed it or ended. A container with its own network counts
/// as a machine.
class Lease {
public:
    /// `driver` reaches the robot by `node`, one of its nodes or a folder of them. A machine has one robot per driver;
    /// robots under other roots than /dev and /sys are separate. Fails if there is no such node, or if another program
    /// holds it (with its process).
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
