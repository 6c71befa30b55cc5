// The order of waiting pupils, and the time of a turn.
#include "bindings/web/classroom/turns.hpp"

#include <algorithm>
#include <utility>

namespace nezumi::web {

std::size_t Turns::place_of(int pupil) const {
    const auto found = std::find(waiting_.begin(), waiting_.end(), pupil);
    return found == waiting_.end() ? 0 : static_cast<std::size_t>(found - waiting_.begin()) + 1;
}

void Turns::set_limit(std::chrono::minutes limit) {
    if (limit >= std::chrono::minutes(1) && limit <= longest_limit) limit_ = limit;
}

Turns::Clock::duration Turns::left(Clock::time_point now) const {
    if (driver_ == 0) return {};
    return std::max(Clock::duration{}, begin_ + limit_ - now);
}

void Turns::enter(int pupil) {
    if (pupil != driver_ && place_of(pupil) == 0) waiting_.push_back(pupil);
}

void Turns::remove(int pupil) { std::erase(waiting_, pupil); }

void Turns::move_up(int pupil) {
    const std::size_t place = place_of(pupil);
    if (place > 1) std::swap(waiting_[place - 1], waiting_[place - 2]);
}

bool Turns::begin(Clock::time_point now) {
    if (driver_ != 0 || waiting_.empty()) return false;
    driver_ = waiting_.front();
    waiting_.pop_front();
    begin_ = now;
    return true;
}

bool Turns::look(Clock::time_point now, const std::function<bool(int pupil)>& is_there) {
    std::erase_if(away_, [&](const Away& each) { return is_there(each.pupil); });
    const auto is_gone = [&](int pupil) {
        if (is_there(pupil)) return false;
        const auto found =
            std::find_if(away_.begin(), away_.end(), [&](const Away& each) { return each.pupil == pupil; });
        if (found != away_.end()) return now - found->since > longest_absence;
        away_.push_back({pupil, now});
        return false;
    };
    std::erase_if(waiting_, is_gone);
    return driver_ != 0 && (is_gone(driver_) || left(now) == Clock::duration{});
}

}  // namespace nezumi::web
