// The prompt of the run is a client like an attached console. It has its own thread, so reading a terminal delays no
// tick.
#include "bindings/cli/run/console.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <utility>

#include "bindings/cli/new/behavior.hpp"
#include "bindings/console/client.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/draw/picture.hpp"
#include "bindings/draw/wiring_graph.hpp"
#include "bindings/openrtm/system_profile.hpp"
#include "bindings/terminal/batch.hpp"
#include "bindings/terminal/input_history.hpp"
#include "bindings/terminal/terminal.hpp"
#include "engine/base/visible.hpp"
#include "engine/base/whole_file.hpp"
#include "sim/picture.hpp"

namespace nezumi::cli {
namespace {

// The interval of status messages, for the terminal's title.
constexpr std::chrono::seconds status_period{1};

}  // namespace

bool has_terminal() {
    return isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) == getpgrp();
}

RunConsole::RunConsole(RunLoop& loop, const std::string& name)
    : loop_(loop), name_(visible(name)), server_(std::make_unique<ConsoleServer>(loop.live(), loop)) {
    server_->draw_by([&live = loop.live(), title = name_](Drawn what) -> Drawing {
        if (what == Drawn::wiring) {
            return [wiring = draw::wiring_of(live, title)](const std::string& file) {
                return draw::draw_wiring(wiring, file);
            };
        }
        if (what == Drawn::profile) {
            return [profile = openrtm::profile_of_system(live.system(), live.spec())](const std::string& file) {
                const std::time_t now = std::time(nullptr);  // the wall clock: a profile has the date of its saving
                const std::string date = fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(now));
                const auto format =
                    file.ends_with(".yaml") ? openrtm::ProfileFormat::yaml : openrtm::ProfileFormat::xml;
                return openrtm::write_system_profile(profile, date, format).and_then([&](const std::string& text) {
                    return write_whole(file, text);
                });
            };
        }
        return [seen = draw::look_at(live, {}, title)](const std::string& file) {
            return draw::draw_picture(seen, file, sim::read_picture);
        };
    });
    server_->write_by(write_new_behavior);
}

RunConsole::~RunConsole() { close(); }

void RunConsole::close() {
    server_.reset();
    if (client_.joinable()) client_.join();
}

Expected<void> RunConsole::open_prompt(const std::string& news) {
    auto socket = server_->connect(ConsoleServer::Use::prompt);
    if (!socket) return Unexpected(socket.error());
    std::string greeting = name_ + " is running; help() shows the commands, Ctrl-D ends it";
    if (!news.empty()) greeting += "\n" + news;
    client_ = std::thread([this, greeting, client = ConsoleClient(std::move(*socket))]() mutable {
        const auto end = run_prompt(client, {.greeting = greeting, .history = history_path()});
        if (!end) put_text(stderr, fmt::format("nezumi: {}\n", describe(end.error())));
        left_ = true;
        client.close();  // wakes the loop
    });
    return {};
}

Expected<void> RunConsole::open_batch() {
    auto socket = server_->connect(ConsoleServer::Use::batch);
    if (!socket) return Unexpected(socket.error());
    loop_.pause();
    client_ = std::thread([this, client = ConsoleClient(std::move(*socket))]() mutable {
        const BatchEnd end = run_batch(client, {.own = true});
        all_well_ = end.well;
        unfinished_ = end.unfinished;
        left_ = true;
        client.close();
    });
    return {};
}

bool RunConsole::log(const LogLine& line) {
    if (server_) server_->log(line);
    return server_ && client_.joinable() && !left_;
}

bool RunConsole::say(const std::string& text) {
    if (server_) server_->say(text);
    return server_ && client_.joinable() && !left_;
}

bool RunConsole::serve(Pacer::Clock::time_point until) {
    const bool more = server_->serve(until);
    if (left_) loop_.quit();
    show_status();
    return more;
}

void RunConsole::show_status() {
    const auto now = Pacer::Clock::now();
    const bool paused = loop_.is_paused();
    if (now - shown_ < status_period && paused == was_paused_) return;
    const double seconds = loop_.live().system().now().seconds;
    const double wall = std::chrono::duration<double>(now - shown_).count();
    const std::string how = paused ? "paused" : fmt::format("{:.2f}x", (loop_.advanced() - simulated_) / wall);
    const Lateness lateness = loop_.lateness();
    const std::string late = lateness.ticks() > 0 ? "  late by " + to_text(lateness) : "";
    const std::string status = fmt::format("{}  {:.1f} s  {}{}", name_, seconds, how, late);
    server_->show_status(status, !paused);
    if (show_) show_(status, !paused);
    shown_ = now;
    simulated_ = loop_.advanced();
    was_paused_ = paused;
}

}  // namespace nezumi::cli
