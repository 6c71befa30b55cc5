// A loss and a return are told at the moment they happen, and not again.
#include "hw/device/health.hpp"

#include <iterator>
#include <utility>

namespace nezumi::hw {

void Health::lost(const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(is_lost_, true)) lines_.push_back(device_ + ": " + why);
}

void Health::works() {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_lost_, false)) lines_.push_back(device_ + ": back again");
}

bool Health::is_lost() const {
    const std::lock_guard lock(mutex_);
    return is_lost_;
}

std::vector<std::string> Health::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(lines_, {});
}

void append(std::vector<std::string>& lines, std::vector<std::string> more) {
    lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace nezumi::hw
