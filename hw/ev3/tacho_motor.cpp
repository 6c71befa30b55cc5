// The order of writes for ev3dev: a setting takes effect with the next command.
#include "hw/ev3/tacho_motor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nezumi::hw {

using Access = Node::Access;

TachoMotor::Nodes::Nodes(const DevicePath& folder)
    : command(folder + "/command", Access::write),
      speed(folder + "/speed_sp", Access::write),
      target(folder + "/position_sp", Access::write),
      time(folder + "/time_sp", Access::write),
      after_stop(folder + "/stop_action", Access::write),
      position(folder + "/position", Access::read),
      state(folder + "/state", Access::read) {}

TachoMotor::TachoMotor(const DevicePath& folder, std::string driver, std::string port)
    : class_(folder), driver_(std::move(driver)), port_(std::move(port)) {}

tl::expected<void, std::string> TachoMotor::find() {
    nodes_.reset();
    const auto folder = class_.find(driver_, port_);
    if (!folder) return tl::unexpected(folder.error());
    Node fastest(*folder + "/max_speed", Access::read), turn(*folder + "/count_per_rot", Access::read);
    const auto speed = read_whole_number(fastest), pulses = read_whole_number(turn);
    if (!speed) return tl::unexpected(speed.error());
    if (!pulses) return tl::unexpected(pulses.error());
    nodes_.emplace(*folder);
    for (Node* node : {&nodes_->command, &nodes_->speed, &nodes_->time, &nodes_->after_stop}) {
        if (auto ok = node->open(); !ok) {
            nodes_.reset();
            return tl::unexpected(with_ev3_advice(ok.error()));
        }
    }
    folder_ = *folder;
    fastest_ = static_cast<int>(*speed);
    pulses_per_turn_ = static_cast<int>(std::max(1LL, *pulses));
    after_stop_ = AfterStop::unknown;
    counts_anew_ = true;
    return {};
}

// If one access to a motor fails, its other nodes are no longer used.
std::string TachoMotor::give_up(const std::string& why) {
    static_cast<void>(nodes_->command.write("stop"));
    nodes_.reset();
    return fmt::format("{}: {}", port_, why);
}

tl::expected<void, std::string> TachoMotor::write(Node& node, const std::string& text) {
    if (auto ok = node.write(text); !ok) return tl::unexpected(give_up(with_ev3_advice(ok.error())));
    return {};
}

tl::expected<void, std::string> TachoMotor::set_after_stop(AfterStop wanted) {
    if (after_stop_ == wanted) return {};
    after_stop_ = AfterStop::unknown;
    if (auto ok = write(nodes_->after_stop, wanted == AfterStop::hold ? "hold" : "coast"); !ok) return ok;
    after_stop_ = wanted;
    return {};
}

tl::expected<void, std::string> TachoMotor::prepare() {
    if (auto ok = coast(); !ok) return ok;
    // Sets these, because other programs may have changed them. A ramp would lengthen the braking distance.
    for (const auto& [name, text] : {std::pair("ramp_up_sp", "0"), {"ramp_down_sp", "0"}, {"polarity", "normal"}}) {
        Node node(folder_ + "/" + name, Access::write);
        if (auto ok = write(node, text); !ok) return ok;
    }
    return write(nodes_->time, std::to_string(std::lround(dead_man * 1e3)));
}

tl::expected<void, std::string> TachoMotor::run(int rate) {
    if (auto ok = set_after_stop(AfterStop::hold); !ok) return ok;
    if (auto ok = write(nodes_->speed, std::to_string(std::clamp(rate, -fastest_, fastest_))); !ok) return ok;
    return write(nodes_->command, "run-timed");
}

tl::expected<void, std::string> TachoMotor::go_to(std::int64_t position, int rate) {
    if (auto ok = set_after_stop(AfterStop::hold); !ok) return ok;
    const int speed = rate > 0 ? std::min(rate, fastest_) : fastest_;
    if (auto ok = write(nodes_->speed, std::to_string(speed)); !ok) return ok;
    if (auto ok = write(nodes_->target, std::to_string(position - offset_)); !ok) return ok;
    return write(nodes_->command, "run-to-abs-pos");
}

// Uses the command "stop", because speed 0 would switch the power off instead of holding the motor.
tl::expected<void, std::string> TachoMotor::hold() {
    if (auto ok = set_after_stop(AfterStop::hold); !ok) return ok;
    return write(nodes_->command, "stop");
}

tl::expected<void, std::string> TachoMotor::coast() {
    if (auto ok = set_after_stop(AfterStop::coast); !ok) return ok;
    return write(nodes_->command, "stop");
}

bool TachoMotor::is_stalled() {
    if (!nodes_) return false;
    const auto words = nodes_->state.read();
    return words && (words->find("stalled") != words->npos || words->find("overloaded") != words->npos);
}

tl::expected<std::int64_t, std::string> TachoMotor::position() {
    const auto read = read_whole_number(nodes_->position);
    if (!read) return tl::unexpected(give_up(read.error()));
    if (std::exchange(counts_anew_, false)) offset_ = last_ - *read;
    last_ = *read + offset_;
    return last_;
}

}  // namespace nezumi::hw
