// Handles the requests of a client one after the other. Only an interrupt and keys are handled immediately.
#include "bindings/console/server.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "engine/base/visible.hpp"

namespace nezumi {
namespace {

// The names of keys, in the order of the enumerators.
constexpr std::array<std::string_view, 8> key_names{"up",    "down",   "left",   "right",
                                                    "space", "escape", "faster", "slower"};

// The actor of programs that act for a person, such as a language model. Their holds are released separately from the
// holds of the user's consoles.
constexpr std::string_view agent_word = "agent";
Actor agent() { return {Actor::Kind::console, std::string(agent_word)}; }

}  // namespace

ConsoleServer::~ConsoleServer() {
    for (auto& [id, console] : consoles_) {
        if (console.session) console.session->close();
    }
}

Expected<void> ConsoleServer::listen(std::string_view name, const std::filesystem::path& folder) {
    if (auto ok = transport_.ready(); !ok) return ok;
    auto listener = Listener::open(name, folder);
    if (!listener) return Unexpected(listener.error());
    transport_.listen(std::move(*listener), geteuid());
    return {};
}

Expected<Descriptor> ConsoleServer::connect(Use use, const Actor& who) {
    if (auto ok = transport_.ready(); !ok) return Unexpected(ok.error());
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return failure(std::string("can't open a console: ") + std::strerror(errno));
    const bool batch = use == Use::batch;
    const ClientId id = transport_.add(Descriptor(ends[0]), batch ? Transport::Flow::lossless : Transport::Flow::lossy);
    consoles_[id].batch = batch;
    consoles_[id].who = who;
    return Descriptor(ends[1]);
}

bool ConsoleServer::serve(Clock::time_point until) {
    for (;;) {
        bell_.clear();
        for (const Transport::Incoming& incoming : transport_.take()) take(incoming);
        std::erase_if(leaving_, [](const auto& session) { return session->has_ended(); });
        if (!serve_sessions(until)) return false;
        if (!bell_.wait(until, transport_.file())) return true;
    }
}

// Lets the sessions work until about `until`. Returns whether one of them has more to do.
bool ConsoleServer::serve_sessions(Clock::time_point until) {
    bool works = false;
    // Starts after the session that was served last, so that no session takes all the time.
    auto turn = consoles_.upper_bound(last_served_);
    for (std::size_t count = consoles_.size(); count > 0; --count, ++turn) {
        if (turn == consoles_.end()) turn = consoles_.begin();
        auto& [id, console] = *turn;
        while (!console.running && !console.waiting.empty()) deal_with(id, console);
        if (!console.session || !console.session->is_busy()) continue;
        last_served_ = id;
        console.session->serve(until);
        const bool begins = !console.running && !console.waiting.empty();
        works = works || begins || (console.session->is_busy() && !console.session->is_waiting());
        if (works && Clock::now() >= until) break;
    }
    return works;
}

void ConsoleServer::after_tick() {
    for (auto& [id, console] : consoles_) {
        if (console.session) console.session->after_tick();
    }
}

bool ConsoleServer::is_batch_running() const {
    return std::any_of(consoles_.begin(), consoles_.end(),
                       [](const auto& each) { return each.second.batch && each.second.running; });
}

void ConsoleServer::tell(const Event& event, LogLevel level) {
    std::map<ClientId, LogLevel> listeners;
    {
        const std::lock_guard lock(mutex_);
        listeners = listeners_;
    }
    for (const auto& [id, least] : listeners) {
        if (level >= least) transport_.send(id, event);
    }
}

bool ConsoleServer::set_log_level(ClientId id, LogLevel level) {
    const std::lock_guard lock(mutex_);
    const auto listener = listeners_.find(id);
    if (listener == listeners_.end()) return false;
    listener->second = level;
    return true;
}

void ConsoleServer::log(const LogLine& line) {
    tell({.kind = Event::Kind::log, .text = console_line(line), .level = std::string(to_text(line.level))}, line.level);
}

void ConsoleServer::say(const std::string& text) { tell({.kind = Event::Kind::output, .text = text}); }

void ConsoleServer::show_status(const std::string& text, bool running) {
    tell({.kind = Event::Kind::status, .ok = running, .text = text});
}

void ConsoleServer::take(const Transport::Incoming& incoming) {
    const ClientId id = incoming.client;
    if (incoming.what == Transport::Incoming::What::opened) {
        consoles_[id];
        return;
    }
    if (incoming.what == Transport::Incoming::What::closed) {
        if (auto& session = consoles_[id].session) {
            session->close();
            leaving_.push_back(std::move(session));
        }
        const Actor who = consoles_[id].who;
        consoles_.erase(id);
        end_holds_of(who);
        const std::lock_guard lock(mutex_);
        listeners_.erase(id);
        return;
    }
    Console& console = consoles_[id];
    const Request& request = incoming.request;
    switch (request.kind) {
        case Request::Kind::interrupt:
            interrupt(id, console);
            transport_.finish_request(id);
            return;
        case Request::Kind::key: {
            const auto* const name = std::find(key_names.begin(), key_names.end(), request.text);
            if (name != key_names.end() && console.session)
                console.session->key(static_cast<Key>(name - key_names.begin()));
            transport_.finish_request(id);
            return;
        }
        case Request::Kind::hello: {
            console.keys = request.keys;
            // A session keeps its actor, so the actor can be set only before there is a session.
            if (!console.session && (request.who == "spreadsheet" || request.who == agent_word)) {
                const Actor who = request.who == agent_word ? agent() : Actor{Actor::Kind::spreadsheet};
                end_holds_of(std::exchange(console.who, who));
            }
            const std::lock_guard lock(mutex_);
            listeners_.erase(id);
            if (request.log) listeners_.emplace(id, usual_level);
            transport_.finish_request(id);
            return;
        }
        case Request::Kind::eval:
        case Request::Kind::complete:
        case Request::Kind::is_complete: console.waiting.push_back(request); return;
    }
}

// Releases the ports that an actor holds, when its last connection has ended. Only in a simulation, the holds of a
// user's consoles remain: a shell script may hold a port with one `nezumi attach` and read values with the next.
void ConsoleServer::end_holds_of(const Actor& who) {
    const bool goes_with_it = who.kind == Actor::Kind::spreadsheet || who == agent() ||
                              (who.kind == Actor::Kind::console && live_.system().settings().real_time);
    const auto is_same = [&](const auto& each) { return each.second.who == who; };
    if (goes_with_it && std::none_of(consoles_.begin(), consoles_.end(), is_same)) live_.let_go(who);
}

void ConsoleServer::interrupt(ClientId id, Console& console) {
    for (const Request& request : std::exchange(console.waiting, {}))
        answer(id, {.kind = Event::Kind::answer, .id = request.id, .ok = false, .text = {}});
    if (console.session) console.session->interrupt();
}

void ConsoleServer::deal_with(ClientId id, Console& console) {
    const Request request = std::move(console.waiting.front());
    console.waiting.pop_front();
    if (request.kind == Request::Kind::is_complete) {
        const bool complete = Session::is_complete(request.text);
        return answer(id, {.kind = Event::Kind::answer, .id = request.id, .ok = complete, .text = {}});
    }
    const auto session = session_of(id, console);
    if (!session) {
        transport_.send(id, {.kind = Event::Kind::error, .text = session.error().message});
        return answer(id, {.kind = Event::Kind::answer, .id = request.id, .ok = false, .text = {}});
    }
    console.running = request.id;
    if (request.kind == Request::Kind::complete) {
        (*session)->complete(request.text, request.cursor, [this, id, &console](Completion found) {
            const std::int64_t question = *std::exchange(console.running, std::nullopt);
            answer(id, {.kind = Event::Kind::completions,
                        .id = question,
                        .text = {},
                        .from = found.from,
                        .items = std::move(found.candidates)});
        });
        return;
    }
    (*session)->submit(request.text);
}

Expected<Session*> ConsoleServer::session_of(ClientId id, Console& console) {
    if (console.session) return console.session.get();
    SessionOptions options;
    options.batch = console.batch;
    options.who = console.who;
    options.drawing_maker = drawing_maker_;
    options.author = author_;
    options.peers = peers_;
    options.bell = &bell_;
    options.output.show = [this, id](std::string_view text) {
        transport_.send(id, {.kind = Event::Kind::output, .text = std::string(text)});
    };
    options.output.takes_more = [this, id] { return transport_.takes_more(id); };
    options.output.show_in_place = [this, id](std::string_view text) {
        transport_.send(
            id, {.kind = Event::Kind::output, .text = std::string(text), .level = std::string(Event::in_place)});
    };
    options.output.show_error = [this, id](std::string_view text) {
        transport_.send(id, {.kind = Event::Kind::error, .text = std::string(text)});
    };
    options.output.done = [this, id, &console](bool well) {
        const auto request = std::exchange(console.running, std::nullopt);
        if (request) answer(id, {.kind = Event::Kind::answer, .id = *request, .ok = well, .text = {}});
    };
    options.output.log_level = [this, id](LogLevel level) { return set_log_level(id, level); };
    if (console.keys) {
        options.output.take_keys = [this, id](TakenKeys keys) {
            transport_.send(id, {.kind = Event::Kind::keys,
                                 .ok = keys != TakenKeys::none,
                                 .text = keys == TakenKeys::escape ? Event::only_escape : ""});
        };
    }
    auto session = Session::create(live_, clock_, std::move(options));
    if (!session) return Unexpected(session.error());
    console.session = std::move(*session);
    return console.session.get();
}

void ConsoleServer::answer(ClientId id, Event event) {
    transport_.send(id, std::move(event));
    transport_.finish_request(id);
}

std::string console_line(const LogLine& line) {
    const std::string who = line.component.empty() ? "" : line.component + ": ";
    return fmt::format("[{:9.3f}] {:5} {}{}", line.seconds, to_text(line.level), who, visible_message(line.text));
}

}  // namespace nezumi
