// A thread that works for one session, and its way to the thread that ticks.
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

/// Rung by workers when one of them wants something: what the thread that ticks waits for while it has nothing to do.
class Bell {
public:
    using Clock = std::chrono::steady_clock;

    Bell();
    void ring() const;
    /// Forgets that it has rung: before everything that wants something is served.
    void clear() const;
    /// Waits until it rings, the file `also` is readable, a signal comes, or `until`. Returns whether there may be
    /// something to do.
    bool wait(Clock::time_point until, int also = -1) const;

private:
    Descriptor file_;  // eventfd
};

/// One job runs at a time. It never touches the system: what it wants of it, it asks the thread that ticks for, which
/// does so in its own time, between two ticks. Nobody ever waits for a job but for the end of the thread.
class Worker {
public:
    using Clock = std::chrono::steady_clock;
    /// What is done for a job between two ticks. Returns false to be asked again in the next turn.
    using Work = std::function<bool()>;

    /// [bytes] that a job may have posted and nobody has taken: then it waits.
    static constexpr std::size_t most_posted = std::size_t{256} << 10;

    /// The bell must live until `close`.
    explicit Worker(const Bell& bell);
    /// Only when `join` has returned true. A worker whose thread goes on must never be destroyed.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    // From the thread that ticks, between two ticks:

    /// Begins a job. Only while idle, and before `close`.
    void start(std::function<void()> job);
    /// No job runs.
    bool is_idle() const;
    /// Does what the job has asked for, in its order, until about `until`, and no more once `takes_more`, where there
    /// is one, says no: then the job waits.
    void serve(Clock::time_point until, const std::function<bool()>& takes_more = {});
    /// Does what was posted, and nothing else.
    void serve_posts();
    /// Ends the job, soon: nothing of it gets through from now on, and calls into Lua end as those out of time do.
    void revoke();
    /// The same, and the thread ends, with `last` as its last work.
    void close(std::function<void()> last);
    /// After `close`: the thread is at its end.
    bool has_ended() const;
    /// After `close`: waits for the end of the thread, until `until` at most. Returns whether it has come.
    bool join(Clock::time_point until);

    // From within a job:

    /// This thread is the worker's.
    bool is_here() const { return std::this_thread::get_id() == thread_.get_id(); }
    /// Has something done, and does not wait for it unless too much waits already.
    void post(std::size_t bytes, std::function<void()> work);
    /// Has something done and waits for it. Its time counts as the job's own. Returns false when the job is revoked: it
    /// is not done then.
    bool perform(const Work& work);

private:
    struct Post {
        std::size_t bytes;
        std::function<void()> work;
    };

    void run();
    void drop_all();  // with the lock
    void ring();      // with the lock
    bool serve_post(Lock& lock);

    mutable Mutex mutex_;  // of all below but stop_ and thread_
    std::condition_variable wake_;
    const Bell* bell_;
    std::function<void()> job_;
    std::function<void()> last_;
    std::deque<Post> posts_;
    std::size_t posted_ = 0;       // [bytes] in posts_
    const Work* asked_ = nullptr;  // after all posts: its job waits
    std::int64_t spent_ = 0;       // [ns] on what was asked
    bool running_ = false;
    bool revoked_ = false;
    bool closed_ = false;
    bool ended_ = false;
    std::atomic<bool> stop_ = false;  // ends calls into Lua
    std::thread thread_;
};

}  // namespace nezumi
