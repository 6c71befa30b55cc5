// The second system keeps all values since the start, so that the slider can move to any earlier time.
#include "bindings/web/earlier.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bindings/web/remembered_json.hpp"
#include "engine/base/json_text.hpp"

namespace nezumi::web {
namespace {

// The second system ends if it gets no request during this time.
constexpr std::chrono::seconds kept{20};
constexpr std::chrono::milliseconds slice{5};  // of computation while time is paused

}  // namespace

void Earlier::ask_then(ClientId client, double at, const std::vector<std::string>& names) {
    send_(client, json_text(then_to_json(live_.trace(), at, names)));
    Asked asked{.client = client, .names = names, .to = at, .generation = live_.generation()};
    bool has_all = true;
    for (const std::string& name : names) {
        const auto found = live_.trace().remember_part(name);
        if (!found) continue;
        asked.channels.push_back(found->name);
        has_all = has_all && live_.trace().has_since(found->name, at);
    }
    std::erase_if(asked_, [client](const Asked& each) { return each.client == client && each.port.empty(); });
    if (!has_all) asked_.insert(asked_.begin(), std::move(asked));
}

Expected<void> Earlier::ask_port(ClientId client, std::int64_t id, const std::string& port) {
    if (asked_.size() >= most) return failure("too many plots are already waiting");
    const auto found = live_.trace().remember_part(port);
    if (!found) return Unexpected(found.error());
    asked_.push_back({.client = client,
                      .id = id,
                      .port = port,
                      .channels = {found->name},
                      .to = live_.system().now().seconds,
                      .generation = live_.generation()});
    return {};
}

void Earlier::forget(ClientId client) {
    std::erase_if(asked_, [client](const Asked& each) { return each.client == client; });
}

Expected<void> Earlier::begin(const Asked& asked) {
    if (past_ && past_->extend(live_, asked.channels, 0, asked.to)) return {};
    past_.reset();
    // All waiting plots up to the same time are computed together.
    std::vector<std::string> channels = asked.channels;
    for (const Asked& each : asked_) {
        if (!asked.port.empty() && each.to == asked.to)
            channels.insert(channels.end(), each.channels.begin(), each.channels.end());
    }
    auto past = PastValues::begin(live_, std::move(channels), 0, asked.to);
    if (!past) return Unexpected(past.error());
    past_ = std::move(*past);
    return {};
}

Expected<bool> Earlier::compute(const Asked& asked, Clock::time_point until) {
    if (auto begun = begin(asked); !begun) return Unexpected(begun.error());
    PastRun& run = past_->run();
    return clock_.is_paused() ? run.go_on(std::max(until, Clock::now() + slice)) : run.go_on_beside(until);
}

bool Earlier::serve(Clock::time_point until) {
    std::erase_if(asked_, [&](const Asked& each) {
        const bool is_gone = each.generation != live_.generation();
        if (is_gone && !each.port.empty())
            answer_(each.client, each.id, failure("the system was replaced by a restart or a seek"));
        return is_gone;
    });
    if (asked_.empty()) {
        if (past_ && Clock::now() - used_ > kept) past_.reset();
        return false;
    }
    used_ = Clock::now();
    const std::int64_t before = past_ ? past_->run().system().when().tick : -1;
    const auto there = compute(asked_.front(), until);
    // Whether this call had time for a tick. If not, the computation goes on after the next tick of the present system.
    if (there && !*there) return past_->run().system().when().tick != before;
    const Asked done = std::move(asked_.front());
    asked_.erase(asked_.begin());
    if (there) tell(done);
    if (!there) past_.reset();
    if (!done.port.empty()) answer_(done.client, done.id, there ? Expected<void>() : Unexpected(there.error()));
    return !asked_.empty();
}

void Earlier::tell(const Asked& asked) {
    if (asked.port.empty()) return send_(asked.client, json_text(then_to_json(past_->trace(), asked.to, asked.names)));
    nlohmann::ordered_json json{{"is", "earlier"}};
    add_numbers(json, past_->trace(), asked.port);
    send_(asked.client, json_text(json));
}

}  // namespace nezumi::web
