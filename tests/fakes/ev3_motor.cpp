// Strict as the kernel: a speed beyond the fastest, or a position while it runs, is refused.
#include "tests/fakes/ev3_motor.hpp"

#include <cerrno>
#include <charconv>
#include <cstdlib>

namespace nezumi::fakes {
namespace {

std::string_view without_newline(std::string_view text) {
    if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    return text;
}

std::optional<int> number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

const std::map<std::string, std::string> as_made{{"duty_cycle_sp", "0"},   {"polarity", "normal"}, {"position_sp", "0"},
                                                 {"ramp_down_sp", "0"},    {"ramp_up_sp", "0"},    {"speed_sp", "0"},
                                                 {"stop_action", "coast"}, {"time_sp", "0"}};

}  // namespace

void Ev3Motor::plug_in(double now) {
    set_ = as_made;
    mode_ = Mode::roll;
    zero_ = turned_;
    until_ = 0;
    stopped_at_ = now;
}

void Ev3Motor::stop(double at) {
    if (mode_ == Mode::run || mode_ == Mode::go) stopped_at_ = at;
    mode_ = set_["stop_action"] == "coast" ? Mode::roll : Mode::hold;
    until_ = 0;
}

void Ev3Motor::settle(double now) {
    if (mode_ == Mode::run && until_ > 0 && now >= until_) stop(until_);
}

int Ev3Motor::command(std::string_view text, double now) {
    const auto of = [this](const char* name) { return *number(set_[name]); };
    if (text == "stop") {
        stop(now);
    } else if (text == "reset") {
        set_ = as_made;
        stop(now);
        zero_ = turned_;
    } else if (text == "run-forever" || text == "run-timed") {
        rate_ = of("speed_sp");
        until_ = text == "run-timed" ? now + of("time_sp") * 1e-3 : 0;
        mode_ = rate_ == 0 ? Mode::roll : Mode::run;  // no power is not standing
    } else if (text == "run-to-abs-pos" || text == "run-to-rel-pos") {
        rate_ = std::abs(of("speed_sp"));
        goal_ = of("position_sp") + (text == "run-to-rel-pos" ? turned_ - zero_ : 0);
        mode_ = Mode::go;
    } else {
        return -EINVAL;
    }
    return 0;
}

int Ev3Motor::write(const std::string& attribute, std::string_view text, double now) {
    settle(now);
    text = without_newline(text);
    if (attribute == "command") return command(text, now);
    if (attribute == "stop_action") {
        if (text != "coast" && text != "brake" && text != "hold") return -EINVAL;
    } else if (attribute == "polarity") {
        if (text != "normal" && text != "inversed") return -EINVAL;
    } else if (attribute == "position") {
        if (mode_ == Mode::run || mode_ == Mode::go) return -EBUSY;
        const auto value = number(text);
        if (!value) return -EINVAL;
        zero_ = turned_ - *value;
        return 0;
    } else {
        const auto value = number(text);
        if (!value) return -EINVAL;
        if (attribute == "speed_sp" && std::abs(*value) > fastest_) return -EINVAL;
        if ((attribute == "time_sp" || attribute.starts_with("ramp")) && *value < 0) return -EINVAL;
    }
    if (!set_.contains(attribute)) return -EACCES;
    set_[attribute] = text;
    return 0;
}

std::optional<std::string> Ev3Motor::read(const std::string& attribute, double now) {
    settle(now);
    if (attribute == "position") return std::to_string(turned_ - zero_) + "\n";
    if (attribute == "max_speed") return std::to_string(fastest_) + "\n";
    if (attribute == "count_per_rot") return "360\n";
    if (attribute == "state")
        return mode_ == Mode::run || mode_ == Mode::go ? "running\n" : mode_ == Mode::hold ? "holding\n" : "\n";
    const auto found = set_.find(attribute);
    if (found == set_.end()) return std::nullopt;
    return found->second + "\n";
}

}  // namespace nezumi::fakes
