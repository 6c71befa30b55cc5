// Finds what has changed since a browser last got the state. Each part has the number of the state in which it last
// changed; each browser has the number of the last state it got.
#include "bindings/web/changes.hpp"

#include <tuple>
#include <utility>

namespace nezumi::web {

template <class T>
void Changes::merge(std::vector<Dated<T>>& known, std::vector<T>&& news) {
    // If the number of items has changed, all items count as new.
    if (known.size() != news.size()) known.clear();
    for (std::size_t i = 0; i < news.size(); ++i) {
        if (i < known.size() && known[i].value == news[i]) continue;
        if (i == known.size()) known.emplace_back();
        known[i] = {std::move(news[i]), sequence_};
        changed_ = sequence_;
    }
}

void Changes::take(State&& state) {
    ++sequence_;
    if (layout_ != state.layout) {
        layout_ = state.layout;
        changed_ = sequence_;
        robots_.clear();
        things_.clear();
        markers_.clear();
        rays_.clear();
        ports_.clear();
        members_.clear();
    }
    std::vector<std::vector<WebRay>> rays;
    for (WebRay& ray : state.now.rays) {
        if (rays.size() <= ray.robot) rays.resize(ray.robot + 1);
        rays[ray.robot].push_back(ray);
    }
    merge(robots_, std::exchange(state.now.robots, {}));
    merge(things_, std::exchange(state.now.things, {}));
    merge(markers_, std::exchange(state.now.markers, {}));
    merge(rays_, std::move(rays));
    for (auto& [name, port] : state.ports) {
        ports_.insert_or_assign(name, Dated<State::Port>{std::move(port), sequence_});
        changed_ = sequence_;
    }
    for (WebMember& member : state.members) {
        Dated<WebMember>& known = members_[member.name];
        if (known.changed != 0 && known.value == member) continue;
        known = {std::move(member), sequence_};
        changed_ = sequence_;
    }
    state.now.rays.clear();
    const auto clock = [](const WebFrame& frame) { return std::tuple(frame.tick, frame.running, frame.speed); };
    if (clock(state.now) != clock(now_)) changed_ = sequence_;
    now_ = std::move(state.now);
}

WebFrame Changes::since(Seen& seen, const Watch& watch) const {
    WebFrame frame = now_;
    const auto add = [&](const auto& known, auto& out) {
        for (const auto& each : known) {
            if (each.changed > seen.sequence) out.push_back(each.value);
        }
    };
    if (watch.truth) add(robots_, frame.robots);
    add(things_, frame.things);
    add(markers_, frame.markers);
    if (watch.rays) {
        for (const auto& each : rays_) {
            if (each.changed > seen.sequence) frame.rays.insert(frame.rays.end(), each.value.begin(), each.value.end());
        }
    }
    seen.counts.resize(watch.ports.size());
    for (std::size_t i = 0; i < watch.ports.size(); ++i) {
        const auto found = ports_.find(watch.ports[i]);
        if (found == ports_.end() || found->second.changed <= seen.sequence) continue;
        const State::Port& port = found->second.value;
        // After a restart, the counts of messages begin at 0 again.
        const std::uint64_t before = seen.counts[i] <= port.count ? seen.counts[i] : 0;
        frame.ports.push_back({.index = static_cast<std::uint32_t>(i),
                               .count = static_cast<std::uint32_t>(port.count - before),
                               .payload = port.payload});
        seen.counts[i] = port.count;
    }
    for (const std::string& name : watch.members) {
        const auto found = members_.find(name);
        if (found != members_.end() && found->second.changed > seen.sequence)
            frame.members.push_back(found->second.value);
    }
    seen.sequence = sequence_;
    return frame;
}

}  // namespace nezumi::web
