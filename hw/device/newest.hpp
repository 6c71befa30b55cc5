// Passes the newest value from one thread to another.
#pragma once

#include <cstdint>
#include <utility>

#include "engine/base/mutex.hpp"

namespace nezumi::hw {

/// The newest command, and whether it is new since it was last taken.
template <class T>
class Newest {
public:
    void put(T value) {
        const std::lock_guard lock(mutex_);
        value_ = std::move(value);
        ++count_;
    }
    struct Taken {
        T value;
        bool is_new;  ///< since it was last taken
    };
    Taken take() {
        const std::lock_guard lock(mutex_);
        return {value_, count_ != std::exchange(taken_, count_)};
    }

private:
    Mutex mutex_;  // held only for a copy
    T value_{};
    std::uint64_t count_ = 0, taken_ = 0;
};

}  // namespace nezumi::hw
