// What the programs that stand for a robot share: its nodes served, and behind them the simulated world at real time.
#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <mutex>
#include <span>
#include <string>

#include "engine/world/camera_source.hpp"
#include "engine/world/world.hpp"
#include "tests/fakes/camera_nodes.hpp"
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
    /// Gives a camera on the robot its pictures, for ever, as long as it streams.
    void film(CameraNodes& camera);
    /// What a rig answers (hw/rig), and "marker X Y Z HEADING" (tag 7, 0.1 m), "lens FIELD_OF_VIEW K1 K2 P1 P2 K3",
    /// "look X Y Z YAW PITCH" (somebody holds the camera there; no numbers: it is on the robot): false when it is
    /// another command.
    bool answer(const std::string& line, std::string& text);

private:
    void step();
    void answer_for_camera(const std::string& command, std::istream& words);

    RobotSpec spec_;
    Act act_;
    Sense sense_;
    std::mutex mutex_;
    std::unique_ptr<World> world_;
    std::unique_ptr<RobotBody> body_;
    Time now_{};
    std::string touched_;  // since it was asked last
    CameraMount mount_{.robot = "robot", .at = {0.05, 0, 0.06}};
    CameraSettings lens_{.field_of_view = 1.0472};
    bool is_filmed_anew_ = true;  // mount or lens have changed
};

/// The whole program. Words: MOUNT_POINT SOCKET ROBOT_FILE [BOX_X] (a wall at x = BOX_X [m]; "board": a chessboard of
/// 9 x 6 inner corners, 25 mm apart, on the floor at x = 3). Says "ready" when the nodes are there. Lines at the socket
/// are for the world, or for `answer`. `camera`, where there is one, gets the pictures of a camera on the robot.
int be_fake_robot(int count, char** words, ServedFiles& files, WorldBehind::Act act, WorldBehind::Sense sense,
                  std::function<std::string(const std::string& line)> answer, CameraNodes* camera = nullptr);

/// The same for a device without a world. Words: MOUNT_POINT SOCKET.
int be_fake_device(int count, char** words, ServedFiles& files,
                   std::function<std::string(const std::string& line)> answer);

}  // namespace nezumi::fakes
