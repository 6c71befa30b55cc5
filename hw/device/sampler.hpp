// A device that is read periodically on its own thread; the control loop gets the newest sample with its time.
#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "engine/base/mutex.hpp"
#include "hw/device/clock.hpp"
#include "hw/device/health.hpp"
#include "hw/device/worker.hpp"

namespace nezumi::hw {

/// A value of a device and its time.
template <class T>
struct Sample {
    T value{};
    double tm = 0;  ///< [s] by `clock_seconds`: the middle of the reading
};

/// Time [s] without a new sample after which a device counts as silent.
inline constexpr double stale_after = 0.3;
/// Interval [s] at which a failed device is tried again.
inline constexpr double retry_period = 0.5;

/// Passes the newest sample from the reading thread to the control loop.
template <class T>
class NewestSample {
public:
    void put(Sample<T> sample) {
        const std::lock_guard lock(mutex_);
        sample_ = std::move(sample);
    }
    /// The sample at `now` (`clock_seconds`), or nothing if it is not recent.
    std::optional<Sample<T>> at(double now) const {
        const std::lock_guard lock(mutex_);
        if (!sample_ || now - sample_->tm > stale_after) return std::nullopt;
        return sample_;
    }

private:
    mutable Mutex mutex_;  // held only for a copy
    std::optional<Sample<T>> sample_;
};

/// A derived class defines how to read the device once.
template <class T>
class Sampler : public DeviceJob {
public:
    /// Reads every `period` [s], or slower if the device is slower.
    Sampler(std::string device, double period) : health_(std::move(device)), period_(period) {}

    /// The newest sample at `now` (`clock_seconds`), or nothing if it is not recent.
    std::optional<Sample<T>> newest(double now) const { return newest_.at(now); }

    /// Returns new messages; a device that has not answered for too long counts as lost.
    std::vector<std::string> take_faults() {
        if (hangs(clock_seconds())) health_.lost(no_answer);
        return health_.take();
    }

    double run() final {
        const double before = clock_seconds();
        auto value = sample(before);
        const double after = clock_seconds();
        if (!value) {
            health_.lost(value.error());
            return retry_period;
        }
        if (*value) {
            health_.works();
            newest_.put({std::move(**value), (before + after) / 2});
        }
        return before + period_ - after;
    }

protected:
    /// Reads the device once at `now` (`clock_seconds`). Returns a value, nothing yet, or an error with what to do.
    virtual tl::expected<std::optional<T>, std::string> sample(double now) = 0;

private:
    Health health_;
    const double period_;
    NewestSample<T> newest_;
};

}  // namespace nezumi::hw
