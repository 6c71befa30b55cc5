// A component that does not answer delays each query of the components by seconds. Then the queries are made less
// often, so that requests do not wait for them.
#include "bindings/web/peer_desk.hpp"

#include <algorithm>
#include <utility>

namespace nezumi::web {
namespace {

template <class T>
bool is_ready(const std::future<T>& future) {
    return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

Expected<void> PeerDesk::ask(ClientId client, std::int64_t id, const PeerRequest& request) {
    if (!source_.ask) return failure("this program can't reach RTCs: use `nezumi run`");
    if (waiting_.size() >= most_waiting) return failure("too many requests are already waiting");
    waiting_.push_back({client, id, source_.ask(request)});
    return {};
}

std::optional<std::string> PeerDesk::serve(bool is_watched, Clock::time_point now) {
    std::erase_if(waiting_, [&](Waiting& each) {
        if (!is_ready(each.answer)) return false;
        const auto text = each.answer.get();
        answer_(each.client, each.id, text ? Expected<void>() : Unexpected(text.error()));
        next_ = now;  // queries the components now, so that the change is shown immediately
        return true;
    });
    if (look_.valid()) {
        if (!is_ready(look_)) return std::nullopt;
        next_ = std::max(next_, now + std::max<Clock::duration>(period, now - asked_at_));
        std::string seen = look_.get();
        if (seen == shown_) return std::nullopt;
        shown_ = seen;
        return seen;
    }
    if (!is_watched || !is_due(now)) return std::nullopt;
    asked_at_ = now;
    look_ = source_.look();
    if (!look_.valid()) next_ = now + period;
    return std::nullopt;
}

}  // namespace nezumi::web
