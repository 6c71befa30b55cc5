// Who may drive a robot's motors: one program of the machine at a time.
#pragma once

#include <string>
#include <utility>

#include "engine/base/error.hpp"

namespace nezumi::hw {

/// A name that only one socket of the machine can have: the robot's, whatever becomes of its nodes. Processes forked
/// from the holder hold it as well: it is free when the last of them has closed it or ended. A container with a network
/// of its own counts as a machine.
class Lease {
public:
    /// `driver` reaches the robot by `node`, one of its nodes or a folder of them. A machine has one robot of a driver;
    /// those under other roots than /dev and /sys are others. An error when there is no such node, or when another
    /// program holds it, with its process.
    static Expected<Lease> take(const std::string& driver, const std::string& node);
    /// Of a robot that is none: anybody may have one.
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
