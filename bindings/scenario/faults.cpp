// Keeps the faults in a list, in the order of their begin.
#include "bindings/scenario/faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bindings/scenario/expectation.hpp"

namespace nezumi {

void Faults::begin(std::string key, double now, double seconds, Effect effect) {
    if (std::isinf(seconds)) forget(key);
    faults_.push_back({std::move(key), now + seconds, std::move(effect)});
}

void Faults::lies_under(std::string key, std::function<void()> put) {
    faults_.push_back({std::move(key), std::numeric_limits<double>::infinity(), {.put = std::move(put)}, false});
}

Faults::Fault Faults::take(std::size_t index) {
    Fault taken = std::move(faults_[index]);
    faults_.erase(faults_.begin() + static_cast<std::ptrdiff_t>(index));
    return taken;
}

Faults::Fault* Faults::last_of(std::string_view key) {
    const auto found =
        std::find_if(faults_.rbegin(), faults_.rend(), [&](const Fault& each) { return each.key == key; });
    return found != faults_.rend() ? &*found : nullptr;
}

// Ends the effect of `over`, which was the latest fault of its key and is no longer in the list.
void Faults::go_on_without(const Fault& over) {
    if (over.effect.is_there && !over.effect.is_there()) return forget(over.key);
    const Fault* before = last_of(over.key);
    if (before == nullptr) return over.effect.undo();
    before->effect.put();
    if (!before->is_fault) forget(over.key);
}

void Faults::end_due(double now) {
    for (std::size_t i = 0; i < faults_.size();) {
        if (faults_[i].until > now + time_tolerance) {
            ++i;
            continue;
        }
        const bool is_last = last_of(faults_[i].key) == &faults_[i];
        const Fault over = take(i);
        if (is_last) go_on_without(over);
    }
}

std::size_t Faults::restore(std::string_view key) {
    std::vector<Fault> ending;  // the latest of each key
    std::size_t count = 0;
    for (std::size_t i = faults_.size(); i-- > 0;) {
        const std::string& own = faults_[i].key;
        // "robot 0 mouse" is the key of the robot, "robot 0 mouse press right" the key of one of its faults.
        const bool meant = own == key || (own.starts_with(key) && own[key.size()] == ' ');
        if (!meant || !faults_[i].is_fault) continue;
        ++count;
        const auto is_same = [&](const Fault& other) { return other.key == own; };
        const bool is_last = std::none_of(ending.begin(), ending.end(), is_same);
        Fault over = take(i);
        if (is_last) ending.push_back(std::move(over));
    }
    for (const Fault& fault : ending) go_on_without(fault);
    return count;
}

void Faults::forget(std::string_view key) {
    std::erase_if(faults_, [&](const Fault& fault) { return fault.key == key; });
}

bool Faults::forget_under(std::string_view key) {
    return std::erase_if(faults_, [&](const Fault& fault) { return fault.key == key && !fault.is_fault; }) > 0;
}

bool Faults::has(std::string_view key) const {
    return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& fault) { return fault.key == key; });
}

}  // namespace nezumi
