// Components of other programs for browsers: queries their state while a browser shows them, and passes requests on.
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

/// Functions that reach the components of other programs. They return immediately.
struct PeerSource {
    /// Queries the state of the components, as a JSON object for the page. An invalid future: this system has no such
    /// components.
    std::function<std::future<std::string>()> look{};
    PeerAsker ask{};
};

/// Used by the ticking thread.
class PeerDesk {
public:
    using Clock = std::chrono::steady_clock;
    using Answer = std::function<void(ClientId client, std::int64_t id, const Expected<void>& done)>;

    /// The time between two queries of the components.
    static constexpr std::chrono::seconds period{1};
    /// The largest number of requests that wait for an answer.
    static constexpr std::size_t most_waiting = 16;

    PeerDesk(PeerSource source, Answer answer) : source_(std::move(source)), answer_(std::move(answer)) {}

    /// Passes a request on; it is answered later.
    Expected<void> ask(ClientId client, std::int64_t id, const PeerRequest& request);
    /// Whether it is time to query the components, if a browser shows them.
    bool is_due(Clock::time_point now) const { return source_.look && !look_.valid() && now >= next_; }
    /// Answers requests, and begins a query if `is_watched`. Returns the new state for the browsers; nothing if it is
    /// unchanged.
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
