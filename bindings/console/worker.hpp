// A thread that works for one session, and its connection to the ticking thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <thread>

#include "engine/base/descriptor.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi {

/// Wakes the ticking thread: workers ring the bell when they need that thread, which waits for the bell while idle.
class Bell {
public:
    using Clock = std::chrono::steady_clock;

    Bell();
    void ring() const;
    /// Resets the bell. Call it before you serve all requests.
    void clear() const;
    /// Waits until the bell rings, the file `also` is readable, a signal comes, or `until`. Returns whether there may
    /// be something to do.
    bool wait(Clock::time_point until, int also = -1) const;

private:
    Descriptor file_;  // eventfd
};

/// Runs one job at a time. A job never touches the system: it asks the ticking thread, which does the work between two
/// ticks. The ticking thread never waits for a job, except for the end of its thread.
class Worker {
public:
    using Clock = std::chrono::steady_clock;
    /// A function that the ticking thread runs for a job between two ticks. False: call it again at the next occasion.
    using Work = std::function<bool()>;

    /// [bytes] of posts that may wait; beyond this the job waits.
    static constexpr std::size_t most_posted = std::size_t{256} << 10;
    /// Jobs have a thread of their own, in which they may wait for ticks. Without one (bindings/wasm) a job that waits
    /// ends with `start_again`.
    static const bool has_thread;

    /// The bell must live until `close`.
    explicit Worker(const Bell& bell);
    /// Call this only after `join` has returned true. A worker with a running thread must never be destroyed.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    // For the ticking thread, between two ticks:

    /// Starts a job. Only while idle, and before `close`.
    void start(std::function<void()> job);
    /// Whether no job runs.
    bool is_idle() const;
    /// Does what the job has asked for, in order, until about `until`. If `takes_more` is given and returns false,
    /// stops there; the job waits.
    void serve(Clock::time_point until, const std::function<bool()>& takes_more = {});
    /// The `until` of the running `serve`, for the work that it runs.
    Clock::time_point until() const { return until_; }
    /// Runs only posted work.
    void serve_posts();
    /// Stops the job soon: work that it asks for is no longer done, and its calls into Lua end as at a time limit.
    void revoke();
    /// Stops the job soon and ends the thread, with `last` as its last work.
    void close(std::function<void()> last);
    /// After `close`: whether the thread has ended.
    bool has_ended() const;
    /// After `close`: waits for the end of the thread, at most until `until`. Returns whether it has ended.
    bool join(Clock::time_point until);

    // For a job:

    /// Sets the next job, which starts at the next occasion. Call it only without threads, as the last call of a job.
    void start_again(std::function<void()> job);
    /// Whether this is the thread of the worker.
    bool is_here() const { return std::this_thread::get_id() == thread_.get_id(); }
    /// Asks for work without waiting for it, unless too many posts wait.
    void post(std::size_t bytes, std::function<void()> work);
    /// Asks for work and waits for it. Its time counts as time of the job. Returns false if the job was stopped; then
    /// the work is not done.
    bool perform(const Work& work);

private:
    struct Post {
        std::size_t bytes;
        std::function<void()> work;
    };

    void run();
    void drop_all();  // call it with the lock held
    void ring();      // call it with the lock held
    bool serve_post(Lock& lock);

    mutable Mutex mutex_;  // of all members below except stop_ and thread_
    std::condition_variable wake_;
    const Bell* bell_;
    std::function<void()> job_;
    std::function<void()> last_;
    std::deque<Post> posts_;
    std::size_t posted_ = 0;       // [bytes] in posts_
    const Work* asked_ = nullptr;  // done after all posts; its job waits
    std::int64_t spent_ = 0;       // [ns] that the asked work has taken
    bool running_ = false;
    bool revoked_ = false;
    bool closed_ = false;
    bool ended_ = false;
    std::atomic<bool> stop_ = false;  // ends calls into Lua
    Clock::time_point until_{};       // of the ticking thread
    std::thread thread_;
};

}  // namespace nezumi
