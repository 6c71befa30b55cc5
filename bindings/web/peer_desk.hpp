// Components of other programs for browsers: looks at them while a browser shows them, and passes requests on.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "bindings/console/peers.hpp"
#include "bindings/web/site.hpp"

namespace nezumi::web {

/// How other programs' components are reached. None of the functions waits.
struct PeerSource {
    /// Asks for a JSON object for the page. An invalid future: this system has none.
    std::function<std::future<std::string>()> look{};
    PeerAsker ask{};
};

/// Used by the ticking thread.
class PeerDesk {
public:
    using Clock = std::chrono::steady_clock;
    using Answer = std::function<void(ClientId client, std::int64_t id, const Expected<void>& done)>;

    /// Between two looks.
    static constexpr std::chrono::seconds period{1};
    /// Requests that wait for an answer.
    static constexpr std::size_t most_waiting = 16;

    PeerDesk(PeerSource source, Answer answer) : source_(std::move(source)), answer_(std::move(answer)) {}

    /// Passes a request on; it is answered later.
    Expected<void> ask(ClientId client, std::int64_t id, const PeerRequest& request);
    /// Whether a look could begin now, if a browser shows the components.
    bool is_due(Clock::time_point now) const { return source_.look && !look_.valid() && now >= next_; }
    /// Answers requests, and begins to look if `is_watched`. Returns what is new for the browsers.
    std::optional<std::string> serve(bool is_watched, Clock::time_point now);

private:
    struct Waiting {
        ClientId client = 0;
        std::int64_t id = 0;
        std::future<Expected<std::string>> answer{};
    };

    PeerSource source_;
    Answer answer_;
    std::vector<Waiting> waiting_;
    std::future<std::string> look_;
    Clock::time_point asked_at_{}, next_{};
    std::string shown_;
};

}  // namespace nezumi::web
