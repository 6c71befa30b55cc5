// The brick's nodes, as ev3dev has them, and what can go wrong with them.
#pragma once

#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/fakes/ev3_motor.hpp"
#include "tests/fakes/ev3_sensor.hpp"
#include "tests/fakes/served_files.hpp"
#include "tests/fakes/write_log.hpp"

namespace nezumi::fakes {

/// Folders "sys" and "dev". Devices are called by their port, "outB", "in3"; each plugging in gives them a new number.
class Ev3Nodes final : public ServedFiles {
public:
    Ev3Nodes();

    std::vector<std::string> names() const override;
    std::vector<std::string> folders() const override;
    int look(const std::string& name) override;
    int open(const std::string& name, std::uint64_t& handle) override;
    int read(const std::string& name, std::uint64_t handle, std::string& text) override;
    int write(const std::string& name, std::uint64_t handle, std::string_view text) override;
    int control(const std::string& name, std::uint64_t handle, unsigned request, void* data) override;

    /// Presses a key of the brick, "enter", or lets it go. False when there is none of this name.
    bool press(const std::string& key, bool pressed);
    /// Of a device's attribute, "outB/command", "in4/value0", or of a node without a device, "battery", "led0:red",
    /// "fb0": "none", "missing" (ENOENT), "denied" (EACCES), "eio", "timeout" (ETIMEDOUT at a write), "hang",
    /// "garbage". False when there is no such node or fault.
    bool set_fault(const std::string& node, const std::string& fault);
    void heal();
    bool unplug(const std::string& port);
    bool plug_in(const std::string& port);
    /// Another program has changed a sensor's mode.
    bool set_mode(const std::string& port, const std::string& mode);
    void set_battery(int microvolts);
    void set_floor(const std::array<int, 3>& raw);

    /// What the motors at outB, outC and outA do.
    struct Motion {
        int left = 0, right = 0;  ///< [pulses/s]
        bool left_rolls = false, right_rolls = false;
        std::optional<std::pair<std::int64_t, int>> arm;  ///< goes to these pulses, at this rate
        double still_since = 0;                           ///< [s]; 0: a wheel is driven
    };
    Motion motion();
    /// How far what they turn has turned [pulses].
    void set_turned(std::int64_t left, std::int64_t right, std::int64_t arm);
    void set_around(double distance, double angle, double rate, bool right, bool left);

    std::vector<Write> log() const;
    std::string frame() const;
    std::string leds() const;  ///< '1' of each that is on

private:
    struct Device {
        std::string port, driver;
        std::optional<Ev3Motor> motor;
        std::optional<Ev3Sensor> sensor;
        int number = 0;
        bool is_there = true;
    };
    // A name taken apart: the device and its attribute, or a node of its own.
    struct Place {
        Device* device = nullptr;
        std::string node;  // as for `set_fault`
        std::string attribute;
    };
    std::optional<Place> find(const std::string& name);
    Device* device_at(const std::string& port);
    int enter(std::unique_lock<std::mutex>& lock, const std::string& name, std::optional<std::uint64_t> handle,
              Place& place);
    std::optional<std::string> say(const Place& place, double now);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Device> devices_;
    std::map<std::string, std::string> plain_;       // node: what it holds
    std::map<std::string, std::string> plain_path_;  // path: node
    std::map<std::string, std::string> faults_;      // node: fault
    std::vector<Write> log_;
    Ev3Surroundings around_;
    std::set<unsigned> pressed_;  // codes of keys
    int next_number_ = 0;
};

}  // namespace nezumi::fakes
