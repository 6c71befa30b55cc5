// Prepares acts in a thread, for callers that must not wait.
#pragma once

#include <chrono>
#include <future>
#include <optional>
#include <thread>

#include "engine/live/prepared_act.hpp"

namespace nezumi {

/// One act at a time. Call all functions from one thread.
class ActWorker {
public:
    ActWorker() = default;
    /// Waits a second for the thread. If it hangs in a file, it is abandoned.
    ~ActWorker();
    ActWorker(const ActWorker&) = delete;
    ActWorker& operator=(const ActWorker&) = delete;

    /// Whether no act is being prepared or waits to be taken.
    bool is_idle() const { return !prepared_.valid(); }
    /// Starts to prepare an act, while idle. If the system provides no further thread, the act is prepared before this
    /// returns.
    void start(Preparation prepare);
    /// Waits at most `patience` for the prepared act. Returns nothing if it is not ready then.
    std::optional<PreparedAct> take(std::chrono::microseconds patience = {});

private:
    std::future<PreparedAct> prepared_;
    std::thread thread_;
};

}  // namespace nezumi
