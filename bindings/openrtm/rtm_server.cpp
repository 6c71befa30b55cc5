// Acts of RTCs are performed like those of users; a repeated error is reported once.
#include "bindings/openrtm/rtm_server.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/openrtm/host_context.hpp"
#include "bindings/openrtm/peer_text.hpp"
#include "bindings/openrtm/peers_json.hpp"
#include "bindings/openrtm/rtm_wiring.hpp"
#include "bindings/openrtm/rtm_word.hpp"
#include "engine/base/list.hpp"

namespace nezumi::openrtm {
namespace {

// Waiting log lines; further ones are dropped.
constexpr std::size_t most_lines = 100;
// Connections whose malformed messages are reported.
constexpr std::size_t most_told = 100;

std::string set_in_use(const Component& component) {
    return component.set_in_use().empty() ? std::string(Component::no_set) : component.set_in_use();
}

// The two ends of a connection, as a system file names them.
ConnectionSpec connection_of(const RtcLink& link, bool ours_receives) {
    ConnectionSpec ends{fmt::format("rtm:{}.{}", link.component, link.port), link.path, {}};
    if (!ours_receives) std::swap(ends.from, ends.to);
    return ends;
}

}  // namespace

Expected<std::unique_ptr<RtmServer>> RtmServer::open(RtmHost host, const OrbMaker& make_orb) {
    std::unique_ptr<RtmServer> server(new RtmServer(std::move(host)));
    const RtmSpec& rtm = *RtmWord::find(server->host_.spec());
    // Errors of the file are reported before anything starts.
    if (auto fits = profiles_of(server->host_.system(), rtm); !fits) return Unexpected(fits.error());
    auto orb = make_orb({.nameservers = rtm.nameservers, .interface = rtm.interface, .manager = rtm.manager}, *server);
    if (!orb) return failure("rtm: " + orb.error().message, rtm.place);
    server->orb_ = std::move(*orb);
    if (auto shown = server->show(); !shown) return Unexpected(shown.error());
    return server;
}

RtmServer::~RtmServer() = default;

Expected<void> RtmServer::show() {
    const System& system = host_.system();
    layout_ = system.layout();
    starts_ = host_.starts();
    wanted_ = host_.system().foreign_connections();
    outlets_.clear();
    exported_.clear();
    paths_.clear();
    const RtmSpec* rtm = RtmWord::find(host_.spec());
    auto profiles = profiles_of(system, rtm != nullptr ? *rtm : RtmSpec{});
    std::vector<RtcLink> links;
    std::map<std::string, const Port*, std::less<>> in_ports;
    if (profiles) {
        for (const RtcProfile& profile : *profiles) {
            exported_.push_back(profile.component);
            const Component& component = *system.find(profile.component);
            for (const RtcPort& port : profile.ports) {
                paths_.insert(port.path);
                const std::string name = port.path.substr(profile.component.size() + 1);
                if (port.is_in) {
                    in_ports.emplace(port.path, component.find_in_port(name));
                } else if (const OutPortBase* out = component.find_out_port(name)) {
                    outlets_.push_back({port.path, out->type(), Published(system, *out)});
                }
            }
        }
        links = fitting_links();
    }
    inbox_.open_to(in_ports);
    take_snapshots();
    // After an error nothing is exported, rather than a part.
    orb_->show(profiles ? std::move(*profiles) : std::vector<RtcProfile>{}, std::move(links));
    if (!profiles) return Unexpected(profiles.error());
    return {};
}

// A new version of a script may lack a port. That is reported once, and again after the port was back.
std::vector<RtcLink> RtmServer::fitting_links() {
    std::vector<RtcLink> all;
    std::set<std::string> misfits;
    for (const ConnectionSpec& wanted : wanted_) {
        if (auto links = links_of(host_.system(), {wanted})) {
            all.insert(all.end(), links->begin(), links->end());
        } else {
            std::string line =
                fmt::format("rtm: {} is no longer connected to {}: {}", wanted.from, wanted.to, links.error().message);
            if (!misfits_.contains(line)) host_.say(true, line);
            misfits.insert(std::move(line));
        }
    }
    misfits_ = std::move(misfits);
    return all;
}

void RtmServer::follow_changes() {
    if (starts_ == host_.starts() && layout_ == host_.system().layout() &&
        wanted_ == host_.system().foreign_connections())
        return;
    if (auto shown = show(); !shown) host_.say(true, "rtm: nothing is exported now: " + describe(shown.error()));
}

void RtmServer::take_snapshots() {
    std::map<std::string, RtcSnapshot, std::less<>> snapshots;
    for (const std::string& name : exported_) {
        if (const Component* component = host_.system().find(name)) snapshots.emplace(name, look_at(*component));
    }
    taken_at_ = std::chrono::steady_clock::now();
    show_inside();
    const std::lock_guard lock(mutex_);
    snapshots_ = std::move(snapshots);
}

void RtmServer::show_inside() {
    std::vector<RtcInside> inside;
    for (ConnectionSpec& each : host_.system().connections()) {
        if (paths_.contains(each.from) && paths_.contains(each.to))
            inside.push_back({std::move(each.from), std::move(each.to)});
    }
    if (inside == inside_) return;
    inside_ = std::move(inside);
    orb_->show_inside(inside_);
}

void RtmServer::before_tick() {
    serve();
    for (Arrival& arrival : inbox_.take()) {
        const Actor who{Actor::Kind::network, shown(arrival.from)};
        const auto sent = host_.deliver(*arrival.port, Inject{arrival.path, std::move(arrival.value)}, who);
        const std::string problem = sent ? "" : sent.error().message;
        if (std::exchange(refused_[arrival.path], problem) == problem || problem.empty()) continue;
        host_.say(true, fmt::format("rtm: {} refuses what {} sends: {}", arrival.path, who.name, problem));
    }
}

void RtmServer::after_tick() {
    follow_changes();
    follow_stop();
    const System& system = host_.system();
    const double ahead = system.settings().real_time ? host_.wall_clock() - system.now().seconds : 0;
    for (Outlet& outlet : outlets_) {
        outlet.published.take([&](const MessageView& message) {
            const WantedOrders wanted = orb_->wanted(outlet.path);
            for (const auto& [is_wanted, order] :
                 {std::pair{wanted.little, std::endian::little}, std::pair{wanted.big, std::endian::big}}) {
                if (!is_wanted) continue;
                write_rtm_message(buffer_, *outlet.type, message.data, message.tm + ahead, order);
                orb_->publish(outlet.path, buffer_, order);
            }
        });
    }
}

// Reports which robots an emergency stop reaches, and which not.
void RtmServer::follow_stop() {
    const bool is_stopped = host_.system().is_stopped();
    if (std::exchange(is_stopped_, is_stopped) == is_stopped || !is_stopped) return;
    for (const Outlet& outlet : outlets_) {
        if (!outlet.published.commands()) continue;
        const WantedOrders connected = orb_->wanted(outlet.path);
        if (connected.little || connected.big)
            host_.say(true,
                      fmt::format("rtm: emergency stop: RTCs connected to {} get speed 0 until rearm()", outlet.path));
    }
    for (const ConnectionSpec& wanted : wanted_) {
        const auto links = links_of(host_.system(), {wanted});
        const auto from = std::find_if(outlets_.begin(), outlets_.end(),
                                       [&](const Outlet& outlet) { return outlet.path == wanted.from; });
        if (!links || from == outlets_.end() || !from->published.commands() || orb_->is_made(links->front())) continue;
        host_.say(true, fmt::format("rtm: the emergency stop does not reach {}, which is not connected: stop it there",
                                    wanted.to));
    }
}

void RtmServer::serve() {
    follow_changes();
    std::vector<Line> lines;
    std::vector<RtcLink> joined, ended;
    {
        const std::lock_guard lock(mutex_);
        std::swap(lines, lines_);
        std::swap(joined, joined_);
        std::swap(ended, ended_);
    }
    for (const Line& line : lines) host_.say(line.is_problem, line.text);
    take_up(joined);
    take_away(ended);
    bool acted = false;
    inbox_.answer([&](const RtcRequest& request) {
        acted = true;
        const RtcAnswer answer = perform_now(request);
        take_snapshots();  // the next question must see the result of this request
        return answer;
    });
    if (!acted && std::chrono::steady_clock::now() - taken_at_ >= snapshot_period) take_snapshots();
}

// Adds connections that a tool has made to the system, as `connect` in a console does.
void RtmServer::take_up(const std::vector<RtcLink>& joined) {
    for (const RtcLink& link : joined) {
        const auto port = host_.system().port(link.path);
        if (!port) continue;
        const ConnectionSpec made = connection_of(link, (*port)->direction() == Direction::in);
        if (contains(wanted_, made)) continue;
        const auto connected = act(Connect{made.from, made.to});
        host_.say(
            !connected,
            connected
                ? fmt::format("connected by an RTC or a tool: {} to {}", made.from, made.to)
                : fmt::format("an RTC or a tool has connected {} to {}, but the system can't show this connection: {}",
                              shown(made.from), shown(made.to), connected.error().message));
    }
    follow_changes();
}

// Removes connections that a tool has ended from the system, as `disconnect` in a console does.
void RtmServer::take_away(const std::vector<RtcLink>& ended) {
    for (const RtcLink& link : ended) {
        const auto wanted = std::find_if(wanted_.begin(), wanted_.end(), [&](const ConnectionSpec& each) {
            return each == connection_of(link, true) || each == connection_of(link, false);
        });
        if (wanted == wanted_.end()) continue;
        const ConnectionSpec gone = *wanted;
        if (done(Disconnect{gone.from, gone.to}) != RtcAnswer::done) continue;
        host_.say(false, fmt::format("disconnected by an RTC or a tool: {} to {}; connect(\"{}\", \"{}\") makes it "
                                     "again",
                                     gone.from, gone.to, gone.from, gone.to));
    }
    follow_changes();
}

Expected<ActResult> RtmServer::act(const Act& act) { return host_.act(act, rtm_actor); }

RtcAnswer RtmServer::done(const Act& wanted) { return act(wanted) ? RtcAnswer::done : RtcAnswer::refused; }

RtcAnswer RtmServer::create(const RtcRequest& request) {
    if (!host_.create) return RtcAnswer::refused;
    if (host_.system().find(request.component) != nullptr) return RtcAnswer::taken;
    if (const auto made = host_.create(request); !made) {
        host_.say(true, fmt::format("rtm: a tool can't add '{}': {}", shown(request.script), describe(made.error())));
        return RtcAnswer::refused;
    }
    host_.say(false, fmt::format("rtm: a tool has added {} ({})", request.component, request.script));
    follow_changes();  // it is exported immediately
    return RtcAnswer::done;
}

RtcAnswer RtmServer::perform_now(const RtcRequest& request) {
    if (request.what == RtcRequest::What::create) return create(request);
    if (request.what == RtcRequest::What::end) {
        if (!host_.end) return RtcAnswer::refused;
        host_.say(false, "rtm: a tool ends the run");
        host_.end();
        return RtcAnswer::done;
    }
    const Component* component = host_.system().find(request.component);
    if (component == nullptr) return RtcAnswer::unknown;
    switch (request.what) {
        // As the standard requires: activating an active component is an error, and so on.
        case RtcRequest::What::activate:
            if (component->state() == LifeState::active) return RtcAnswer::refused;
            return done(Activate{request.component});
        case RtcRequest::What::deactivate:
            if (component->state() == LifeState::inactive) return RtcAnswer::refused;
            return done(Deactivate{request.component});
        case RtcRequest::What::reset: return done(Reset{request.component});
        case RtcRequest::What::use:
            // Tools that have changed the active set activate it again; that must not reset values.
            if (request.set == set_in_use(*component)) return RtcAnswer::done;
            return done(Use{request.component, request.set});
        case RtcRequest::What::set: return set_values(*component, request);
        case RtcRequest::What::connect: return done(Connect{request.from, request.to});
        case RtcRequest::What::disconnect: return done(Disconnect{request.from, request.to});
        case RtcRequest::What::exit: return done(Remove{request.component});
        case RtcRequest::What::create:
        case RtcRequest::What::end:
        case RtcRequest::What::forget: break;
    }
    return RtcAnswer::refused;
}

// Sets all values or none. Refuses an inactive set: its values are those of the file.
RtcAnswer RtmServer::set_values(const Component& component, const RtcRequest& request) {
    if (request.set != set_in_use(component)) return RtcAnswer::refused;
    std::vector<SetParameter> acts;
    for (const auto& [name, text] : request.values) {
        const auto* parameter = component.parameters().find(name);
        if (parameter == nullptr) return RtcAnswer::unknown;
        const auto value = from_rtc_text(text, parameter->spec.initial);
        if (!value || !check_value(parameter->spec, *value)) return RtcAnswer::refused;
        if (*value != parameter->value) acts.push_back({request.component, name, *value});
    }
    for (const SetParameter& act : acts) {
        if (const RtcAnswer answer = done(act); answer != RtcAnswer::done) return answer;
    }
    return RtcAnswer::done;
}

RtcSnapshot RtmServer::snapshot(std::string_view component) {
    const std::lock_guard lock(mutex_);
    const auto found = snapshots_.find(component);
    return found != snapshots_.end() ? found->second : RtcSnapshot{};
}

std::vector<RtcModule> RtmServer::modules() { return host_.modules ? host_.modules() : std::vector<RtcModule>{}; }

RtcAnswer RtmServer::perform(const RtcRequest& request) {
    if (host_.wake) host_.wake();
    return inbox_.ask(request, patience);
}

PutAnswer RtmServer::put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes,
                         std::endian order) {
    std::string problem;
    const PutAnswer answer = inbox_.put(path, from, bytes, order, problem);
    if (answer != PutAnswer::malformed) return answer;
    bool is_new = false;
    {
        const std::lock_guard lock(mutex_);
        is_new = malformed_.size() < most_told && malformed_.emplace(fmt::format("{} {}", path, from), problem).second;
    }
    if (is_new)
        tell(true,
             fmt::format("rtm: {} refuses a malformed message from connection '{}': {}", path, shown(from), problem));
    return answer;
}

void RtmServer::left(std::string_view path, std::string_view from) { inbox_.put_zero(path, from); }

std::future<Expected<std::string>> RtmServer::ask(PeerQuestion question) {
    const auto promise = std::make_shared<std::promise<Expected<std::string>>>();
    orb_->ask(std::move(question), [promise](const PeerQuestion& asked, const PeerAnswer& answer) {
        promise->set_value(told_of_peers(asked, answer));
    });
    return promise->get_future();
}

std::future<std::string> RtmServer::look() {
    const auto promise = std::make_shared<std::promise<std::string>>();
    orb_->ask({.is_whole = true}, [this, promise](const PeerQuestion& /*asked*/, const PeerAnswer& answer) {
        promise->set_value(peers_to_json(answer, own_context()));
        if (host_.wake) host_.wake();
    });
    return promise->get_future();
}

void RtmServer::joined(const RtcLink& link) {
    {
        const std::lock_guard lock(mutex_);
        joined_.push_back(link);
    }
    if (host_.wake) host_.wake();
}

void RtmServer::ended(const RtcLink& link) {
    {
        const std::lock_guard lock(mutex_);
        ended_.push_back(link);
    }
    if (host_.wake) host_.wake();
}

void RtmServer::tell(bool is_problem, std::string text) {
    {
        const std::lock_guard lock(mutex_);
        if (lines_.size() < most_lines) lines_.push_back({is_problem, std::move(text)});
    }
    if (host_.wake) host_.wake();
}

}  // namespace nezumi::openrtm
