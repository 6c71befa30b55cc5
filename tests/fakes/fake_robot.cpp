// Steps the world at real time on a thread of its own, while FUSE serves the nodes.
#include "tests/fakes/fake_robot.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <istream>
#include <sstream>
#include <thread>
#include <utility>

#include "bindings/lua/files/robot_file.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/world/chessboard.hpp"
#include "engine/world/maze_file.hpp"
#include "sim/world.hpp"
#include "tests/fakes/command_socket.hpp"
#include "tests/fakes/fuse_folder.hpp"

namespace nezumi::fakes {
namespace {

constexpr double physics_step = 0.005;  // [s]

void say_ready() {
    std::puts("ready");
    std::fflush(stdout);
}

}  // namespace

WorldBehind::WorldBehind(RobotSpec spec, const ArenaSpec& arena, Act act, Sense sense)
    : spec_(std::move(spec)), act_(std::move(act)), sense_(std::move(sense)) {
    world_ = std::move(*sim::make_world(arena, {.step = physics_step, .seed = 1}, nullptr));
    body_ = std::move(*world_->add_robot("robot", spec_, {}));
}

void WorldBehind::run() {
    auto due = std::chrono::steady_clock::now();
    for (;;) {
        due += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(physics_step));
        std::this_thread::sleep_until(due);
        step();
    }
}

void WorldBehind::step() {
    const std::lock_guard lock(mutex_);
    act_(spec_, *body_);
    world_->step(1);
    if (touched_.empty()) touched_ = world_->collided_with(body_->id());
    ++now_.tick;
    now_.seconds += physics_step;
    const WheelReading wheels = body_->read_wheels(now_, physics_step);
    sense_(spec_, *body_, wheels, body_->read_sensors(now_, physics_step));
}

void WorldBehind::film(CameraNodes& camera) {
    using Clock = std::chrono::steady_clock;
    std::unique_ptr<CameraSource> source;
    CameraImage image;
    auto due = Clock::now();
    for (;;) {
        const auto wanted = camera.wanted();
        due = std::max(due, Clock::now() - std::chrono::milliseconds(100));
        due += std::chrono::microseconds(static_cast<int>(1e6 / (wanted ? wanted->frame_rate : 100)));
        std::this_thread::sleep_until(due);
        if (!wanted) continue;
        double tm = 0;
        {
            const std::lock_guard lock(mutex_);
            if (std::exchange(is_filmed_anew_, false) || lens_.width != wanted->width) {
                lens_.width = wanted->width;
                lens_.height = wanted->height;
                source = std::move(*world_->open_camera(mount_, lens_));
            }
            tm = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
            source->expose(now_);
        }
        source->develop(image);
        camera.give(image, tm);
    }
}

void WorldBehind::answer_for_camera(const std::string& command, std::istream& words) {
    if (command == "marker") {
        Pose3D pose;
        words >> pose.position.x >> pose.position.y >> pose.position.z >> pose.orientation.y;
        static_cast<void>(world_->move_marker("target", pose));
        return;
    }
    if (command == "look") {
        CameraMount held;
        const bool is_held = static_cast<bool>(words >> held.at.x >> held.at.y >> held.at.z >> held.yaw >> held.pitch);
        mount_ = is_held ? held : CameraMount{.robot = "robot", .at = {0.05, 0, 0.06}};
    } else {
        words >> lens_.field_of_view >> lens_.k1 >> lens_.k2 >> lens_.p1 >> lens_.p2 >> lens_.k3;
    }
    is_filmed_anew_ = true;
}

bool WorldBehind::answer(const std::string& line, std::string& text) {
    std::istringstream words(line);
    std::string command, name;
    words >> command;
    const std::lock_guard lock(mutex_);
    if (command == "truth") {
        const Truth truth = world_->truth(body_->id());
        text = fmt::format("{} {} {} {} {} {} {} {}", truth.pose.position.x, truth.pose.position.y, truth.pose.heading,
                           truth.velocity.vx, truth.velocity.vy, truth.velocity.va, truth.height, truth.tilt);
    } else if (command == "touched") {
        text = std::exchange(touched_, "");
    } else if (command == "place") {
        Pose2D pose;
        words >> pose.position.x >> pose.position.y >> pose.heading;
        if (auto placed = world_->teleport(body_->id(), pose); !placed) text = placed.error().message;
    } else if (command == "disturb") {
        VelocityConstraint constraint;
        for (auto* speed : {&constraint.vx, &constraint.vy, &constraint.va}) {
            if (words >> name && name != "-") *speed = std::strtod(name.c_str(), nullptr);
        }
        world_->disturb(body_->id(), constraint);
    } else if (command == "press") {
        bool pressed = false;
        words >> name >> pressed;
        text = "no such sensor";
        for (std::size_t i = 0; i < spec_.sensors.size(); ++i) {
            if (spec_.sensors[i].name != name) continue;
            world_->press(body_->id(), i, pressed);
            text.clear();
        }
    } else if (command == "marker" || command == "look" || command == "lens") {
        answer_for_camera(command, words);
    } else {
        return false;
    }
    return true;
}

int be_fake_robot(int count, char** words, ServedFiles& files, WorldBehind::Act act, WorldBehind::Sense sense,
                  std::function<std::string(const std::string& line)> answer, CameraNodes* camera) {
    if (count < 4) {
        std::fprintf(stderr, "usage: %s MOUNT_POINT SOCKET ROBOT_FILE [BOX_X|board|MAZE.txt]\n", words[0]);
        return 2;
    }
    const std::filesystem::path model = words[3];
    auto spec = read_robot_file(model, Project::of(model));
    if (!spec) {
        std::fprintf(stderr, "%s\n", describe(spec.error()).c_str());
        return 2;
    }
    ArenaSpec arena;
    arena.markers.push_back({.name = "target", .id = 7, .size = 0.1, .at = {0, 0, -5}});
    if (count > 4 && words[4] == std::string("board")) {
        arena.boxes = chessboard({});
    } else if (count > 4 && std::string_view(words[4]).ends_with(".txt")) {
        const auto text = read_whole(words[4], words[4]);
        const auto maze = text ? read_maze(*text, words[4]) : Unexpected(text.error());
        if (!maze) {
            std::fprintf(stderr, "%s\n", describe(maze.error()).c_str());
            return 2;
        }
        arena.boxes = walls_of(*maze, {});
    } else if (count > 4) {
        arena.boxes.push_back({.at = {std::strtod(words[4], nullptr), 0, 0.15}, .size = {0.1, 2.0, 0.3}});
    }
    WorldBehind behind(std::move(*spec), arena, std::move(act), std::move(sense));
    const auto answer_all = [&](const std::string& line) {
        std::string text;
        return behind.answer(line, text) ? text : answer(line);
    };
    std::thread([&] { behind.run(); }).detach();
    if (camera != nullptr) std::thread([&behind, camera] { behind.film(*camera); }).detach();
    return be_fake_device(count, words, files, answer_all);
}

int be_fake_device(int count, char** words, ServedFiles& files,
                   std::function<std::string(const std::string& line)> answer) {
    if (count < 3) {
        std::fprintf(stderr, "usage: %s MOUNT_POINT SOCKET\n", words[0]);
        return 2;
    }
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // no mount outlives the test
    std::signal(SIGPIPE, SIG_IGN);
    if (!serve_commands(words[2], std::move(answer))) return 2;
    const int status = serve_folder(words[1], files, say_ready);
    std::fflush(nullptr);
    _exit(status);  // its threads go on until then
}

}  // namespace nezumi::fakes
