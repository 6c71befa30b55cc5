// A thread in which an act is prepared, for who has none that may wait.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <thread>

#include "engine/live/prepared_act.hpp"

namespace nezumi {

/// One act at a time. All of it is to be called from one thread.
class ActWorker {
public:
    ActWorker() = default;
    /// Waits a second for the thread: what hangs in a file that does not answer goes on without this.
    ~ActWorker();
    ActWorker(const ActWorker&) = delete;
    ActWorker& operator=(const ActWorker&) = delete;

    /// Whether no act is being prepared, nor waits to be taken.
    bool is_idle() const { return !prepared_.valid(); }
    /// Begins with an act, while idle. Where the system gives no further thread, the act is prepared before this
    /// returns.
    void start(Preparation prepare);
    /// The act, once it is prepared: waits so long for it.
    std::optional<PreparedAct> take(std::chrono::microseconds patience = {});

private:
    std::future<PreparedAct> prepared_;
    std::thread thread_;
};

}  // namespace nezumi
