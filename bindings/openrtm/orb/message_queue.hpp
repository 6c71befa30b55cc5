// The queue of messages for a peer: limited; the oldest is dropped first.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>

#include "bindings/openrtm/orb/velocity_bytes.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {

using Clock = std::chrono::steady_clock;

/// Of velocities only the latest waits. If a velocity was sent to a robot, velocity 0 is sent after `velocity_silence`
/// without a message, and before the connection ends.
class MessageQueue {
public:
    MessageQueue(std::size_t capacity, bool of_velocities)
        : capacity_(of_velocities ? 1 : capacity), of_velocities_(of_velocities) {}

    void put(std::span<const std::uint8_t> message) {
        {
            const std::lock_guard lock(mutex_);
            if (stopped_) return;
            put_with_lock({message.begin(), message.end()});
        }
        changed_.notify_one();
    }
    /// Puts back a message that the peer did not accept, unless a newer one waits.
    void put_back(Bytes message) {
        const std::lock_guard lock(mutex_);
        if (messages_.empty()) messages_.push_back(std::move(message));
    }
    /// Takes the oldest message. Returns false if there is none.
    bool take(Bytes& message) {
        const std::lock_guard lock(mutex_);
        return take_with_lock(message);
    }
    /// Waits for a message. Returns false if no more will come.
    bool wait(Bytes& message) {
        Lock lock(mutex_);
        for (;;) {
            if (ended_) return false;
            if (take_with_lock(message)) return true;
            if (stopped_) return false;
            if (moves_) {
                changed_.wait_until(lock, put_at_ + velocity_silence);
            } else {
                changed_.wait(lock);
            }
        }
    }
    /// Waits until `time`, or until `stop` is called. Returns false if the queue has ended.
    bool wait_until(Clock::time_point time) {
        Lock lock(mutex_);
        changed_.wait_until(lock, time, [this] { return ended_ || stopped_; });
        return !ended_;
    }
    /// Waits until `time`, or until `end` is called.
    void rest_until(Clock::time_point time) {
        Lock lock(mutex_);
        changed_.wait_until(lock, time, [this] { return ended_; });
    }
    /// From now on, new messages are dropped. If a robot may be moving, velocity 0 is sent as the last message.
    void stop() {
        {
            const std::lock_guard lock(mutex_);
            if (std::exchange(stopped_, true)) return;
            if (moves_) put_with_lock(stopped(last_));
        }
        changed_.notify_all();
    }
    /// True if nothing more will be sent.
    bool is_done() {
        const std::lock_guard lock(mutex_);
        return stopped_ && messages_.empty();
    }
    /// Ends all waiting.
    void end() {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        changed_.notify_all();
    }

private:
    void put_with_lock(Bytes message) {
        if (of_velocities_) {
            moves_ = is_motion(message);
            last_ = message;
            put_at_ = Clock::now();
        }
        if (messages_.size() == capacity_) messages_.pop_front();
        messages_.push_back(std::move(message));
    }
    bool take_with_lock(Bytes& message) {
        if (messages_.empty() && moves_ && Clock::now() >= put_at_ + velocity_silence) put_with_lock(stopped(last_));
        if (messages_.empty()) return false;
        message = std::move(messages_.front());
        messages_.pop_front();
        return true;
    }

    const std::size_t capacity_;
    const bool of_velocities_;
    Mutex mutex_;  // for all members below
    std::condition_variable changed_;
    std::deque<Bytes> messages_;
    Bytes last_;                  // for velocities: the last message
    bool moves_ = false;          // the last message is not zero
    Clock::time_point put_at_{};  // time of the last message
    bool stopped_ = false;
    bool ended_ = false;
};

}  // namespace nezumi::openrtm
