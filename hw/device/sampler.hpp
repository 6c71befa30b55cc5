// A device that is read again and again beside the loop, which gets the newest sample with its time.
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

/// What a device said, and when.
template <class T>
struct Sample {
    T value{};
    double tm = 0;  ///< [s] by `clock_seconds`: the middle of the reading
};

/// After how many seconds without a new sample a device counts as silent.
inline constexpr double stale_after = 0.3;
/// How often [s] a device that failed is tried again.
inline constexpr double retry_period = 0.5;

/// The newest sample, from the thread that reads to the control loop.
template <class T>
class NewestSample {
public:
    void put(Sample<T> sample) {
        const std::lock_guard lock(mutex_);
        sample_ = std::move(sample);
    }
    /// At `now`, by `clock_seconds`; none when there is no recent one.
    std::optional<Sample<T>> at(double now) const {
        const std::lock_guard lock(mutex_);
        if (!sample_ || now - sample_->tm > stale_after) return std::nullopt;
        return sample_;
    }

private:
    mutable Mutex mutex_;  // held for a copy at most
    std::optional<Sample<T>> sample_;
};

/// Who derives from it says how to read the device once.
template <class T>
class Sampler : public DeviceJob {
public:
    /// Reads every `period` [s], or as fast as the device allows when that is slower.
    Sampler(std::string device, double period) : health_(std::move(device)), period_(period) {}

    /// The newest sample at `now`, by `clock_seconds`; none when there is no recent one.
    std::optional<Sample<T>> newest(double now) const { return newest_.at(now); }

    /// A device that has not answered for too long is told as lost.
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
    /// Reads the device once, at `now` by `clock_seconds`: a value, nothing yet, or why not, with what to do.
    virtual tl::expected<std::optional<T>, std::string> sample(double now) = 0;

private:
    Health health_;
    const double period_;
    NewestSample<T> newest_;
};

}  // namespace nezumi::hw
