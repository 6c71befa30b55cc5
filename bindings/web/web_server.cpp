// The browsers' requests are processed in order between two ticks, in the remaining time.
#include "bindings/web/web_server.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "bindings/web/relay.hpp"
#include "bindings/web/remembered_json.hpp"
#include "bindings/web/system_json.hpp"
#include "bindings/web/types_json.hpp"
#include "engine/base/json_text.hpp"
#include "engine/base/visible.hpp"
#include "engine/project/writable_folder.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view only_real_time = "this works only in simulation: real robots always run in real time";

// The greeting without the browser's own fields and without the opening bracket.
std::string hello(const RunningSystem& live, const WebOptions& options) {
    const Json json{
        {"version", options.version}, {"real", live.system().settings().real_time}, {"frame", "WebFrame"},
        {"callbacks", hook_names()},  {"conditions", options.conditions},           {"types", types_to_json()}};
    return json_text(json).substr(1);
}

std::string scheme_of(const SocketOptions& sockets) { return sockets.certificate.empty() ? "http" : "https"; }

}  // namespace

WebServer::WebServer(RunningSystem& live, ClockControl& clock, ConsoleServer& consoles, const WebOptions& options)
    : live_(live),
      clock_(clock),
      origin_(scheme_of(options.sockets) + "://" + options.sockets.address),
      hub_(options.sockets.relay >= 0 ? AccessControl::closed()
                                      : AccessControl(scheme_of(options.sockets), options.sockets.address),
           StaticFiles(options.page), live.part_reader(), hello(live, options)),
      state_reader_(live, clock),
      drives_(live,
              [this](ClientId client, const std::string& port, const std::string& why) {
                  hub_.send(client, json_text(Json{{"is", "drive"}, {"port", port}, {"ok", false}, {"text", why}}));
              }),
      relay_(consoles,
             [this](ClientId client, std::string_view line) {
                 hub_.send(client, fmt::format(R"({{"is":"console","event":{}}})", line), true);
             }),
      seeks_(live, clock,
             [this](ClientId client, std::int64_t id, const Expected<void>& done) { answer(client, id, done); }),
      explanations_(live, clock,
                    [this](ClientId client, std::string message) { hub_.send(client, std::move(message)); }),
      earlier_(
          live, clock, [this](ClientId client, std::string message) { hub_.send(client, std::move(message), true); },
          [this](ClientId client, std::int64_t id, const Expected<void>& done) { answer(client, id, done); }),
      peers_(options.peers,
             [this](ClientId client, std::int64_t id, const Expected<void>& done) { answer(client, id, done); }) {}

Expected<std::unique_ptr<WebServer>> WebServer::open(RunningSystem& live, ClockControl& clock, ConsoleServer& consoles,
                                                     const WebOptions& options) {
    std::unique_ptr<WebServer> server(new WebServer(live, clock, consoles, options));
    if (!options.only_shows.empty()) server->hub_.only_show(options.only_shows);
    const AccessControl& access = server->hub_.access();
    if (options.sockets.relay < 0 && (access.token().empty() || access.view_token().empty()))
        return failure("the kernel gives no random numbers for the secret in the page's address");
    auto sockets = open_sockets(options.sockets, server->hub_);
    if (!sockets) return Unexpected(sockets.error());
    server->sockets_ = std::move(*sockets);
    server->pictures_ = std::make_unique<Pictures>(
        options.encode,
        [&hub = server->hub_, &wakes = *server->sockets_](const std::string& port, std::string message) {
            hub.show_picture(port, std::move(message));
            wakes.wake();
        },
        [&hub = server->hub_, &wakes = *server->sockets_](const std::string& why) {
            hub.send_all(
                json_text(Json{{"is", "log"}, {"level", "error"}, {"component", ""}, {"text", why}, {"at", 0}}), true);
            wakes.wake();
        });
    server->editor_ = std::make_unique<Editor>(
        live.project(), writable_folder(live.project(), live.spec().file), options.editor,
        [&hub = server->hub_, &wakes = *server->sockets_](ClientId client, std::string answer) {
            hub.send(client, std::move(answer));
            wakes.wake();
        });
    server->scenarios_ = std::make_unique<ScenarioRuns>(
        live.project().root(), options.editor.program,
        options.sockets.certificate.empty() ? "" : options.sockets.address,
        [&hub = server->hub_, &wakes = *server->sockets_](ClientId client, std::string answer) {
            hub.send(client, std::move(answer));
            wakes.wake();
        });
    return server;
}

WebServer::~WebServer() {
    scenarios_.reset();
    editor_.reset();
    pictures_.reset();
    hub_.end(json_text(Json{{"is", "bye"}, {"text", "the run has ended"}}));
    if (sockets_) sockets_->wake();
}

std::string WebServer::url_with(const std::string& token) const {
    return fmt::format("{}:{}/#{}", origin_, sockets_->port(), token);
}

std::string WebServer::url() const { return url_with(hub_.access().token()); }

std::string WebServer::view_url() const { return url_with(hub_.access().view_token()); }

bool WebServer::is_watched() const { return !browsers_.empty() && browsers_.rbegin()->first != own_client; }

void WebServer::show_end(const std::string& text, bool is_good) {
    hub_.show(Hub::Slot::ended, json_text(Json{{"is", "ended"}, {"text", text}, {"good", is_good}}));
    sockets_->wake();
}

void WebServer::add_files(std::vector<int>& files) const {
    files.push_back(hub_.file());
    relay_.add_files(files);
}

bool WebServer::serve(Clock::time_point until, double late) {
    for (Hub::Incoming& incoming : hub_.take()) put_in_order(waiting_, dealt_, std::move(incoming));
    while (dealt_ < waiting_.size()) {
        deal_with(waiting_[dealt_++]);
        if (Clock::now() >= until) break;
    }
    if (dealt_ == waiting_.size()) {
        waiting_.clear();
        dealt_ = 0;
    }
    finish_prepared();
    const bool seeks = seeks_.serve(until);
    const auto now = Clock::now();
    drives_.serve(now);
    relay_.serve();
    if (hub_.has_clients()) {
        describe_system(now);
        show(late, now);
    }
    if (auto news = peers_.serve(peers_.is_due(now) && hub_.has_clients() && hub_.wanted().peers, now)) {
        hub_.show(Hub::Slot::peers, std::move(*news));
        sockets_->wake();
    }
    const bool explains = explanations_.serve(until);
    const bool recalls = !seeks && earlier_.serve(until);
    return seeks || explains || recalls || dealt_ < waiting_.size();
}

void WebServer::deal_with(const Hub::Incoming& incoming) {
    const ClientId id = incoming.client;
    if (incoming.what == Hub::Incoming::What::opened) {
        Browser& browser = browsers_[id];
        browser = {{Actor::Kind::browser, std::to_string(id)}, incoming.view_only};
        note(browser, incoming.view_only ? "has connected, view only" : "has connected");
        return;
    }
    const auto found = browsers_.find(id);
    if (found == browsers_.end()) return;
    if (incoming.what == Hub::Incoming::What::closed) {
        live_.let_go(found->second.who);
        drives_.forget(id);
        relay_.close(id);
        explanations_.forget(id);
        earlier_.forget(id);
        note(found->second, "has disconnected");
        browsers_.erase(found);
        return;
    }
    const BrowserMessage& message = incoming.message;
    const auto done = perform(id, found->second, message);
    if (const auto* drive = std::get_if<DriveMessage>(&message.body)) {
        if (!done)
            hub_.send(id, json_text(Json{
                              {"is", "drive"}, {"port", drive->port}, {"ok", false}, {"text", done.error().message}}));
        return;
    }
    if (!done) return answer(id, message.id, Unexpected(done.error()));
    if (*done == Reply::now) answer(id, message.id, {});
}

void WebServer::answer(ClientId client, std::int64_t id, const Expected<void>& done) {
    hub_.send(client, json_text(Json{{"is", "answer"},
                                     {"id", id},
                                     {"ok", done.has_value()},
                                     {"text", done ? "" : nezumi::describe(done.error())}}));
}

// Called before the request is executed, because its effects may be logged too.
void WebServer::note(const Browser& browser, const std::string& what) {
    live_.system().log(LogLevel::info, to_text(browser.who) + ": " + what);
}

Expected<WebServer::Reply> WebServer::perform(ClientId client, const Browser& browser, const BrowserMessage& message) {
    if (const auto* act = std::get_if<ActMessage>(&message.body)) {
        if (takes_files(act->act)) return prepare(client, message.id, browser, *act);
        note(browser, act->shown);
        if (const auto* where = std::get_if<Seek>(&act->act)) {
            if (auto ok = seeks_.begin(client, message.id, browser.who, *where); !ok) return Unexpected(ok.error());
            return Reply::later;
        }
        const auto result = live_.act(act->act, browser.who);
        if (!result) return Unexpected(result.error());
        return Reply::now;
    }
    const auto replied = [](const Expected<void>& done, Reply reply) -> Expected<Reply> {
        if (!done) return Unexpected(done.error());
        return reply;
    };
    if (const auto* drive = std::get_if<DriveMessage>(&message.body))
        return replied(drives_.take(client, *drive, browser.who, Clock::now()), Reply::later);
    if (const auto* console = std::get_if<ConsoleMessage>(&message.body)) {
        if (!console->shown.empty()) note(browser, console->shown);
        return replied(relay_.send(client, console->line, browser.who), Reply::later);
    }
    if (const auto* wanted = std::get_if<ExplainMessage>(&message.body)) {
        return replied(explanations_.ask(client, wanted->component), Reply::now);
    }
    if (const auto* peer = std::get_if<PeerMessage>(&message.body)) {
        note(browser, peer->shown);
        return replied(peers_.ask(client, message.id, peer->request), Reply::later);
    }
    if (const auto* edit = std::get_if<EditMessage>(&message.body)) {
        if (edit->what == EditMessage::What::save) note(browser, "saves " + visible_message(edit->file));
        return replied(editor_->start(client, message.id, *edit), Reply::later);
    }
    if (const auto* test = std::get_if<TestMessage>(&message.body)) {
        if (test->what == TestMessage::What::run) note(browser, "runs scenarios");
        return replied(scenarios_->start(client, message.id, *test), Reply::later);
    }
    if (const auto* wanted = std::get_if<RememberedMessage>(&message.body)) {
        auto remembered = remembered_to_json(live_, wanted->branch, wanted->rows);
        if (!remembered) return Unexpected(remembered.error());
        if (!wanted->port.empty()) add_numbers(*remembered, live_.trace(), wanted->port);
        hub_.send(client, json_text(*remembered), true);
        return Reply::now;
    }
    if (const auto* then = std::get_if<ThenMessage>(&message.body)) {
        earlier_.ask_then(client, then->at, then->names);
        return Reply::now;
    }
    if (const auto* wanted = std::get_if<EarlierMessage>(&message.body))
        return replied(earlier_.ask_port(client, message.id, wanted->port), Reply::later);
    if (const auto* time = std::get_if<TimeMessage>(&message.body)) {
        if (time->what == TimeMessage::What::restart)
            return prepare(client, message.id, browser, {.act = Restart{}, .shown = "restarts the system"});
        return replied(set_time(*time, browser), Reply::now);
    }
    return Reply::later;
}

// Prepares an act in another thread, because it reads files, and ticks must not wait for files.
Expected<WebServer::Reply> WebServer::prepare(ClientId client, std::int64_t id, const Browser& browser,
                                              const ActMessage& wanted) {
    if (clock_.is_hardware() && std::holds_alternative<Restart>(wanted.act))
        return failure(std::string(only_real_time));
    if (!worker_.is_idle()) return failure("another act is still being prepared: try again when it is done");
    prepared_ = {client, id, browser.who, wanted};
    worker_.start(live_.prepare(wanted.act));
    return Reply::later;
}

void WebServer::finish_prepared() {
    auto prepared = worker_.take();
    if (!prepared) return;
    if (!live_.fits(*prepared)) return worker_.start(live_.prepare(prepared_.wanted.act));
    Expected<void> done;
    if (!prepared->error && !prepared->lost.empty()) {
        done = failure(fmt::format("{} would be lost: save the system first", fmt::join(prepared->lost, ", ")));
    } else {
        if (!prepared->error)
            live_.system().log(LogLevel::info, to_text(prepared_.who) + ": " + prepared_.wanted.shown);
        const auto performed = live_.commit(std::move(*prepared), prepared_.who);
        if (!performed) done = Unexpected(performed.error());
    }
    answer(prepared_.client, prepared_.id, done);
}

Expected<void> WebServer::set_time(const TimeMessage& time, const Browser& browser) {
    using What = TimeMessage::What;
    if (clock_.is_hardware() && (time.what == What::step || time.what == What::speed))
        return failure(std::string(only_real_time));
    const double value = time.value.value_or(1);
    const auto note = [&](const std::string& what) { this->note(browser, what); };
    switch (time.what) {
        case What::pause:
            note("pauses");
            clock_.pause();
            return {};
        case What::resume:
            note("resumes");
            clock_.resume();
            return {};
        case What::step: {
            const auto ticks = check_ticks(value);
            if (!ticks) return Unexpected(ticks.error());
            note(fmt::format("steps {} ticks", *ticks));
            clock_.advance(*ticks);
            return {};
        }
        case What::speed: {
            const auto speed = check_speed(value);
            if (!speed) return Unexpected(speed.error());
            note(fmt::format("sets the speed to {}", *speed));
            clock_.set_speed(*speed);
            return {};
        }
        case What::restart: return {};  // restart is handled before this function
        case What::quit:
            note("ends the run");
            clock_.quit();
            return {};
    }
    return {};
}

void WebServer::describe_system(Clock::time_point now) {
    // After a change of the layout, browsers need the description at once: frames refer to it.
    const bool other = layout_ != live_.system().layout() || starts_ != live_.generation();
    if (!other && now - described_ < std::chrono::duration<double>(1 / descriptions)) return;
    described_ = now;
    const std::uint64_t fingerprint = system_fingerprint(live_);
    if (!other && fingerprint == fingerprint_) return;
    fingerprint_ = fingerprint;
    layout_ = live_.system().layout();
    starts_ = live_.generation();
    const auto& floor = live_.spec().arena.floor;
    hub_.show_floor(floor && live_.system().world() != nullptr ? floor->image : "");
    hub_.show(Hub::Slot::system, json_text(system_to_json(live_)));
    sockets_->wake();
}

void WebServer::show(double late, Clock::time_point now) {
    if (now < due_) return;
    // The next time is counted from the due time, not from now: otherwise ticks of 10 ms would give 50 states a second.
    constexpr auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / states));
    due_ = (now - due_ < period ? due_ : now) + period;
    const Watch wanted = hub_.wanted();
    hub_.put(state_reader_.at(hub_.take_back(), wanted, late));
    pictures_->look(live_.system(), wanted.pictures, now);
    sockets_->wake();
}

void WebServer::log(const LogLine& line) {
    hub_.log(json_text(Json{{"is", "log"},
                            {"level", to_text(line.level)},
                            {"component", line.component},
                            {"text", line.text},
                            {"at", line.seconds}}));
}

void WebServer::say(const std::string& text) {
    hub_.log(json_text(Json{
        {"is", "log"}, {"level", "info"}, {"component", ""}, {"text", text}, {"at", live_.system().now().seconds}}));
}

void WebServer::show_status(const std::string& text, bool running) {
    hub_.show(Hub::Slot::status, json_text(Json{{"is", "status"}, {"text", text}, {"running", running}}));
}

}  // namespace nezumi::web
