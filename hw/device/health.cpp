// Reports a loss immediately, and a recovery when it has lasted.
#include "hw/device/health.hpp"

#include <iterator>
#include <utility>

namespace nezumi::hw {

void Health::lost(const std::string& why) {
    const std::lock_guard lock(mutex_);
    is_lost_ = true;
    well_since_.reset();
    if (!std::exchange(is_told_, true)) lines_.push_back(prefix_ + why);
}

void Health::works(double now) {
    const std::lock_guard lock(mutex_);
    is_lost_ = false;
    if (!well_since_) well_since_ = now;
}

bool Health::is_lost() const {
    const std::lock_guard lock(mutex_);
    return is_lost_;
}

std::vector<std::string> Health::take(double now) {
    const std::lock_guard lock(mutex_);
    if (is_told_ && well_since_ && now - *well_since_ >= proven_after) {
        is_told_ = false;
        lines_.push_back(prefix_ + "back again");
    }
    return std::exchange(lines_, {});
}

void append(std::vector<std::string>& lines, std::vector<std::string> more) {
    lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace nezumi::hw
