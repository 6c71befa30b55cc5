// A list in the order of beginning.
#include "bindings/scenario/faults.hpp"

#include <utility>

#include "bindings/scenario/expectation.hpp"

namespace nezumi {

void Faults::begin(std::string key, double now, double seconds, std::function<void()> end) {
    std::erase_if(faults_, [&](const Fault& fault) { return fault.key == key; });
    faults_.push_back({std::move(key), now + seconds, std::move(end)});
}

void Faults::end_due(double now) {
    for (std::size_t i = 0; i < faults_.size();) {
        if (faults_[i].until > now + time_tolerance) {
            ++i;
            continue;
        }
        const Fault over = std::move(faults_[i]);
        faults_.erase(faults_.begin() + static_cast<std::ptrdiff_t>(i));
        over.end();
    }
}

std::size_t Faults::restore(std::string_view key) {
    std::vector<Fault> ending;
    for (std::size_t i = 0; i < faults_.size();) {
        const std::string& own = faults_[i].key;
        // "robot 0 mouse" is the key of the robot, "robot 0 mouse press right" that of one thing done to it.
        const bool meant = own == key || (own.starts_with(key) && own[key.size()] == ' ');
        if (!meant) {
            ++i;
            continue;
        }
        ending.push_back(std::move(faults_[i]));
        faults_.erase(faults_.begin() + static_cast<std::ptrdiff_t>(i));
    }
    for (const Fault& fault : ending) fault.end();
    return ending.size();
}

}  // namespace nezumi
