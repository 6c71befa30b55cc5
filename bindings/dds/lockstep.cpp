// Steps are repeated until all hosts have continued, so lost messages and the order of start do not matter.
#include "bindings/dds/lockstep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bindings/dds/wire.hpp"
#include "engine/base/list.hpp"
#include "engine/base/names.hpp"

namespace nezumi::dds {

Topic step_topic(const std::string& from, const std::string& to) {
    // A partner is at most one step ahead; the rest are repetitions.
    constexpr int most_waiting = 64;
    return {.name = fmt::format("nezumi/{}/steps/{}", from, to),
            .type = "nezumi::Step",
            .reliable = true,
            .keeps_all = true,
            .wakes = true,
            .depth = most_waiting};
}

// The hosts named in this host's file or connections.
std::set<std::string> Lockstep::named(const std::vector<Ends>& connections) const {
    std::set<std::string> names(settings_.hosts.begin(), settings_.hosts.end());
    for (const auto& [from, to] : connections)
        names.emplace(host_of(from) == settings_.host ? host_of(to) : host_of(from));
    return names;
}

bool Lockstep::may_connect(const HostTable& hosts, const std::vector<Ends>& connections) const {
    if (tick() > 0) return true;
    const std::set<std::string> names = named(connections);
    return std::all_of(names.begin(), names.end(),
                       [&](const std::string& name) { return hosts.find(name) != nullptr; });
}

void Lockstep::announce(Announcement& said, const std::vector<Ends>& connections) const {
    if (left_) return;
    const std::set<std::string> names = named(connections);
    said.lockstep = system_.settings().rate;
    said.partners.assign(names.begin(), names.end());
}

void Lockstep::meet(const HostTable& hosts, const std::vector<Ends>& connections, bool connected) {
    if (left_) return;
    absent_.clear();
    met_ = connected;
    // A partner that disappears before its first step can't announce its end, so it is removed.
    std::erase_if(partners_,
                  [&](const auto& each) { return !each.second.their_began && hosts.find(each.first) == nullptr; });
    const std::set<std::string> names = named(connections);
    std::set<std::string> related = names;
    for (const Announcement* host : hosts.all()) {
        const std::vector<std::string>& theirs = host->partners;
        if (contains(theirs, settings_.host)) related.insert(host->head.host);
    }
    for (const std::string& name : related) {
        const Announcement* host = hosts.find(name);
        if (host != nullptr && connected) consider(*host, names.contains(name));
        if (host == nullptr && !partners_.contains(name)) absent_.emplace(name, fmt::format("waits for host {}", name));
    }
    for (auto each = partners_.begin(); each != partners_.end();) {
        if (!related.contains(each->first)) {
            if (!each->second.said.empty()) say(each->second, each->second.said.back(), Step::parts);
            each = partners_.erase(each);
        } else {
            ++each;
        }
    }
    follow(connections);
}

// Makes a related host a partner, or reports why not.
void Lockstep::consider(const Announcement& host, bool is_named) {
    const std::string& name = host.head.host;
    if (over_.contains(host.run)) return;  // that run is over, but a killed host stays visible for some seconds
    if (const auto known = partners_.find(name); known != partners_.end()) {
        if (known->second.run == host.run) return;
        over_.insert(known->second.run);  // the host was killed and started again
        partners_.erase(known);
    }
    const double rate = system_.settings().rate;
    if (host.lockstep == rate) return join(host, is_named);
    const bool is_news = told_apart_.emplace(name, host.run).second;
    if (host.lockstep == 0) {
        if (is_news)
            system_.log(LogLevel::warn, fmt::format("host {} is not in lockstep: its messages arrive at any "
                                                    "time; set network {{ lockstep = true }} there",
                                                    name));
        return;
    }
    if (is_news)
        system_.log(LogLevel::error, fmt::format("lockstep: host {} has {:g} ticks per second, this one {:g}: say "
                                                 "rate({:g}) here or rate({:g}) there, and restart()",
                                                 name, host.lockstep, rate, host.lockstep, rate));
    absent_.emplace(name, fmt::format("host {} has another tick rate", name));
}

void Lockstep::join(const Announcement& host, bool is_named) {
    const std::string& name = host.head.host;
    Partner partner;
    partner.run = host.run;
    partner.began = tick() + 1;
    partner.heard_at = settings_.clock();
    partner.reader = transport_.read(step_topic(name, settings_.host));
    if (partner.reader != nullptr) partner.writer = transport_.write(step_topic(settings_.host, name));
    if (partner.writer == nullptr) {
        if (told_apart_.emplace(name, host.run).second)
            system_.log(LogLevel::error, fmt::format("lockstep: host {}: {}", name, transport_.problem()));
        absent_.emplace(name, fmt::format("host {} can't be heard", name));
        return;
    }
    partners_.emplace(name, std::move(partner));
    if (tick() == 0) {
        system_.log(LogLevel::info, fmt::format("lockstep: in step with host {}", name));
    } else {
        system_.log(LogLevel::warn,
                    fmt::format("lockstep: in step with host {} from {:.2f} s on; for reproducible runs start them "
                                "together{}",
                                name, system_.now().seconds,
                                is_named ? "" : fmt::format(": network {{ hosts = \"{}\" }} waits for it", name)));
    }
}

// Determines the ports that the partners need.
void Lockstep::follow(const std::vector<Ends>& connections) {
    std::set<std::string, std::less<>> wanted;
    for (auto& [name, partner] : partners_) {
        partner.ports.clear();
        for (const auto& [from, to] : connections) {
            if (host_of(to) == name) partner.ports.insert(std::string(without_host(from)));
        }
        wanted.insert(partner.ports.begin(), partner.ports.end());
    }
    std::erase_if(published_, [&](const auto& each) { return !wanted.contains(each.first); });
    for (const std::string& path : wanted) {
        if (published_.contains(path)) continue;
        if (const auto port = std::as_const(system_).port(path))
            published_.try_emplace(path, system_, static_cast<const OutPortBase&>(**port));
    }
}

void Lockstep::hear(Partner& partner) {
    for (const TopicSample& sample : partner.reader->take()) {
        Step step;
        if (!read_cdr(sample.bytes, on_the_wire, step)) continue;
        if (step.run != partner.run || step.to != settings_.run) continue;
        const bool is_one = step.began >= 0 && step.tick >= step.began && step.tick < most_ticks;
        if (is_one) take(partner, std::move(step));
    }
}

void Lockstep::take(Partner& partner, Step step) {
    if (partner.their_began && step.began < *partner.their_began) return;  // of an earlier partnership
    if (partner.their_began && step.began > *partner.their_began) {        // the partner has joined again
        if (partner.in_use) partner.began = tick() + 1;
        partner.in_use = false;
        partner.heard.clear();
        partner.said.clear();
        partner.last = most_ticks;
    }
    partner.their_began = step.began;
    partner.heard_at = settings_.clock();
    partner.paused = step.paused;
    const bool is_name = step.waits_for.size() <= longest_name && is_identifier(step.waits_for);
    partner.waits_for = is_name ? step.waits_for : "";
    if (step.end != Step::goes_on) {
        partner.end = step.end == Step::parts ? Step::parts : Step::ends;
        partner.last = step.tick;
    }
    // Before the common first tick, only that tick is expected.
    const std::int64_t next = std::max(their_tick(partner), step.began);
    if (step.tick == next || step.tick == next + 1) partner.heard.try_emplace(step.tick, std::move(step));
}

// The host that is behind this one; "" if none.
std::string Lockstep::find_missing() {
    std::string missing;
    double heard_at = std::numeric_limits<double>::infinity();
    for (auto& [name, partner] : partners_) {
        const auto is_missing = [&, &partner = partner] {
            if (partner.began > tick() || is_over(partner)) return false;
            return !partner.their_began || !partner.heard.contains(their_tick(partner));
        };
        if (!is_missing()) continue;
        hear(partner);
        // If several are missing, takes the one that was silent longest: the others may be waiting for it.
        if (is_missing() && partner.heard_at < heard_at) {
            missing = name;
            heard_at = partner.heard_at;
        }
    }
    if (!missing.empty() || tick() > 0) return missing;
    if (!absent_.empty()) return absent_.begin()->first;
    return met_ && (!partners_.empty() || !told_apart_.empty()) ? "" : "another host";
}

bool Lockstep::may_tick() {
    if (left_) return true;
    missing_ = find_missing();
    if (!missing_.empty() && !stands_since_) stands_since_ = settings_.clock();
    return missing_.empty();
}

void Lockstep::deliver(const MessageDoor& give) {
    if (left_) return;
    for (auto each = partners_.begin(); each != partners_.end();) {
        auto& [name, partner] = *each;
        const auto due = partner.their_began && partner.began <= tick() ? partner.heard.find(their_tick(partner))
                                                                        : partner.heard.end();
        if (due != partner.heard.end()) {
            partner.in_use = true;
            const Step step = std::move(due->second);
            partner.heard.erase(partner.heard.begin(), std::next(due));
            for (const StepMessage& message : step.messages) deliver(name, message, give);
        } else if (is_over(partner)) {
            system_.log(LogLevel::info, fmt::format("lockstep: host {} has {}: this one continues without it", name,
                                                    partner.end == Step::ends ? "ended" : "parted"));
            if (partner.end == Step::ends) over_.insert(partner.run);
            each = partners_.erase(each);
            continue;
        }
        ++each;
    }
}

// Delivers a message like one from a port's topic: as an act of `host`.
void Lockstep::deliver(const std::string& host, const StepMessage& message, const MessageDoor& give) {
    const std::string path = fmt::format("{}/{}", host, message.port);
    const auto port = std::as_const(system_).port(path);
    if (!port || (*port)->direction() != Direction::out || system_.peers(**port).empty()) return;
    const Component* component = system_.find(std::string_view(path).substr(0, path.find('.')));
    if (component == nullptr || component->state() != LifeState::active) return;
    if (auto value = read_message((*port)->type(), message.payload))
        static_cast<void>(give(**port, Write{path, std::move(*value)}, {Actor::Kind::network, host}));
}

void Lockstep::publish() {
    if (left_) return;
    if (layout_ != system_.layout()) {
        follow_ports(published_, system_);
        layout_ = system_.layout();
    }
    std::vector<StepMessage> all;
    for (auto& [path, port] : published_) {
        port.take([&, &path = path](const MessageView& message) {
            write_cdr(all.emplace_back(StepMessage{path, {}}).payload, on_the_wire, message.data);
        });
    }
    for (auto& [name, partner] : partners_) {
        Step step{.run = settings_.run, .to = partner.run, .began = partner.began, .tick = tick() + 1};
        std::copy_if(all.begin(), all.end(), std::back_inserter(step.messages),
                     [&, &partner = partner](const StepMessage& each) { return partner.ports.contains(each.port); });
        partner.said.push_back(std::move(step));
        if (partner.said.size() > 2) partner.said.pop_front();
        say(partner, partner.said.back(), Step::goes_on);
    }
    said_at_ = settings_.clock();
    stands_since_.reset();
    if (std::exchange(told_, "").empty()) return;
    system_.log(LogLevel::info, "lockstep: time continues");
}

void Lockstep::say(Partner& partner, Step& step, Step::End end) {
    step.end = end;
    step.paused = missing_.empty();
    step.waits_for = missing_;
    write_cdr(bytes_, on_the_wire, step);
    if (!partner.writer->write(bytes_)) said_at_ = 0;  // no space in the queue: try again soon
}

void Lockstep::serve() {
    if (left_) return;
    const double now = settings_.clock();
    for (auto& [name, partner] : partners_) hear(partner);
    static_cast<void>(may_tick());
    if (now - said_at_ >= repetition) {
        said_at_ = now;
        for (auto& [name, partner] : partners_) {
            for (Step& step : partner.said) say(partner, step, Step::goes_on);
        }
    }
    tell();
}

std::string Lockstep::why_standing() const {
    if (const auto absent = absent_.find(missing_); absent != absent_.end()) return absent->second;
    const auto partner = partners_.find(missing_);
    if (partner == partners_.end()) return "waits for another host in lockstep";
    if (settings_.clock() - partner->second.heard_at >= patience) return fmt::format("host {} is silent", missing_);
    if (partner->second.paused) return fmt::format("host {} is paused", missing_);
    const std::string& other = partner->second.waits_for;
    if (other.empty() || other == settings_.host) return fmt::format("waits for host {}", missing_);
    return fmt::format("host {} waits for host {}", missing_, other);
}

// Reports the reason once, and again when it changes.
void Lockstep::tell() {
    if (missing_.empty() || !stands_since_ || settings_.clock() - *stands_since_ < patience) return;
    const std::string why = why_standing();
    if (why == told_) return;
    told_ = why;
    stands_since_ = settings_.clock();
    system_.log(LogLevel::warn, fmt::format("lockstep: time is stopped at {:.2f} s: {}", system_.now().seconds, why));
}

void Lockstep::leave() {
    if (std::exchange(left_, true)) return;
    for (auto& [name, partner] : partners_) {
        if (partner.said.empty())
            partner.said.push_back(
                {.run = settings_.run, .to = partner.run, .began = partner.began, .tick = partner.began});
        say(partner, partner.said.front(), Step::goes_on);  // the partner may have missed this step too
        say(partner, partner.said.back(), Step::ends);
    }
}

void Lockstep::add_files(std::vector<int>& files) const {
    for (const auto& [name, partner] : partners_) {
        if (const int file = partner.reader->file(); file >= 0) files.push_back(file);
    }
}

}  // namespace nezumi::dds
