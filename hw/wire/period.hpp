// Times for a device that is read once per period.
#pragma once

#include <algorithm>

namespace nezumi::hw {

class Period {
public:
    /// `every`: the period [s].
    explicit Period(double every) : every_(every) {}

    /// True if the device must be read at `now` [s]; then the next period begins. After a stall, missed periods are
    /// skipped.
    bool is_due(double now) {
        if (now < next_) return false;
        next_ = now - next_ < every_ ? next_ + every_ : now + every_;
        return true;
    }
    /// [s] until the next period.
    double left(double now) const { return std::max(0.0, next_ - now); }

private:
    double every_, next_ = 0;
};

}  // namespace nezumi::hw
