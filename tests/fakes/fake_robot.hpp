// What the programs that stand for a robot share: its nodes served, and behind them the simulated world at real time.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "engine/world/world.hpp"
#include "tests/fakes/served_files.hpp"

namespace nezumi::fakes {

/// The world of one robot, which does what its nodes are told.
class WorldBehind {
public:
    /// What the nodes want of the body, before each step.
    using Act = std::function<void(const RobotSpec& spec, RobotBody& body)>;
    /// What the body says to the nodes, after each step.
    using Sense = std::function<void(const RobotSpec& spec, RobotBody& body, const WheelReading& wheels,
                                     std::span<const SensorReading> readings)>;

    WorldBehind(RobotSpec spec, const ArenaSpec& arena, Act act, Sense sense);
    /// At real time, for ever.
    void run();
    /// What a rig answers (hw/rig): false when it is another command.
    bool answer(const std::string& line, std::string& text);

private:
    void step();

    RobotSpec spec_;
    Act act_;
    Sense sense_;
    std::mutex mutex_;
    std::unique_ptr<World> world_;
    std::unique_ptr<RobotBody> body_;
    Time now_{};
    std::string touched_;  // since it was asked last
};

/// The whole program. Words: MOUNT_POINT SOCKET ROBOT_FILE [BOX_X] (a wall at x = BOX_X [m]). Says "ready" when the
/// nodes are there. Lines at the socket are for the world, or for `answer`.
int be_fake_robot(int count, char** words, ServedFiles& files, WorldBehind::Act act, WorldBehind::Sense sense,
                  std::function<std::string(const std::string& line)> answer);

/// The same for a device without a world. Words: MOUNT_POINT SOCKET.
int be_fake_device(int count, char** words, ServedFiles& files,
                   std::function<std::string(const std::string& line)> answer);

}  // namespace nezumi::fakes
