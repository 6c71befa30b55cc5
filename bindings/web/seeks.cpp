// Handles one request at a time: while a person moves the slider of time, only the last request counts.
#include "bindings/web/seeks.hpp"

#include <algorithm>
#include <utility>

namespace nezumi::web {

Expected<void> Seeks::begin(ClientId client, std::int64_t id, const Actor& who, const Seek& where) {
    auto begun = live_.begin_seek(where);
    if (!begun) return Unexpected(begun.error());
    if (past_) answer_(client_, id_, {});  // answers the old request, which the new one replaces
    clock_.pause();
    client_ = client;
    id_ = id;
    who_ = who;
    past_ = std::move(*begun);
    return {};
}

bool Seeks::serve(PastRun::Clock::time_point until) {
    constexpr std::chrono::milliseconds least{2};
    if (past_ == nullptr) return false;
    const auto there = past_->go_on(std::max(until, PastRun::Clock::now() + least));
    if (there && !*there) return true;
    const std::unique_ptr<PastRun> past = std::move(past_);
    Expected<void> done;
    if (!there) {
        done = Unexpected(there.error());
    } else if (const auto gone = live_.commit(*past, who_); !gone) {
        done = Unexpected(gone.error());
    }
    answer_(client_, id_, done);
    return false;
}

}  // namespace nezumi::web
