// Channels have pointers into the system, and search them again after a change of its layout.
#include "engine/trace/trace.hpp"

#include <algorithm>
#include <utility>

namespace nezumi {
namespace {

constexpr std::int64_t measuring_period = 100;  // ticks

}  // namespace

void Trace::keep(std::size_t samples, std::size_t most) {
    most_samples_ = samples;
    most_bytes_ = most;
    for (auto& [name, followed] : followed_) followed.series.keep(samples);
}

std::size_t Trace::bytes() const {
    std::size_t sum = 0;
    for (const auto& [name, followed] : followed_) sum += followed.series.bytes();
    return sum;
}

void Trace::start(System& system) {
    system_ = &system;
    system.observe(*this);
    for (auto& [name, followed] : followed_) followed.series.clear(), followed.since = system.now().seconds;
    follow_layout(system.now().seconds);
}

Trace::Memory Trace::memory() const {
    Memory memory{{}, remembers_ports_, most_samples_, most_bytes_};
    for (const auto& [name, followed] : followed_) {
        if (followed.remembered) memory.names.push_back(name);
    }
    return memory;
}

void Trace::remember(const Memory& memory) {
    keep(memory.most_samples, memory.most_bytes);
    if (memory.ports) remember_ports();
    for (const std::string& name : memory.names) static_cast<void>(remember(name));
}

void Trace::take_over(Trace& other) {
    System& system = *other.system_;
    system.stop_observing(other);
    const bool is_new = followed_.empty();
    start(system);
    if (is_new) remember(other.memory());
    for (auto& [name, followed] : followed_) {
        const auto same = other.followed_.find(name);
        if (!followed.remembered || same == other.followed_.end()) continue;
        std::swap(followed.series, same->second.series);
        followed.since = same->second.since;
    }
}

Expected<Trace::Followed*> Trace::find(std::string_view name) {
    if (const auto known = followed_.find(name); known != followed_.end()) return &known->second;
    auto channel = Channel::find(*system_, name);
    if (!channel) return Unexpected(channel.error());
    std::string key = channel->name();
    Followed& made = followed_.emplace(std::move(key), Followed{std::move(*channel)}).first->second;
    made.series.keep(most_samples_);
    return &made;
}

Expected<const Channel*> Trace::follow(std::string_view name) {
    const auto found = find(name);
    if (!found) return Unexpected(found.error());
    (*found)->kept = true;
    return &(*found)->channel;
}

Expected<const Series*> Trace::remember(std::string_view name) {
    const auto found = find(name);
    if (!found) return Unexpected(found.error());
    Followed& followed = **found;
    if (!std::exchange(followed.remembered, true)) {
        followed.since = system_->now().seconds;
        followed.channel.append_to(followed.series, followed.since);
    }
    return &followed.series;
}

Expected<Trace::Remembered> Trace::remember_part(std::string_view name) {
    const auto channel = Channel::find(*system_, name);
    if (!channel) return Unexpected(channel.error());
    const auto whole = remember(channel->whole());
    if (!whole) return Unexpected(whole.error());
    Remembered all{*whole, channel->whole(), channel->whole(), channel->part(), channel->holds()};
    // A part that does not fit into the series of the whole value gets its own series.
    const bool is_full = (*whole)->labels().size() == Series::most_values;
    const auto& labels = (*whole)->labels();
    const auto has = [&](const std::string& label) { return is_within(label, all.part); };
    if (!is_full || std::any_of(labels.begin(), labels.end(), has)) return all;
    const auto own = remember(name);
    if (!own) return Unexpected(own.error());
    all.series = *own;
    all.name = channel->name();
    return all;
}

const Series* Trace::remembered(std::string_view name) const {
    const auto known = followed_.find(name);
    return known != followed_.end() && known->second.remembered ? &known->second.series : nullptr;
}

bool Trace::has_since(std::string_view name, double seconds) const {
    const auto known = followed_.find(name);
    if (known == followed_.end() || !known->second.remembered) return false;
    const Series& series = known->second.series;
    if (series.size() > 0 && series.seconds(0) < seconds) return true;
    return !series.has_dropped() && known->second.since <= seconds;
}

void Trace::remember_ports() {
    remembers_ports_ = true;
    follow_layout(system_->now().seconds);
}

void Trace::follow_layout(double since) {
    layout_ = system_->layout();
    for (auto& [name, followed] : followed_) followed.channel.resolve(*system_);
    std::erase_if(followed_, [](const auto& entry) { return !entry.second.kept && !entry.second.channel.exists(); });
    if (!remembers_ports_) return;
    std::vector<std::string> names;
    for (const Component* component : std::as_const(*system_).components()) {
        for (const Port* port : ports_of(*component)) names.push_back(component->name() + "." + port->name());
    }
    if (names.size() > most_ports) return;
    for (const std::string& name : names) {
        const auto found = find(name);
        if (!found || (*found)->channel.has_pictures()) continue;
        if (!std::exchange((*found)->remembered, true)) (*found)->since = since;
    }
}

void Trace::latched(const System& system) {
    if (layout_ != system.layout()) follow_layout(0);
    for (auto& [name, followed] : followed_) {
        followed.channel.latch(system.now().tick);
        if (followed.remembered) followed.channel.append_to(followed.series, system.now().seconds);
    }
    if (++measured_ < measuring_period) return;
    measured_ = 0;
    if (bytes() <= most_bytes_) return;
    std::size_t longest = 0;
    for (const auto& [name, followed] : followed_) longest = std::max(longest, followed.series.size());
    keep(std::max<std::size_t>(longest - longest / 8, 1), most_bytes_);
}

}  // namespace nezumi
