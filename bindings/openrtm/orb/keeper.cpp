// The thread works in rounds: it takes the requested state, registers names, and checks peers. It holds no lock while
// it calls a peer.
#include "bindings/openrtm/orb/keeper.hpp"

#include <algorithm>
#include <utility>

#include "bindings/openrtm/orb/call_deadline.hpp"
#include "bindings/openrtm/orb/life.hpp"
#include "bindings/openrtm/orb/linker.hpp"
#include "bindings/openrtm/orb/servants.hpp"
#include "engine/base/list.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::openrtm {
namespace {

// Time between two rounds, and rounds between checks of names and peers.
constexpr std::chrono::milliseconds pause{200};
constexpr int rounds_of_peers = 5;
constexpr int rounds_of_links = 2;
// An RTC that ends its run also ends its connections. So after a connection has ended, we ask only after this time
// whether the RTC is alive.
constexpr std::chrono::seconds last_words{3};
// A connection made by others is reported to the system, which then requests it. If it is not requested within this
// time and still exists, it is reported again.
constexpr std::chrono::seconds longest_request{10};
// The longest time for all calls together that withdraw the exports when the run ends.
constexpr std::chrono::milliseconds longest_end{1500};
// The largest number of instances with the same name on a computer.
constexpr int most_instances = 100;
// Kinds of names.
constexpr const char* rtc_kind = ".rtc";
constexpr const char* manager_kind = ".mgr";

// The key for messages about a connection in `told_`.
std::string about(const RtcLink& link) { return link.path + " rtm:" + link.component + "." + link.port; }

}  // namespace

Keeper::Keeper(const Home& home, const OrbOptions& options)
    : home_(home), names_(home.orb, options.nameservers), has_manager_(options.manager) {
    thread_ = start_thread([this] { run(); });
}

Keeper::~Keeper() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        for (const Rtc& rtc : rtcs_) rtc->stop();  // immediately, because the thread may be waiting for a peer
    }
    changed_.notify_all();
    thread_.join();
    const CallDeadline deadline(longest_end);
    if (manager_.in() != nullptr) {
        unbind(manager_->instance() + manager_kind, manager_->reference());
        manager_->end();
        deactivate(*manager_.in());
    }
    withdraw(rtcs_);
}

// The manager lists components under the lock, but asks them without it.
void Keeper::begin_manager() {
    manager_ = new ManagerObject(home_.site, free_instance("nezumi", manager_kind), [this] {
        const std::lock_guard lock(mutex_);
        return rtcs_;
    });
    manager_->begin();
}

void Keeper::show(std::vector<RtcProfile> profiles, std::vector<RtcLink> links) {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = {std::move(profiles), std::move(links)};
        is_new_ = true;
    }
    changed_.notify_all();
}

void Keeper::show_inside(std::vector<RtcInside> connections) {
    const std::lock_guard lock(mutex_);
    inside_ = std::move(connections);
}

// Call with the lock held, or from the only thread that changes the list.
PortObject* Keeper::find_port(std::string_view path) {
    for (const Rtc& rtc : rtcs_) {
        if (PortObject* port = rtc->find_port(path)) return port;
    }
    return nullptr;
}

WantedOrders Keeper::wanted(std::string_view path) {
    const std::lock_guard lock(mutex_);
    PortObject* port = find_port(path);
    return port != nullptr ? port->wanted() : WantedOrders{};
}

void Keeper::publish(std::string_view path, std::span<const std::uint8_t> bytes, std::endian order) {
    const std::lock_guard lock(mutex_);
    if (PortObject* port = find_port(path)) port->publish(bytes, order);
}

bool Keeper::is_made(const RtcLink& link) {
    const std::lock_guard lock(mutex_);
    return contains(made_, link);
}

bool Keeper::is_ending() {
    const std::lock_guard lock(mutex_);
    return ends_;
}

void Keeper::run() {
    if (has_manager_) begin_manager();
    for (;;) {
        Exports wanted;
        bool is_new = false;
        {
            Lock lock(mutex_);
            changed_.wait_for(lock, pause, [this] { return ends_ || is_new_; });
            if (ends_) return;
            is_new = std::exchange(is_new_, false);
            if (is_new) wanted = wanted_;
        }
        if (is_new) take_wanted(wanted);
        const bool looks_around = is_new || rounds_ % rounds_of_peers == 0;
        if (looks_around) register_all();
        look_after_connections();
        connect_inside();
        if (is_new || rounds_ % rounds_of_links == 0) {
            make_links();
            look_for_joined();
        }
        note_made();
        ++rounds_;
    }
}

void Keeper::note_made() {
    std::vector<RtcLink> made;
    for (const Link& link : links_) {
        if (!CORBA::is_nil(link.theirs) && !link.ended_at) made.push_back(link.wanted);
    }
    const std::lock_guard lock(mutex_);
    made_ = std::move(made);
}

void Keeper::take_wanted(const Exports& wanted) {
    take_links(wanted.links);
    std::vector<Rtc> gone;
    std::vector<RtcProfile> fresh;
    {
        const std::lock_guard lock(mutex_);
        const auto stays = [&](const Rtc& rtc) { return contains(wanted.profiles, rtc->profile()); };
        const auto first_gone = std::stable_partition(rtcs_.begin(), rtcs_.end(), stays);
        gone.assign(first_gone, rtcs_.end());
        rtcs_.erase(first_gone, rtcs_.end());
        for (const RtcProfile& profile : wanted.profiles) {
            const auto is_it = [&](const Rtc& rtc) { return rtc->profile() == profile; };
            if (std::none_of(rtcs_.begin(), rtcs_.end(), is_it)) fresh.push_back(profile);
        }
    }
    withdraw(gone);
    for (const Rtc& rtc : gone) {
        for (Link& link : links_) {
            if (rtc->find_port(link.wanted.path) != nullptr) link = {link.wanted};
        }
    }
    for (const RtcProfile& profile : fresh) {
        const Rtc rtc(new RtcObject(home_, profile, free_instance(profile.component, rtc_kind), names_.own_context()));
        rtc->begin();
        const std::lock_guard lock(mutex_);
        rtcs_.push_back(rtc);
    }
}

// Keeps unchanged connections and disconnects removed ones.
void Keeper::take_links(const std::vector<RtcLink>& wanted) {
    std::vector<Link> links;
    for (const RtcLink& each : wanted) {
        const auto same = [&](const Link& link) { return link.wanted == each && !link.is_ended; };
        const auto before = std::find_if(links_.begin(), links_.end(), same);
        const auto joined = std::find_if(joined_.begin(), joined_.end(),
                                         [&](const Joined& its) { return its.link && its.link->wanted == each; });
        if (before == links_.end() && joined != joined_.end()) {
            links.push_back(*joined->link);
            joined_.erase(joined);
        } else {
            links.push_back(before != links_.end() ? *before : Link{each});
        }
    }
    for (const Link& link : links_) {
        PortObject* port = find_port(link.wanted.path);
        const bool stays = contains(wanted, link.wanted);
        if (!stays) told_.erase(about(link.wanted));
        if (stays || port == nullptr || CORBA::is_nil(link.theirs)) continue;
        const std::string id = port->connection_with(link.theirs);
        if (!id.empty()) static_cast<void>(port->disconnect(id.c_str()));
    }
    links_ = std::move(links);
}

// Sends all robots their stop first, and only then waits for them.
void Keeper::withdraw(const std::vector<Rtc>& gone) {
    for (const Rtc& rtc : gone) rtc->stop();
    const auto deadline = Clock::now() + PortObject::longest_settling;
    for (const Rtc& rtc : gone) {
        unbind(rtc->instance() + rtc_kind, rtc->reference());
        rtc->withdraw(deadline);
    }
}

void Keeper::unbind(const std::string& name, CORBA::Object_ptr object) {
    for (NameServers::Server& server : names_.each()) {
        if (server.is_resting()) continue;
        try {
            server.names.unbind(name, object);
        } catch (const CORBA::Exception&) {
            // The name service is away: it keeps a stale entry, as after a crash.
            server.let_rest();
            told_.clear();
        }
    }
}

// The first instance name not used by a living RTC on this computer, in any name service.
std::string Keeper::free_instance(const std::string& name, const std::string& kind) {
    const auto is_used = [&](const std::string& instance) {
        return std::any_of(names_.each().begin(), names_.each().end(), [&](NameServers::Server& server) {
            try {
                return !server.is_resting() &&
                       server.names.bound(instance + kind, CORBA::Object::_nil()) == NameService::Bound::other;
            } catch (const CORBA::Exception&) {
                return false;  // it is checked again at registration
            }
        });
    };
    for (int i = 0; i < most_instances; ++i) {
        std::string instance = name + std::to_string(i);
        if (!is_used(instance)) return instance;
    }
    return name + "0";
}

// Each name service is informed separately: a missing one does not matter to the others.
void Keeper::register_all() {
    for (NameServers::Server& server : names_.each()) {
        if (is_ending()) return;
        if (server.is_resting()) continue;
        const std::string about = "the name service at " + server.names.address();
        try {
            for (const Rtc& rtc : rtcs_) {
                register_at(server.names, rtc->profile().component, rtc->instance() + rtc_kind, rtc->reference());
                rtc->note_named();
            }
            if (manager_.in() != nullptr)
                register_at(server.names, "the manager", manager_->instance() + manager_kind, manager_->reference());
            told_.erase(about);
        } catch (const CORBA::Exception&) {
            server.let_rest();
            tell_once(about, true,
                      "rtm: no name service answers at " + server.names.address() +
                          ": start one, for example omniNames; our RTCs can't be found "
                          "until then");
        }
    }
}

void Keeper::register_at(NameService& names, const std::string& shown, const std::string& name,
                         CORBA::Object_ptr object) {
    const auto bound = names.bound(name, object);
    if (bound == NameService::Bound::ours) return;
    if (bound == NameService::Bound::other) {
        tell_once(name, true, "rtm: " + name + " now belongs to another program: our RTC can't be found");
        return;
    }
    names.rebind(name, object);
    tell_once(name, false, "rtm: " + shown + " is " + names.own_context() + "/" + name);
}

void Keeper::look_after_connections() {
    const auto goes_on = [this] { return !is_ending(); };
    for (const Rtc& rtc : rtcs_) {
        for (const auto& port : rtc->ports()) {
            std::vector<std::string> lost = port->drop_lost();
            if (rounds_ % rounds_of_peers == 0) {
                for (std::string& id : port->ask_peers(goes_on)) lost.push_back(std::move(id));
            }
            // These connections were lost with their peers, not ended on purpose. Requested ones are made again.
            for (Link& link : links_) {
                if (!contains(lost, link.id)) continue;
                lose(link, link.is_joined);
            }
        }
    }
}

// True if a requested connection must be made now. It is made again after its RTC was away. If the RTC lives but the
// connection is gone, a tool or the RTC has removed it on purpose, and it is not made again.
bool Keeper::is_to_be_made(Link& link, PortObject& port) {
    if (CORBA::is_nil(link.theirs)) return !link.is_ended;
    if (std::string id = port.connection_with(link.theirs); !id.empty()) {
        link.id = std::move(id);
        link.ended_at.reset();
        return false;
    }
    if (!link.ended_at) link.ended_at = Clock::now();
    if (Clock::now() - *link.ended_at < last_words) return false;
    const Life life = life_of(link.theirs);
    if (life == Life::silent) return false;
    const bool is_over = life == Life::lives || link.is_joined;
    lose(link, is_over);
    return !is_over;
}

// Forgets a connection that is gone, and what was reported about it, so that its next state is reported again.
void Keeper::lose(Link& link, bool is_over) {
    told_.erase(about(link.wanted));
    if (is_over) home_.site.ended(link.wanted);
    link = {.wanted = link.wanted, .is_ended = is_over};
}

// Reports connections that exist but were not requested: RTCs or tools have made them.
void Keeper::look_for_joined() {
    std::erase_if(joined_, [](const Joined& each) { return Clock::now() - each.at > longest_request; });
    for (const Rtc& rtc : rtcs_) {
        for (const auto& port : rtc->ports()) {
            const std::string& path = port->port().path;
            for (const PortObject::Made& made : port->made()) {
                const auto is_link = [&](const Link& link) {
                    return link.wanted.path == path && !CORBA::is_nil(link.theirs) &&
                           link.theirs->_is_equivalent(made.other);
                };
                const auto is_known = [&](const Joined& each) { return each.id == made.id; };
                if (std::any_of(links_.begin(), links_.end(), is_link)) continue;
                if (std::any_of(joined_.begin(), joined_.end(), is_known)) continue;
                if (is_ending()) return;
                Joined joined{.id = made.id, .at = Clock::now()};
                if (auto wanted = link_with(names_, path, made.other)) {
                    joined.link =
                        Link{.wanted = std::move(*wanted), .theirs = made.other, .id = made.id, .is_joined = true};
                    home_.site.joined(joined.link->wanted);
                }
                joined_.push_back(std::move(joined));
            }
        }
    }
}

// Shows the system's own connections at the ports of both ends.
void Keeper::connect_inside() {
    const std::lock_guard lock(mutex_);
    std::map<PortObject*, std::vector<std::string>> others;
    for (const Rtc& rtc : rtcs_) {
        for (const auto& port : rtc->ports()) others[port.in()];
    }
    for (const RtcInside& each : inside_) {
        PortObject *from = find_port(each.from), *to = find_port(each.to);
        if (from == nullptr || to == nullptr) continue;
        PortObject::show_inside(*from, *to);
        others[from].push_back(each.to);
        others[to].push_back(each.from);
    }
    for (auto& [port, paths] : others) port->keep_inside(paths);
}

void Keeper::make_links() {
    for (Link& each : links_) {
        const RtcLink& wanted = each.wanted;
        PortObject* port = find_port(wanted.path);
        if (is_ending()) return;
        if (port == nullptr || !is_to_be_made(each, *port)) continue;
        const std::string other = "rtm:" + wanted.component + "." + wanted.port;
        const std::string between = port->port().is_in ? other + " to " + wanted.path : wanted.path + " to " + other;
        const std::string problem = link(names_, *port, wanted, each.theirs);
        std::string text = problem.empty() ? "connected: " : "not connected: ";
        text += between;
        if (!problem.empty()) text.append(": ").append(problem);
        tell_once(about(wanted), !problem.empty(), text);
    }
}

// Reports a condition once while it lasts.
void Keeper::tell_once(const std::string& about, bool is_problem, const std::string& text) {
    std::string& last = told_[about];
    if (last == text) return;
    last = text;
    home_.site.tell(is_problem, text);
}

}  // namespace nezumi::openrtm
