// The newest value that one thread has for another.
#pragma once

#include <cstdint>
#include <utility>

#include "engine/base/mutex.hpp"

namespace nezumi::hw {

/// Commands: who takes one knows whether it is new.
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
        bool is_new;  ///< since it was taken last
    };
    Taken take() {
        const std::lock_guard lock(mutex_);
        return {value_, count_ != std::exchange(taken_, count_)};
    }

private:
    Mutex mutex_;  // held for a copy at most
    T value_{};
    std::uint64_t count_ = 0, taken_ = 0;
};

}  // namespace nezumi::hw
