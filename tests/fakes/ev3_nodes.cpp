// ev3dev's answers, and the errors of what is unplugged.
#include "tests/fakes/ev3_nodes.hpp"

#include <fmt/format.h>
#include <linux/input.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "engine/base/list.hpp"

namespace nezumi::fakes {
namespace {

constexpr const char* motor_class = "sys/class/tacho-motor";
constexpr const char* sensor_class = "sys/class/lego-sensor";

const std::vector<std::string> motor_attributes{"address",  "command",  "count_per_rot", "driver_name",  "max_speed",
                                                "polarity", "position", "position_sp",   "ramp_down_sp", "ramp_up_sp",
                                                "speed_sp", "state",    "stop_action",   "time_sp"};
const std::vector<std::string> sensor_attributes{"address",    "decimals", "driver_name", "mode",  "modes",
                                                 "num_values", "value0",   "value1",      "value2"};
const std::vector<std::string> ev3_faults{"none", "missing", "denied", "eio", "timeout", "hang", "garbage"};

}  // namespace

Ev3Nodes::Ev3Nodes() {
    const auto motor = [&](const char* port, const char* driver, int fastest) {
        devices_.push_back({.port = port, .driver = driver, .motor = Ev3Motor(fastest), .number = next_number_++});
        devices_.back().motor->plug_in(clock_now());
    };
    const auto sensor = [&](const char* port, const char* driver, std::size_t channel = 0) {
        devices_.push_back(
            {.port = port, .driver = driver, .sensor = Ev3Sensor(driver, channel), .number = next_number_++});
    };
    motor("outA", "lego-ev3-m-motor", 1560);
    motor("outB", "lego-ev3-l-motor", 1050);
    motor("outC", "lego-ev3-l-motor", 1050);
    sensor("in1", "lego-ev3-touch", 1);
    sensor("in2", "lego-ev3-gyro");
    sensor("in3", "lego-ev3-touch", 0);
    sensor("in4", "lego-ev3-us");
    sensor("in5", "lego-ev3-color");  // a port that no brick has, so that one fake has every sensor
    const auto plain = [&](const std::string& path, const std::string& node, const std::string& text) {
        plain_path_[path] = node;
        plain_[node] = text;
    };
    plain("sys/class/power_supply/lego-ev3-battery/voltage_now", "battery", "7900000\n");
    plain("sys/class/power_supply/lego-ev3-battery/voltage_min_design", "battery_least", "6200000\n");
    plain("sys/class/graphics/fb0/bits_per_pixel", "bits_per_pixel", "32\n");
    plain("sys/class/graphics/fb0/stride", "stride", "712\n");
    plain("dev/fb0", "fb0", "");
    plain("dev/input/by-path/platform-gpio_keys-event", "keys", "");
    for (const char* led : {"led0:red", "led0:green", "led1:red", "led1:green"})
        plain(fmt::format("sys/class/leds/{}:brick-status/brightness", led), led, "0\n");
}

std::vector<std::string> Ev3Nodes::names() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> all;
    for (const Device& device : devices_) {
        if (!device.is_there) continue;
        for (const std::string& attribute : device.motor ? motor_attributes : sensor_attributes)
            all.push_back(device.motor ? fmt::format("{}/motor{}/{}", motor_class, device.number, attribute)
                                       : fmt::format("{}/sensor{}/{}", sensor_class, device.number, attribute));
    }
    for (const auto& [path, node] : plain_path_) all.push_back(path);
    return all;
}

std::vector<std::string> Ev3Nodes::folders() const { return {motor_class, sensor_class}; }

Ev3Nodes::Device* Ev3Nodes::device_at(const std::string& port) {
    const auto found =
        std::find_if(devices_.begin(), devices_.end(), [&](const Device& device) { return device.port == port; });
    return found == devices_.end() ? nullptr : &*found;
}

std::optional<Ev3Nodes::Place> Ev3Nodes::find(const std::string& name) {
    if (const auto plain = plain_path_.find(name); plain != plain_path_.end()) return Place{nullptr, plain->second, ""};
    const std::size_t slash = name.rfind('/');
    if (slash == name.npos) return std::nullopt;
    const std::string folder = name.substr(0, slash), attribute = name.substr(slash + 1);
    for (Device& device : devices_) {
        const std::string its_folder = device.motor ? fmt::format("{}/motor{}", motor_class, device.number)
                                                    : fmt::format("{}/sensor{}", sensor_class, device.number);
        const auto& attributes = device.motor ? motor_attributes : sensor_attributes;
        if (folder == its_folder && contains(attributes, attribute))
            return Place{&device, device.port + "/" + attribute, attribute};
    }
    return std::nullopt;
}

int Ev3Nodes::look(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto place = find(name);
    if (!place || (place->device != nullptr && !place->device->is_there)) return -ENOENT;
    return faults_[place->node] == "missing" ? -ENOENT : 0;
}

// Whether a call may go on, after what its fault makes of it.
int Ev3Nodes::enter(std::unique_lock<std::mutex>& lock, const std::string& name, std::optional<std::uint64_t> handle,
                    Place& place) {
    const auto found = find(name);
    // Its number is another now, or none.
    if (!found) return handle ? -ENODEV : -ENOENT;
    place = *found;
    changed_.wait(lock, [&] { return faults_[place.node] != "hang"; });
    const std::string& fault = faults_[place.node];
    if (place.device != nullptr && !place.device->is_there) return handle ? -ENODEV : -ENOENT;
    if (fault == "missing") return handle ? -ENODEV : -ENOENT;
    if (fault == "denied" && !handle) return -EACCES;
    if (fault == "eio" && handle) return -EIO;
    return 0;
}

int Ev3Nodes::open(const std::string& name, std::uint64_t& handle) {
    std::unique_lock lock(mutex_);
    Place place;
    handle = 0;
    return enter(lock, name, std::nullopt, place);
}

std::optional<std::string> Ev3Nodes::say(const Place& place, double now) {
    if (place.device == nullptr) return plain_[place.node];
    const Device& device = *place.device;
    if (place.attribute == "driver_name") return device.driver + "\n";
    if (place.attribute == "address") return "ev3-ports:" + device.port + "\n";
    if (device.sensor) return device.sensor->read(place.attribute, around_, now);
    return place.device->motor->read(place.attribute, now);
}

int Ev3Nodes::read(const std::string& name, std::uint64_t handle, std::string& text) {
    std::unique_lock lock(mutex_);
    Place place;
    if (const int error = enter(lock, name, handle, place); error != 0) return error;
    const auto said = say(place, clock_now());
    if (!said) return -EACCES;
    text = faults_[place.node] == "garbage" ? "what?\n" : *said;
    return 0;
}

int Ev3Nodes::write(const std::string& name, std::uint64_t handle, std::string_view text) {
    std::unique_lock lock(mutex_);
    Place place;
    int result = enter(lock, name, handle, place);
    const double now = clock_now();
    if (result == 0 && faults_[place.node] == "timeout") result = -ETIMEDOUT;
    if (result == 0 && place.device != nullptr) {
        if (place.device->motor) {
            result = place.device->motor->write(place.attribute, text, now);
        } else if (place.attribute == "mode") {
            lock.unlock();
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
            lock.lock();
            result = place.device->is_there ? place.device->sensor->set_mode(text, clock_now()) : -ENODEV;
        } else {
            result = -EACCES;
        }
    } else if (result == 0) {
        plain_[place.node] = text;
    }
    if (result == 0) result = static_cast<int>(text.size());
    if (place.node != "fb0") log_.push_back({now, place.node, std::string(text), result});
    return result;
}

int Ev3Nodes::control(const std::string& name, std::uint64_t handle, unsigned request, void* data) {
    std::unique_lock lock(mutex_);
    Place place;
    if (const int error = enter(lock, name, handle, place); error != 0) return error;
    if (place.node != "keys" || _IOC_TYPE(request) != 'E' || _IOC_NR(request) != _IOC_NR(EVIOCGKEY(0))) return -ENOTTY;
    const std::size_t size = _IOC_SIZE(request);
    std::memset(data, 0, size);
    for (const unsigned code : pressed_) {
        if (code / 8 < size)
            static_cast<unsigned char*>(data)[code / 8] |= static_cast<unsigned char>(1U << (code % 8));
    }
    return static_cast<int>(size);
}

bool Ev3Nodes::press(const std::string& key, bool pressed) {
    const std::map<std::string, unsigned> codes{{"up", KEY_UP},       {"down", KEY_DOWN},   {"left", KEY_LEFT},
                                                {"right", KEY_RIGHT}, {"enter", KEY_ENTER}, {"back", KEY_BACKSPACE}};
    const auto code = codes.find(key);
    if (code == codes.end()) return false;
    const std::lock_guard lock(mutex_);
    if (pressed) {
        pressed_.insert(code->second);
    } else {
        pressed_.erase(code->second);
    }
    return true;
}

bool Ev3Nodes::set_fault(const std::string& node, const std::string& fault) {
    const std::lock_guard lock(mutex_);
    const bool is_node = plain_.contains(node) || device_at(node.substr(0, node.find('/'))) != nullptr;
    if (!is_node || !contains(ev3_faults, fault)) return false;
    faults_[node] = fault;
    changed_.notify_all();
    return true;
}

void Ev3Nodes::heal() {
    const std::lock_guard lock(mutex_);
    for (auto& [node, fault] : faults_) fault = "none";
    changed_.notify_all();
}

bool Ev3Nodes::unplug(const std::string& port) {
    const std::lock_guard lock(mutex_);
    Device* device = device_at(port);
    if (device == nullptr || !device->is_there) return false;
    device->is_there = false;
    // Without its cable it has no power.
    if (device->motor) {
        device->motor->write("stop_action", "coast", clock_now());
        device->motor->write("command", "stop", clock_now());
    }
    return true;
}

bool Ev3Nodes::plug_in(const std::string& port) {
    const std::lock_guard lock(mutex_);
    Device* device = device_at(port);
    if (device == nullptr || device->is_there) return false;
    device->is_there = true;
    device->number = next_number_++;
    if (device->motor) device->motor->plug_in(clock_now());
    if (device->sensor) device->sensor->plug_in(around_);
    return true;
}

bool Ev3Nodes::set_mode(const std::string& port, const std::string& mode) {
    const std::lock_guard lock(mutex_);
    Device* device = device_at(port);
    return device != nullptr && device->sensor && device->sensor->set_mode(mode, clock_now()) == 0;
}

void Ev3Nodes::set_battery(int microvolts) {
    const std::lock_guard lock(mutex_);
    plain_["battery"] = fmt::format("{}\n", microvolts);
}

void Ev3Nodes::set_floor(const std::array<int, 3>& raw) {
    const std::lock_guard lock(mutex_);
    around_.floor = raw;
}

Ev3Nodes::Motion Ev3Nodes::motion() {
    const std::lock_guard lock(mutex_);
    const double now = clock_now();
    Ev3Motor &left = *device_at("outB")->motor, &right = *device_at("outC")->motor, &arm = *device_at("outA")->motor;
    Motion motion{.left = left.rate(now),
                  .right = right.rate(now),
                  .left_rolls = left.mode(now) == Ev3Motor::Mode::roll,
                  .right_rolls = right.mode(now) == Ev3Motor::Mode::roll,
                  .arm = std::nullopt};
    if (arm.mode(now) == Ev3Motor::Mode::go) motion.arm = {arm.goal(), arm.pace()};
    if (motion.left == 0 && motion.right == 0)
        motion.still_since = std::max(left.stopped_at(now), right.stopped_at(now));
    return motion;
}

void Ev3Nodes::set_turned(std::int64_t left, std::int64_t right, std::int64_t arm) {
    const std::lock_guard lock(mutex_);
    device_at("outB")->motor->set_turned(left);
    device_at("outC")->motor->set_turned(right);
    device_at("outA")->motor->set_turned(arm);
}

void Ev3Nodes::set_around(double distance, double angle, double rate, bool right, bool left) {
    const std::lock_guard lock(mutex_);
    around_.distance = distance;
    around_.angle = angle;
    around_.rate = rate;
    around_.touched = {right, left};
}

std::vector<Write> Ev3Nodes::log() const {
    const std::lock_guard lock(mutex_);
    return log_;
}

std::string Ev3Nodes::frame() const {
    const std::lock_guard lock(mutex_);
    return plain_.at("fb0");
}

std::string Ev3Nodes::leds() const {
    const std::lock_guard lock(mutex_);
    std::string all;
    for (const char* led : {"led0:red", "led0:green", "led1:red", "led1:green"})
        all += plain_.at(led).starts_with("0") ? '0' : '1';
    return all;
}

}  // namespace nezumi::fakes
