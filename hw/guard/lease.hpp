// Who may drive a robot's motors: one program of the machine at a time.
#pragma once

#include <string>
#include <utility>

#include "engine/base/error.hpp"

namespace nezumi::hw {

/// An advisory lock (`flock`) on a node of the robot, or on a folder of nodes. Processes forked from the holder hold it
/// as well: it is free when the last of them has closed it or ended.
class Lease {
public:
    /// An error when it can't be opened, a node for writing, or names the process that holds it.
    static Expected<Lease> take(const std::string& node);
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
