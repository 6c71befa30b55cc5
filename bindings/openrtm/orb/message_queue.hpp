// Messages that wait for a peer: bounded, the oldest goes first when there are too many.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {

using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;

class MessageQueue {
public:
    explicit MessageQueue(std::size_t capacity) : capacity_(capacity) {}

    void put(std::span<const std::uint8_t> message) {
        {
            const std::lock_guard lock(mutex_);
            if (messages_.size() == capacity_) messages_.pop_front();
            messages_.emplace_back(message.begin(), message.end());
        }
        changed_.notify_one();
    }
    /// The oldest one. Returns whether there was one.
    bool take(Bytes& message) {
        const std::lock_guard lock(mutex_);
        return take_with_lock(message);
    }
    /// Waits for one. Returns false when the queue has ended.
    bool wait(Bytes& message) {
        Lock lock(mutex_);
        changed_.wait(lock, [this] { return ended_ || !messages_.empty(); });
        return !ended_ && take_with_lock(message);
    }
    /// Waits for the time alone. Returns false when the queue has ended.
    bool wait_until(Clock::time_point time) {
        Lock lock(mutex_);
        changed_.wait_until(lock, time, [this] { return ended_; });
        return !ended_;
    }
    void end() {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        changed_.notify_all();
    }

private:
    bool take_with_lock(Bytes& message) {
        if (messages_.empty()) return false;
        message = std::move(messages_.front());
        messages_.pop_front();
        return true;
    }

    const std::size_t capacity_;
    Mutex mutex_;  // of all below
    std::condition_variable changed_;
    std::deque<Bytes> messages_;
    bool ended_ = false;
};

}  // namespace nezumi::openrtm
