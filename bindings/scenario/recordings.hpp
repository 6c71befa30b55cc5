// The interface to recorded runs, which the program that runs scenarios provides.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// A recorded run as a world.
class RecordedWorld {
public:
    virtual ~RecordedWorld() = default;
    virtual RunningSystem& live() = 0;
    /// Performs what happened before the next tick. Returns false at the end.
    virtual Expected<bool> before_tick() = 0;
    /// [s] of simulated time
    virtual double length() const = 0;
};

/// The judged behaviour, and the recorded run.
struct JudgeRequest {
    std::string behavior{};                    ///< its file, or its name
    std::string component{};                   ///< the recorded component; "" for the one with this file
    std::string run{};                         ///< the recording or journal
    std::map<std::string, std::string> map{};  ///< topics by names of ports, for recordings of other programs
    double tolerance = 1e-6;                   ///< largest difference at which two numbers count as equal
};

class Recordings {
public:
    virtual ~Recordings() = default;
    /// `ports` are names of ports by topics; if there are some, the run is read from its topics. The system is not
    /// active yet.
    virtual Expected<std::unique_ptr<RecordedWorld>> open(const std::filesystem::path& file,
                                                          const std::map<std::string, std::string>& ports,
                                                          LiveOptions options) const = 0;
    /// The differences between the outputs of the behaviour and those of the recorded run, one line for each; empty if
    /// there are none. Files in `request` are paths.
    virtual Expected<std::vector<std::string>> judge(const JudgeRequest& request) const = 0;
};

}  // namespace nezumi
