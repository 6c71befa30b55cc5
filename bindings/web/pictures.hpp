// Cameras' pictures for browsers: copied between two ticks, encoded beside them, and only while somebody watches.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "engine/base/mutex.hpp"
#include "engine/ports/messages.hpp"
#include "engine/system/system.hpp"

namespace nezumi::web {

class Pictures {
public:
    using Clock = std::chrono::steady_clock;
    /// Takes a whole message for browsers, or why there is none; called in the encoder's thread.
    using Show = std::function<void(const std::string& port, std::string message)>;
    using Fail = std::function<void(const std::string& why)>;

    /// So many a second of each port, at most.
    static constexpr double most = 10;

    Pictures(Show show, Fail fail) : show_(std::move(show)), fail_(std::move(fail)) {}
    ~Pictures();
    Pictures(const Pictures&) = delete;
    Pictures& operator=(const Pictures&) = delete;

    /// Between two ticks: takes what these ports, "name.port", carry that is new. Who has not been encoded yet gives
    /// way to what is newer.
    void look(const System& system, const std::vector<std::string>& ports, Clock::time_point now);

private:
    struct Taken {
        CameraImage image{};
        double tm = 0;
        bool is_new = false;
    };
    struct Seen {
        std::uint64_t count = 0;
        Clock::time_point at{};
    };

    void work();

    Show show_;
    Fail fail_;
    std::map<std::string, Seen, std::less<>> seen_;  // of the thread that ticks
    Mutex mutex_;                                    // of what follows
    std::condition_variable news_;
    std::map<std::string, Taken, std::less<>> taken_;  // by port; an old one is memory for the next
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace nezumi::web
