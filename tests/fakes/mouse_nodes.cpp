// rtmouse's answers: errors, short writes, how long a reading takes, what shares a PWM channel.
#include "tests/fakes/mouse_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <thread>

#include "engine/base/list.hpp"

namespace nezumi::fakes {
namespace {

const std::vector<std::string> node_names{"rtbuzzer0",    "rtcounter_l0",   "rtcounter_l1",   "rtcounter_r0",
                                          "rtcounter_r1", "rtled0",         "rtled1",         "rtled2",
                                          "rtled3",       "rtlightsensor0", "rtmotor_raw_l0", "rtmotor_raw_r0",
                                          "rtmotoren0",   "rtswitch0",      "rtswitch1",      "rtswitch2"};

const std::vector<std::string> mouse_faults{"none", "missing", "denied", "eio",    "enodev",
                                            "hang", "zeros",   "tear",   "frozen", "garbage"};

bool has(const std::string& name, std::string_view part) { return name.find(part) != std::string::npos; }

// How long the driver takes for one reading [s].
double reading_time(const std::string& name) {
    if (has(name, "lightsensor")) return 0.0026;
    if (has(name, "counter")) return 0.0012;
    if (has(name, "switch")) return 0.004;
    return 0;
}

// As the kernel's kstrtoint: digits and a sign, one newline at the end at most.
std::optional<int> kernel_number(std::string_view text) {
    if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

MouseNodes::MouseNodes() {
    for (const std::string& name : node_names) nodes_[name].fault = "none";
}

std::vector<std::string> MouseNodes::names() const { return node_names; }

int MouseNodes::look(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto node = nodes_.find(name);
    return node == nodes_.end() || node->second.fault == "missing" ? -ENOENT : 0;
}

// Whether a call may go on, after what its fault makes of it.
int MouseNodes::enter(std::unique_lock<std::mutex>& lock, const std::string& name,
                      std::optional<std::uint64_t> handle) {
    const auto node = nodes_.find(name);
    if (node == nodes_.end()) return -ENOENT;
    const std::string& fault = node->second.fault;
    changed_.wait(lock, [&] { return fault != "hang"; });
    if (fault == "missing") return handle ? -ENODEV : -ENOENT;
    if (fault == "denied" && !handle) return -EACCES;
    if (fault == "enodev" || (handle && *handle != module_)) return -ENODEV;
    if (fault == "eio" && handle) return -EIO;
    return 0;
}

int MouseNodes::open(const std::string& name, std::uint64_t& handle) {
    std::unique_lock lock(mutex_);
    if (const int error = enter(lock, name, std::nullopt); error != 0) return error;
    handle = module_;
    if (has(name, "counter")) is_signed_ = name.back() == '1';
    return 0;
}

int MouseNodes::read(const std::string& name, std::uint64_t handle, std::string& text) {
    std::this_thread::sleep_for(std::chrono::duration<double>(reading_time(name)));
    std::unique_lock lock(mutex_);
    if (const int error = enter(lock, name, handle); error != 0) return error;
    text = say(name, clock_now());
    return 0;
}

int MouseNodes::write(const std::string& name, std::uint64_t handle, std::string_view text) {
    std::unique_lock lock(mutex_);
    int result = enter(lock, name, handle);
    const double now = clock_now();
    if (result == 0) result = take(name, text, now);
    log_.push_back({now, name, std::string(text), result});
    return result;
}

int MouseNodes::take(const std::string& name, std::string_view text, double now) {
    const int whole = static_cast<int>(text.size());
    if (has(name, "rtled") || name == "rtmotoren0") {
        if (text.empty() || (text.front() != '0' && text.front() != '1')) return -EINVAL;
        const bool on = text.front() == '1';
        if (name != "rtmotoren0") {
            leds_[static_cast<std::size_t>(name.back() - '0')] = on;
        } else {
            if (power_ && !on) power_off_at_ = now;
            power_ = on;
        }
        return 1;
    }
    if (name == "rtbuzzer0") {
        const auto hertz = kernel_number(text);
        if (!hertz) return -EINVAL;
        tone_ = *hertz == 0 ? 0 : std::clamp(*hertz, 1, 20000);
        // The channel is the right motor's.
        if (right_.rate(now) != 0) right_.write(tone_, now);
        return whole;
    }
    if (has(name, "rtmotor_raw")) {
        const auto rate = kernel_number(text);
        if (!rate) return -EINVAL;
        tone_ = 0;
        const int taken = std::abs(*rate) < 5 ? 0 : std::clamp(*rate, -10000, 10000);
        (name == "rtmotor_raw_l0" ? left_ : right_).write(taken, now);
        return whole;
    }
    return -EINVAL;
}

int MouseNodes::counter(PwmChannel& channel, std::int64_t unsigned_zero, std::int64_t signed_zero, double now) const {
    if (!is_signed_) return static_cast<int>((channel.pulses(now) - unsigned_zero) & 0xFFFF);
    return static_cast<int>((channel.balance(now) - signed_zero) % 32768);
}

std::string MouseNodes::say(const std::string& name, double now) {
    Node& node = nodes_[name];
    const std::uint64_t readings = node.readings++;
    if (node.fault == "frozen" && !node.said.empty()) return node.said;
    if (node.fault == "garbage") return "what?\n";
    if (has(name, "lightsensor")) {
        if (node.fault == "zeros") return "0 0 0 0\n";
        // Ambient light flickers: a count or two around the value, also below 0.
        const auto noise = [&](std::uint64_t channel) {
            return static_cast<int>((readings * 7 + channel * 3) % 5) - 2;
        };
        node.said = fmt::format("{} {} {} {}\n", lights_[0] + noise(0), lights_[1] + noise(1), lights_[2] + noise(2),
                                lights_[3] + noise(3));
    } else if (has(name, "switch")) {
        node.said = pressed_[static_cast<std::size_t>(name.back() - '0')] ? "0\n" : "1\n";
    } else if (has(name, "counter")) {
        const bool is_left = has(name, "_l");
        int count = is_left ? counter(left_, left_zero_, left_signed_zero_, now)
                            : counter(right_, right_zero_, right_signed_zero_, now);
        if (node.fault == "zeros") count = 0;
        if (node.fault == "tear" && readings % 7 == 0) count = (count + 256) & 0xFFFF;
        node.said = fmt::format("{}\n", count);
    } else {
        node.said = "0\n";
    }
    return node.said;
}

bool MouseNodes::set_fault(const std::string& node, const std::string& fault) {
    const std::lock_guard lock(mutex_);
    const auto found = nodes_.find(node);
    if (found == nodes_.end() || !contains(mouse_faults, fault)) return false;
    found->second.fault = fault;
    changed_.notify_all();
    return true;
}

void MouseNodes::reload() {
    const std::lock_guard lock(mutex_);
    const double now = clock_now();
    ++module_;
    left_.write(0, now);
    right_.write(0, now);
    left_zero_ = left_.pulses(now);
    right_zero_ = right_.pulses(now);
    left_signed_zero_ = left_.balance(now);
    right_signed_zero_ = right_.balance(now);
    is_signed_ = false;
    power_ = true;
    tone_ = 0;
    leds_ = {};
}

void MouseNodes::open_signed() {
    const std::lock_guard lock(mutex_);
    is_signed_ = true;
}

void MouseNodes::set_counters(std::uint16_t number) {
    const std::lock_guard lock(mutex_);
    const double now = clock_now();
    left_zero_ = left_.pulses(now) - number;
    right_zero_ = right_.pulses(now) - number;
}

void MouseNodes::set_lights(const std::array<int, 4>& values) {
    const std::lock_guard lock(mutex_);
    lights_ = values;
}

void MouseNodes::press(std::size_t button, bool pressed) {
    const std::lock_guard lock(mutex_);
    pressed_.at(button) = pressed;
}

MouseNodes::Motion MouseNodes::motion() {
    const std::lock_guard lock(mutex_);
    const double now = clock_now();
    Motion motion{.power = power_, .tone = tone_, .leds = {}, .still_since = std::nullopt};
    motion.leds.assign(leds_.begin(), leds_.end());
    if (power_) {
        motion.left = left_.rate(now);
        motion.right = right_.rate(now);
    }
    const auto left = left_.still_since(now), right = right_.still_since(now);
    if (left && right) motion.still_since = std::max(*left, *right);
    if (!power_) motion.still_since = std::min(power_off_at_, motion.still_since.value_or(power_off_at_));
    return motion;
}

std::vector<Write> MouseNodes::log() const {
    const std::lock_guard lock(mutex_);
    return log_;
}

void MouseNodes::clear_log() {
    const std::lock_guard lock(mutex_);
    log_.clear();
}

}  // namespace nezumi::fakes
