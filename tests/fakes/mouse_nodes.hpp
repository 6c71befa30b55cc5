// The nodes of the mouse's driver (rtmouse), as its source has them behave, and what can go wrong with them.
#pragma once

#include <array>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/fakes/pwm_channel.hpp"
#include "tests/fakes/served_files.hpp"
#include "tests/fakes/write_log.hpp"

namespace nezumi::fakes {

class MouseNodes final : public ServedFiles {
public:
    MouseNodes();

    std::vector<std::string> names() const override;
    int look(const std::string& name) override;
    int open(const std::string& name, std::uint64_t& handle) override;
    int read(const std::string& name, std::uint64_t handle, std::string& text) override;
    int write(const std::string& name, std::uint64_t handle, std::string_view text) override;

    /// "none", "missing" (ENOENT), "denied" (EACCES), "eio", "enodev", "hang", "zeros", "tear" (every 7th reading of a
    /// counter is 256 off), "frozen" (says the same for ever), "garbage". False when there is no such node or fault.
    bool set_fault(const std::string& node, const std::string& fault);
    /// The driver's module has been loaded again: handles are void, counters at 0, motors enabled.
    void reload();
    /// Another program has opened the signed counters.
    void open_signed();
    /// The counters stand at this number now.
    void set_counters(std::uint16_t number);

    void set_lights(const std::array<int, 4>& values);
    void press(std::size_t button, bool pressed);

    struct Motion {
        int left = 0, right = 0;  ///< [pulses/s] that the motors follow: 0 without power
        bool power = false;
        int tone = 0;  ///< [Hz]
        std::vector<bool> leds;
        std::optional<double> still_since;  ///< [s] by the monotonic clock; nothing while a wheel is driven
    };
    Motion motion();

    std::vector<Write> log() const;
    void clear_log();

private:
    struct Node {
        std::string fault;
        std::uint64_t readings = 0;
        std::string said;
    };
    int enter(std::unique_lock<std::mutex>& lock, const std::string& name, std::optional<std::uint64_t> handle);
    int take(const std::string& name, std::string_view text, double now);
    int counter(PwmChannel& channel, std::int64_t unsigned_zero, std::int64_t signed_zero, double now) const;
    std::string say(const std::string& name, double now);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::string, Node> nodes_;
    std::vector<Write> log_;
    std::uint64_t module_ = 1;  // counts how often it was loaded
    PwmChannel left_, right_;
    bool power_ = true;
    double power_off_at_ = 0;
    int tone_ = 0;
    std::array<bool, 4> leds_{};
    std::array<bool, 3> pressed_{};
    std::array<int, 4> lights_{};
    bool is_signed_ = false;
    std::int64_t left_zero_ = 0, right_zero_ = 0;  // pulses at which the counters were 0
    std::int64_t left_signed_zero_ = 0, right_signed_zero_ = 0;
};

}  // namespace nezumi::fakes
