// A running fake robot, and a robot of the engine that uses it: driver, fake device, physics and back.
#pragma once

#include <poll.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bindings/lua/files/robot_file.hpp"
#include "engine/system/system.hpp"
#include "hw/device/clock.hpp"
#include "hw/drivers.hpp"
#include "tests/unit/hw/paced_run.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi::hw {

inline void sleep_for(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// A program beside the test that acts as a robot, or without `model` as another device, with its nodes in `mount()`.
/// Without FUSE the test is skipped.
class FakeRobot {
public:
    FakeRobot(const std::string& name, const std::string& model, const std::vector<std::string>& more = {}) {
        const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
        if (access(program.c_str(), X_OK) != 0)
            throw std::runtime_error("SKIPPED: " + name + " was not built: is libfuse3-dev installed?");
        if (access("/dev/fuse", R_OK | W_OK) != 0)
            throw std::runtime_error("SKIPPED: FUSE is not to be had here: may this user open /dev/fuse?");
        std::filesystem::create_directory(mount());
        std::vector<std::string> words{program, mount(), socket_path()};
        if (!model.empty()) words.push_back(robot_file(model));
        words.insert(words.end(), more.begin(), more.end());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        int out[2];
        REQUIRE(pipe(out) == 0);
        process_ = fork();
        if (process_ == 0) {
            dup2(out[1], STDOUT_FILENO);
            close(out[0]);
            close(out[1]);
            execv(pointers[0], pointers.data());
            _exit(127);
        }
        close(out[1]);
        pollfd said{.fd = out[0], .events = POLLIN, .revents = 0};
        char ready = 0;
        const bool is_ready = poll(&said, 1, 10000) == 1 && read(out[0], &ready, 1) == 1;
        close(out[0]);
        if (!is_ready) {
            end();
            throw std::runtime_error("SKIPPED: FUSE is not to be had here: the fake nodes could not be mounted");
        }
        connect();
    }
    ~FakeRobot() {
        close(socket_);
        end();
    }
    FakeRobot(const FakeRobot&) = delete;
    FakeRobot& operator=(const FakeRobot&) = delete;

    static std::string robot_file(const std::string& model) {
        return source_root() + "/engine/robots/" + model + ".lua";
    }
    /// The socket of its rig.
    std::string socket_path() const { return folder.path("socket").string(); }
    std::string mount() const { return folder.path("nodes").string(); }

    /// Its answer to a command (tests/fakes).
    std::string say(const std::string& command) {
        const std::string line = command + "\n";
        REQUIRE(send(socket_, line.data(), line.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(line.size()));
        std::string answer;
        char buffer[4096];
        while (answer != ".\n" && !answer.ends_with("\n.\n")) {
            const ssize_t length = recv(socket_, buffer, sizeof buffer, 0);
            REQUIRE(length > 0);
            answer.append(buffer, static_cast<std::size_t>(length));
        }
        answer.resize(answer.size() - 2);
        if (!answer.empty()) answer.pop_back();
        return answer;
    }
    void fault(const std::string& node, const std::string& what) { REQUIRE(say("fault " + node + " " + what).empty()); }

    Pose2D truth() {
        Pose2D pose;
        std::istringstream(say("truth")) >> pose.position.x >> pose.position.y >> pose.heading;
        return pose;
    }
    /// All successful writes, as "rtled0 '1'".
    std::vector<std::string> writes() {
        std::vector<std::string> all;
        std::istringstream lines(say("log"));
        for (std::string time, node, text, result; lines >> time >> node >> text >> result;)
            all.push_back(node + " " + text);
        return all;
    }
    /// Waits until `is_so` returns true; returns false after this time [s].
    static bool wait_until(const std::function<bool()>& is_so, double seconds) {
        const double end = clock_seconds() + seconds;
        while (!is_so()) {
            if (clock_seconds() > end) return false;
            sleep_for(0.001);
        }
        return true;
    }

    const Scratch folder;

private:
    void connect() {
        socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::strncpy(address.sun_path, socket_path().c_str(), sizeof address.sun_path - 1);
        REQUIRE(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
    }
    void end() {
        kill(process_, SIGTERM);  // it unmounts its files, unless a call hangs
        if (wait_until([this] { return waitpid(process_, nullptr, WNOHANG) == process_; }, 1)) return;
        umount2(mount().c_str(), MNT_DETACH);
        kill(process_, SIGKILL);  // calls that hang in its files end with the connection to the kernel
        waitpid(process_, nullptr, 0);
    }

    pid_t process_ = 0;
    int socket_ = -1;
};

inline RobotSpec shipped_spec(const std::string& model) {
    const std::string file = FakeRobot::robot_file(model);
    auto spec = read_robot_file(file, Project::of(file));
    if (!spec) FAIL(describe(spec.error()));
    return *spec;
}

/// A system with only this robot at 100 ticks per second in real time, driven by the test.
struct DrivenRobot {
    DrivenRobot(RobotSpec its_spec, const DeviceRoots& roots)
        : spec(std::move(its_spec)),
          system({.rate = 100, .real_time = true}, [this](const LogLine& line) { log.push_back(line.text); }) {
        auto body = hw::drivers(roots).at(spec.hardware.driver)({}, spec);
        if (!body) FAIL(describe(body.error()));
        auto made = Robot::make("driven", spec, spec.drive.hardware_limits);
        REQUIRE(made);
        robot = made->get();
        robot->take_body(std::move(*body));
        REQUIRE(system.add(std::move(*made)));
        REQUIRE(robot->activate(system.now()));
    }
    /// Runs for this time [s] or until `until` returns true, with this velocity as the command of every tick.
    bool run(double seconds, Velocity2D velocity = {}, const std::function<bool()>& until = nullptr) {
        return tick_for(seconds, &velocity, until);
    }
    /// The same without commands.
    bool idle(double seconds, const std::function<bool()>& until = nullptr) {
        return tick_for(seconds, nullptr, until);
    }
    InPort<Velocity2D>& velocity_in() {
        for (const PortSpec& port : spec.ports) {
            if (port.is_input && port.items.front() == "drive")
                return static_cast<InPort<Velocity2D>&>(*robot->find_in_port(port.name));
        }
        throw std::runtime_error("no port for velocities");
    }
    std::string all_log() const {
        std::string all;
        for (const auto& line : log) all += line + "\n";
        return all;
    }
    template <class T>
    const T& published(std::string_view port) const {
        return static_cast<const OutPort<T>*>(robot->find_out_port(port))->read();
    }
    /// True if the port has published within the last 0.1 s.
    bool speaks(std::string_view port) const { return system.now().seconds - robot->find_out_port(port)->tm() < 0.1; }
    bool said(const std::string& part) const {
        return std::any_of(log.begin(), log.end(), [&](const auto& line) { return line.find(part) != line.npos; });
    }

    RobotSpec spec;
    std::vector<std::string> log;
    System system;
    Robot* robot = nullptr;

private:
    bool tick_for(double seconds, const Velocity2D* velocity, const std::function<bool()>& until) {
        return run_paced(system, seconds, until, [&] {
            if (velocity != nullptr) velocity_in().inject(*velocity);
        });
    }
};

}  // namespace nezumi::hw
