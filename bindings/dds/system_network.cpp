// Checks other hosts several times per second; messages are sent in every tick.
#include "bindings/dds/system_network.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/dds/announced_types.hpp"
#include "engine/messages/message_catalog.hpp"

namespace nezumi::dds {
namespace {

// [s] between two checks of other hosts' announcements.
constexpr double period = 0.05;

// Splits "host/name.port" into "host/name" and the port.
std::pair<std::string, std::string> split(std::string_view path) {
    const std::size_t dot = path.find('.');
    return {std::string(path.substr(0, dot)), std::string(path.substr(dot + 1))};
}

RemoteComponent* remote_of(System& system, std::string_view name) {
    return dynamic_cast<RemoteComponent*>(system.find(name));
}

}  // namespace

SystemNetwork::SystemNetwork(System& system, DdsTransport& transport, HostSettings settings)
    : system_(system),
      transport_(transport),
      settings_(std::move(settings)),
      hosts_({.protocol = protocol, .host = settings_.name, .version = settings_.version}, settings_.run,
             settings_.sealed),
      requests_(transport, settings_.name, settings_.run),
      strangers_(transport, settings_.sealed) {
    if (settings_.lockstep)
        lockstep_.emplace(
            system, transport,
            Lockstep::Settings{
                .host = settings_.name, .run = settings_.run, .hosts = settings_.hosts, .clock = settings_.clock});
    system_.observe(*this);
}

Expected<void> SystemNetwork::reach(std::string_view path, const Port& other) {
    const auto [name, port] = split(path);
    RemoteComponent* remote = remote_of(system_, name);
    if (remote == nullptr) {
        auto made = std::make_unique<RemoteComponent>(host_of(name), without_host(name), settings_.clock);
        remote = made.get();
        if (auto added = system_.add(std::move(made)); !added) return Unexpected(added.error());
        if (auto active = remote->activate(system_.now()); !active) return active;
    }
    if (remote->find_port(port) != nullptr) return {};
    system_.change_layout();
    static_cast<void>(
        remote->port(port, other.type(), other.direction() == Direction::in ? Direction::out : Direction::in));
    return {};
}

void SystemNetwork::between_ticks(const ActDoor& act, const QuestionDoor& answer) {
    const double now = settings_.clock();
    if (failed_ || !open()) return;
    requests_.serve(
        hosts_, [&](const Question& question, const Actor& who) { return answer(question, settings_.writable, who); },
        now);
    if (now >= next_) {
        next_ = now + period;
        look(act);
    }
    if (lockstep_) lockstep_->serve();
}

void SystemNetwork::look(const ActDoor& act) {
    listen();
    if (const std::string told = strangers_.look(settings_.clock()); !told.empty())
        system_.log(LogLevel::warn, "network: " + told);
    const bool made =
        (!lockstep_ || lockstep_->may_connect(hosts_, present())) && make_what_others_want(present(), act);
    end_what_they_no_longer_want(present(), act);
    end_what_is_refused(present(), act);
    const std::vector<Ends> all = present();
    if (lockstep_) lockstep_->meet(hosts_, all, made);
    open_topics(all);
    announce(all);
    note_waiting();
}

void SystemNetwork::before_tick(const MessageDoor& deliver) {
    // NOLINTNEXTLINE(modernize-loop-convert): an act may change the list itself
    for (std::size_t i = 0; i < system_.components().size(); ++i) {
        if (auto* remote = dynamic_cast<RemoteComponent*>(system_.components()[i].get())) remote->receive(deliver);
    }
    if (lockstep_) lockstep_->deliver(deliver);
}

Expected<std::uint64_t> SystemNetwork::ask(const Question& question) const {
    return requests_.ask(question, hosts_, settings_.clock());
}

std::optional<Expected<PlainData>> SystemNetwork::answer(std::uint64_t number) const {
    return requests_.answer(number, settings_.clock());
}

bool SystemNetwork::open() {
    if (announcer_ != nullptr) return true;
    listener_ = transport_.read(announcement_topic());
    if (listener_ != nullptr) announcer_ = transport_.write(announcement_topic());
    failed_ = announcer_ == nullptr;
    if (failed_) system_.log(LogLevel::error, fmt::format("network: {}", transport_.problem()));
    return !failed_;
}

void SystemNetwork::listen() {
    const double now = settings_.clock();
    // Only the last valid announcement of each writer is used: a host that sends many must not delay ticks.
    std::map<std::uint64_t, std::vector<Octets>> words;
    for (TopicSample& sample : listener_->take()) words[sample.writer].push_back(std::move(sample.bytes));
    for (auto& [writer, said] : words) {
        while (!said.empty() && !hosts_.heard(writer, said.back(), now)) said.pop_back();
    }
    hosts_.keep(listener_->writers(), now);
    for (HostTable::News& news : hosts_.take_news()) system_.log(news.level, std::move(news.text));
    for (const auto& component : system_.components()) {
        auto* remote = dynamic_cast<RemoteComponent*>(component.get());
        if (remote == nullptr) continue;
        const Announcement* host = hosts_.find(remote->host());
        remote->set_run(host != nullptr ? std::optional(host->run) : std::nullopt);
    }
}

std::string SystemNetwork::whole(std::string_view path) const {
    return is_remote(path) ? std::string(path) : fmt::format("{}/{}", settings_.name, path);
}

std::string SystemNetwork::local(std::string_view path) const {
    return std::string(host_of(path) == settings_.name ? without_host(path) : path);
}

std::string SystemNetwork::other_of(const Ends& ends) const {
    return std::string(host_of(host_of(ends.first) == settings_.name ? ends.second : ends.first));
}

// The existing connections with other hosts.
std::vector<Ends> SystemNetwork::present() const {
    std::vector<Ends> all;
    for (const ConnectionSpec& each : system_.connections()) {
        const bool is_ours = is_remote(each.from) != is_remote(each.to);
        const auto [name, port] = split(is_remote(each.from) ? each.from : each.to);
        if (is_ours && remote_of(system_, name) != nullptr) all.emplace_back(whole(each.from), whole(each.to));
    }
    return all;
}

void SystemNetwork::open_topics(const std::vector<Ends>& present) {
    std::set<std::string, std::less<>> sent, received;
    for (const auto& [from, to] : present) {
        if (lockstep_ && lockstep_->carries(other_of({from, to}))) continue;
        if (host_of(from) == settings_.name) {
            sent.emplace(without_host(from));
        } else {
            received.insert(from);
        }
    }
    std::erase_if(outlets_, [&](const auto& each) { return !sent.contains(each.first); });
    for (const std::string& path : sent) {
        const auto port = std::as_const(system_).port(path);
        if (outlets_.contains(path) || !port) continue;
        const auto& out = static_cast<const OutPortBase&>(**port);
        if (auto writer = transport_.write(topic_of(settings_.name, path, out.type()))) {
            outlets_.try_emplace(path, system_, out, std::move(writer), numbers_[path]);
        } else {
            tell_problem(path);
        }
    }
    for (const auto& component : system_.components()) {
        auto* remote = dynamic_cast<RemoteComponent*>(component.get());
        if (remote == nullptr) continue;
        for (const auto& port : remote->out_ports()) {
            const std::string path = nezumi::path(*remote, *port);
            const bool wanted = received.contains(path);
            if (wanted == remote->receives(*port)) continue;
            auto reader = wanted ? transport_.read(topic_of(host_of(path), without_host(path), port->type())) : nullptr;
            if (wanted && reader == nullptr) tell_problem(path);
            remote->receive(*port, std::move(reader));
        }
    }
}

// Reports once that a port's messages can't be sent.
void SystemNetwork::tell_problem(const std::string& path) {
    if (problems_.insert(path).second)
        system_.log(LogLevel::error, fmt::format("network: {}: {}", path, transport_.problem()));
}

void SystemNetwork::announce_ports(Announcement& next) const {
    std::vector<const MessageType*> types;
    const auto add = [&](const Component& component, const Port& port) {
        next.ports.push_back(
            {nezumi::path(component, port), wire_name(*port.type()), port.direction() == Direction::in});
        types.push_back(port.type());
    };
    for (const auto& component : system_.components()) {
        if (is_remote(component->name())) continue;
        for (const auto& port : std::as_const(*component).in_ports()) add(*component, *port);
        for (const auto& port : std::as_const(*component).out_ports()) add(*component, *port);
    }
    next.types = announced_types(types);
}

void SystemNetwork::announce(const std::vector<Ends>& present) {
    Announcement next;
    next.head = {.protocol = protocol, .host = settings_.name, .version = settings_.version};
    next.run = settings_.run;
    if (layout_ == system_.layout() && said_.run != 0) {
        next.ports = said_.ports;
        next.types = said_.types;
    } else {
        announce_ports(next);
    }
    for (const Ends& ends : present) {
        if (!brought_.contains(ends)) next.wants.push_back({ends.first, ends.second});
    }
    next.heard = hosts_.heard_runs();
    next.number = said_.number;
    for (const auto& [ends, why] : refusals_) next.refusals.push_back({ends.first, ends.second, why});
    if (lockstep_) lockstep_->announce(next, present);
    layout_ = system_.layout();
    if (next == said_) return;
    ++next.number;
    if (announcer_->write(write_announcement(next))) said_ = std::move(next);
}

namespace {

// Why a port of another host has no messages; "" if its host has the port. `host`: nullptr if the host is missing.
std::string why_waiting(const Announcement* host, const RemoteComponent& remote, const Port& port) {
    if (host == nullptr) return fmt::format("waits for host {}", remote.host());
    const std::string name(without_host(nezumi::path(remote, port)));
    if (HostTable::find_port(*host, name) != nullptr) return "";
    std::vector<std::string_view> names;
    constexpr std::size_t most_compared = 1000;  // 20 times per second
    for (std::size_t i = 0; i < std::min(host->ports.size(), most_compared); ++i) names.push_back(host->ports[i].name);
    return fmt::format("host {} has no port {}{}", remote.host(), name, did_you_mean(name, names));
}

}  // namespace

// Sets the notes of ports of other hosts: why they have no messages, or how many messages were lost.
void SystemNetwork::note_waiting() {
    for (const auto& component : system_.components()) {
        auto* remote = dynamic_cast<RemoteComponent*>(component.get());
        if (remote == nullptr) continue;
        const Announcement* host = hosts_.find(remote->host());
        for (const auto& port : remote->in_ports()) port->set_note(why_waiting(host, *remote, *port));
        for (const auto& port : remote->out_ports()) {
            std::string note = why_waiting(host, *remote, *port);
            const Counts* counts = remote->counts(*port);
            if (note.empty() && counts != nullptr && counts->missed + counts->late + counts->wrong > 0)
                note =
                    fmt::format("{} messages missed, {} late, {} wrong", counts->missed, counts->late, counts->wrong);
            port->set_note(std::move(note));
        }
    }
}

void SystemNetwork::latched(const System& system) {
    if (followed_ != system.layout()) {  // ports may have been removed or replaced
        follow_ports(outlets_, system);
        followed_ = system.layout();
    }
    const double clock = settings_.clock();
    for (auto& [path, outlet] : outlets_) outlet.send(system.now(), settings_.run, clock);
    if (lockstep_) lockstep_->publish();
}

std::vector<Host> SystemNetwork::hosts() const {
    std::map<std::string, Host> all;
    for (const Announcement* said : hosts_.all()) {
        Host& host = all[said->head.host];
        host.here = true;
        host.version = said->head.version;
        for (const AnnouncedPort& port : said->ports)
            host.ports.push_back({port.name, port.type, port.in ? Direction::in : Direction::out});
    }
    for (const auto& component : std::as_const(system_).components()) {
        if (const auto* remote = dynamic_cast<const RemoteComponent*>(component)) all[remote->host()];
    }
    std::vector<Host> list;
    for (auto& [name, host] : all) {
        host.name = name;
        list.push_back(std::move(host));
    }
    return list;
}

bool SystemNetwork::brought(const ConnectionSpec& connection) const {
    return brought_.contains(Ends{whole(connection.from), whole(connection.to)});
}

}  // namespace nezumi::dds
