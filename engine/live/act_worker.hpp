// Prepares acts in a thread, for callers that must not wait.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <thread>

#include "engine/live/prepared_act.hpp"

namespace nezumi {

/// Prepares one act at a time. Call all functions from one thread.
class ActWorker {
public:
    ActWorker() = default;
    /// Waits at most 1 s for the thread. A thread that still reads a file then is abandoned.
    ~ActWorker();
    ActWorker(const ActWorker&) = delete;
    ActWorker& operator=(const ActWorker&) = delete;

    /// True if no act is being prepared and none waits for `take`.
    bool is_idle() const { return !prepared_.valid(); }
    /// Starts to prepare an act; `is_idle` must be true. If the operating system provides no further thread, prepares
    /// the act before it returns.
    void start(Preparation prepare);
    /// Waits at most `patience` for the prepared act. Returns nothing if it is not ready then.
    std::optional<PreparedAct> take(std::chrono::microseconds patience = {});

private:
    std::future<PreparedAct> prepared_;
    std::thread thread_;
};

}  // namespace nezumi
