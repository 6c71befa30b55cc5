// A Raspberry Pi Mouse without the robot: its driver's nodes, and behind them the simulated world at real time.
// Usage: fake_mouse MOUNT_POINT SOCKET ROBOT_FILE [BOX_X]     (a wall at x = BOX_X [m])
// Says "ready" when the nodes are there. What a test can say at the socket is in `answer`.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>

#include "bindings/lua/files/robot_file.hpp"
#include "sim/world.hpp"
#include "tests/fakes/command_socket.hpp"
#include "tests/fakes/fuse_folder.hpp"
#include "tests/fakes/mouse_nodes.hpp"

using namespace nezumi;

namespace {

constexpr double physics_step = 0.005;  // [s]

// The world of one robot that does what the nodes are told.
class Behind {
public:
    Behind(fakes::MouseNodes& nodes, RobotSpec spec, const ArenaSpec& arena) : nodes_(nodes), spec_(std::move(spec)) {
        world_ = std::move(*sim::make_world(arena, {.step = physics_step, .seed = 1}, nullptr));
        body_ = std::move(*world_->add_robot("mouse", spec_, {}));
    }

    // At real time, for ever.
    void run() {
        auto due = std::chrono::steady_clock::now();
        for (;;) {
            due += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                std::chrono::duration<double>(physics_step));
            std::this_thread::sleep_until(due);
            step();
        }
    }

    Truth truth() {
        const std::lock_guard lock(mutex_);
        return world_->truth(body_->id());
    }

private:
    void step() {
        const std::lock_guard lock(mutex_);
        const double metres = 2 * std::numbers::pi * spec_.drive.radius / spec_.drive.pulses_per_turn;
        const auto motion = nodes_.motion();
        if (motion.power) {
            body_->set_wheel_speeds({.left = motion.left * metres, .right = motion.right * metres});
        } else {
            body_->coast();
        }
        world_->step(1);
        ++now_.tick;
        now_.seconds += physics_step;
        body_->read_wheels(now_, physics_step);
        const auto readings = body_->read_sensors(now_, physics_step);
        std::array<int, 4> lights{};
        std::size_t channel = 0;
        for (std::size_t i = 0; i < spec_.sensors.size() && channel < lights.size(); ++i) {
            if (spec_.sensors[i].kind == SensorSpec::Kind::range)
                lights[channel++] = static_cast<int>(readings[i].value);
        }
        nodes_.set_lights(lights);
    }

    fakes::MouseNodes& nodes_;
    RobotSpec spec_;
    std::mutex mutex_;
    std::unique_ptr<World> world_;
    std::unique_ptr<RobotBody> body_;
    Time now_{};
};

std::string answer(const std::string& line, fakes::MouseNodes& nodes, Behind& behind) {
    std::istringstream words(line);
    std::string command, name, value;
    words >> command >> name >> value;
    if (command == "fault") return nodes.set_fault(name, value) ? "" : "no such node or fault";
    if (command == "heal") {
        for (const std::string& node : nodes.names()) nodes.set_fault(node, "none");
    } else if (command == "press") {
        nodes.press(std::stoul(name), value == "1");
    } else if (command == "reload") {
        nodes.reload();
    } else if (command == "signed") {
        nodes.open_signed();
    } else if (command == "counters") {
        nodes.set_counters(static_cast<std::uint16_t>(std::stoul(name)));
    } else if (command == "truth") {
        const Pose2D pose = behind.truth().pose;
        return fmt::format("{} {} {}", pose.position.x, pose.position.y, pose.heading);
    } else if (command == "motion") {  // left right power tone still_since (0: moves) leds
        const auto motion = nodes.motion();
        std::string text = fmt::format("{} {} {} {} {:.6f} ", motion.left, motion.right, motion.power ? 1 : 0,
                                       motion.tone, motion.still_since.value_or(0));
        for (const bool led : motion.leds) text += led ? '1' : '0';
        return text;
    } else if (command == "log") {  // time node text result
        std::string text;
        for (const auto& write : nodes.log())
            text += fmt::format("{:.6f} {} '{}' {}\n", write.at, write.node, write.text, write.result);
        return text;
    } else if (command == "clear") {
        nodes.clear_log();
    } else {
        return "unknown command";
    }
    return "";
}

void say_ready() {
    std::puts("ready");
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
    if (count < 4) {
        std::fputs("usage: fake_mouse MOUNT_POINT SOCKET ROBOT_FILE [BOX_X]\n", stderr);
        return 2;
    }
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // no mount outlives the test
    std::signal(SIGPIPE, SIG_IGN);
    const std::filesystem::path model = words[3];
    auto spec = read_robot_file(model, Project::of(model));
    if (!spec) {
        std::fprintf(stderr, "%s\n", describe(spec.error()).c_str());
        return 2;
    }
    ArenaSpec arena;
    if (count > 4) arena.boxes.push_back({.at = {std::strtod(words[4], nullptr), 0, 0.15}, .size = {0.1, 2.0, 0.3}});
    fakes::MouseNodes nodes;
    Behind behind(nodes, std::move(*spec), arena);
    if (!fakes::serve_commands(words[2], [&](const std::string& line) { return answer(line, nodes, behind); }))
        return 2;
    std::thread([&] { behind.run(); }).detach();
    const int status = fakes::serve_folder(words[1], nodes, say_ready);
    std::fflush(nullptr);
    _exit(status);  // its threads go on until then
}
