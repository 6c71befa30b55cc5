// Requests and answers are lines. An answer is valid for the whole tick.
#include "hw/rig/rig_world.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <sstream>
#include <utility>

#include "engine/system/build_system.hpp"

namespace nezumi::hw {
namespace {

constexpr timeval longest_answer{.tv_sec = 1, .tv_usec = 0};

// The connection to the observer of one robot.
class Witness {
public:
    static Expected<Witness> connect(const std::string& robot, std::vector<std::string> sensors,
                                     const std::string& path) {
        const auto refuse = [&](std::string_view why) {
            return failure(fmt::format("--rig: {}: {}: {}", robot, shown(path), why));
        };
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        if (path.size() >= sizeof address.sun_path) return refuse("the path is too long for a socket");
        std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
        Witness made(robot, std::move(sensors), socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
        setsockopt(made.socket_, SOL_SOCKET, SO_RCVTIMEO, &longest_answer, sizeof longest_answer);
        if (::connect(made.socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
            return refuse(std::strerror(errno));  // NOLINT(concurrency-mt-unsafe): before there are threads
        return made;
    }
    ~Witness() {
        if (socket_ >= 0) close(socket_);
    }
    Witness(Witness&& other) noexcept
        : robot_(std::move(other.robot_)),
          sensors_(std::move(other.sensors_)),
          socket_(std::exchange(other.socket_, -1)) {}
    Witness& operator=(Witness&&) = delete;
    Witness(const Witness&) = delete;
    Witness& operator=(const Witness&) = delete;

    // Sends a request. Returns the answer without its last line, the dot.
    Expected<std::string> ask(const std::string& line) {
        const std::string text = line + "\n";
        if (send(socket_, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size())) return lost();
        std::string answer;
        char buffer[1024];
        while (answer != ".\n" && !answer.ends_with("\n.\n")) {
            const ssize_t length = recv(socket_, buffer, sizeof buffer, 0);
            if (length <= 0) return lost();
            answer.append(buffer, static_cast<std::size_t>(length));
        }
        answer.resize(answer.size() - 2);
        if (!answer.empty()) answer.pop_back();
        return answer;
    }
    const std::string& robot() const { return robot_; }
    const std::string& sensor(std::size_t index) const { return sensors_[index]; }

    // The answers of this tick.
    std::optional<Truth> truth{};
    std::optional<std::string> touched{};

private:
    Witness(std::string robot, std::vector<std::string> sensors, int socket)
        : robot_(std::move(robot)), sensors_(std::move(sensors)), socket_(socket) {}
    Unexpected lost() const { return failure(fmt::format("the rig of '{}' does not answer", robot_)); }

    std::string robot_;
    std::vector<std::string> sensors_;  // of its model
    int socket_;
};

class RigWorld final : public World {
public:
    explicit RigWorld(std::vector<Witness> witnesses) : witnesses_(std::move(witnesses)) {}

    Expected<std::unique_ptr<RobotBody>> add_robot(const std::string& name, const RobotSpec& /*spec*/,
                                                   Pose2D /*pose*/) override {
        return failure(fmt::format("{}: a rig can't add robots", name));
    }
    void step(int /*count*/) override {
        for (Witness& witness : witnesses_) {
            witness.truth.reset();
            witness.touched.reset();
        }
    }
    const Error* breakdown() const override { return breakdown_ ? &*breakdown_ : nullptr; }

    Truth truth(RobotId robot) const override {
        Witness& witness = witnesses_[robot];
        if (witness.truth) return *witness.truth;
        Truth truth;
        std::istringstream numbers(ask(witness, "truth"));
        if (!(numbers >> truth.pose.position.x >> truth.pose.position.y >> truth.pose.heading >> truth.velocity.vx >>
              truth.velocity.vy >> truth.velocity.va >> truth.height >> truth.tilt))
            break_down(fmt::format("the rig of '{}' answered '{}': expected eight numbers for 'truth'", witness.robot(),
                                   shown(numbers.str())));
        return *(witness.truth = truth);
    }
    bool collided(RobotId robot) const override { return !collided_with(robot).empty(); }
    std::string collided_with(RobotId robot) const override {
        Witness& witness = witnesses_[robot];
        if (!witness.touched) witness.touched = ask(witness, "touched");
        return *witness.touched;
    }
    Expected<void> teleport(RobotId robot, Pose2D pose) override {
        witnesses_[robot].truth.reset();
        return tell(robot, fmt::format("place {} {} {}", pose.position.x, pose.position.y, pose.heading));
    }
    void disturb(RobotId robot, const VelocityConstraint& constraint) override {
        const auto text = [](const std::optional<double>& speed) { return speed ? fmt::to_string(*speed) : "-"; };
        must(tell(robot,
                  fmt::format("disturb {} {} {}", text(constraint.vx), text(constraint.vy), text(constraint.va))));
    }
    void press(RobotId robot, std::size_t sensor, bool pressed) override {
        must(tell(robot, fmt::format("press {} {}", witnesses_[robot].sensor(sensor), pressed ? 1 : 0)));
    }
    std::vector<ThingPose> things() const override { return {}; }
    std::vector<Ray> rays(RobotId /*robot*/) const override { return {}; }

private:
    void break_down(std::string why) const {
        if (!breakdown_) breakdown_ = Error{std::move(why), {}};
    }
    void must(const Expected<void>& done) const {
        if (!done) break_down(done.error().message);
    }
    std::string ask(Witness& witness, const std::string& line) const {
        if (breakdown_) return "";
        auto answer = witness.ask(line);
        if (answer) return std::move(*answer);
        break_down(answer.error().message);
        return "";
    }
    Expected<void> tell(RobotId robot, const std::string& line) {
        const std::string answer = ask(witnesses_[robot], line);
        if (answer.empty()) return {};
        return failure(fmt::format("the rig of '{}': {}", witnesses_[robot].robot(), answer));
    }

    mutable std::vector<Witness> witnesses_;
    mutable std::optional<Error> breakdown_;
};

}  // namespace

Expected<Rig> open_rig(const SystemSpec& spec, const std::map<std::string, std::string>& sockets) {
    Rig rig;
    std::vector<Witness> witnesses;
    std::vector<Pose2D> poses;
    std::vector<std::vector<std::size_t>> buttons;  // of each robot, by sensor
    for (const RobotEntry* robot : entries_of<RobotEntry>(spec)) {
        const auto path = sockets.find(robot->name);
        if (path == sockets.end() || !robot->is_real()) continue;
        std::vector<std::string> sensors;
        std::vector<std::size_t> pressed;
        for (const SensorSpec& sensor : spec.models.at(robot->described_by()).sensors) {
            if (sensor.kind == SensorSpec::Kind::button || sensor.kind == SensorSpec::Kind::touch)
                pressed.push_back(sensors.size());
            sensors.push_back(sensor.name);
        }
        buttons.push_back(std::move(pressed));
        auto witness = Witness::connect(robot->name, std::move(sensors), path->second);
        if (!witness) return Unexpected(witness.error());
        witnesses.push_back(std::move(*witness));
        rig.robots.push_back(robot->name);
        poses.push_back(robot->pose);
    }
    if (witnesses.empty()) return rig;
    rig.world = std::make_unique<RigWorld>(std::move(witnesses));
    for (RobotId id = 0; id < poses.size(); ++id) {
        rig.world->disturb(id, {});
        for (const std::size_t button : buttons[id]) rig.world->press(id, button, false);
        if (auto placed = rig.world->teleport(id, poses[id]); !placed) return Unexpected(placed.error());
        rig.world->collided(id);  // clears earlier contacts
        if (const Error* why = rig.world->breakdown()) return Unexpected(*why);
    }
    rig.world->step(0);
    return rig;
}

}  // namespace nezumi::hw
