// The consoles of a running system: a session for each client, whose looks and acts are served between ticks.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/console/session.hpp"
#include "bindings/console/transport.hpp"
#include "bindings/console/worker.hpp"
#include "engine/base/log.hpp"
#include "engine/base/mutex.hpp"
#include "engine/live/clock_control.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// All of it is to be called from the thread that ticks.
class ConsoleServer {
public:
    using Clock = std::chrono::steady_clock;

    /// Both must outlive it.
    ConsoleServer(RunningSystem& live, ClockControl& clock) : live_(live), clock_(clock) {}
    /// Ends what runs; what can't be ended within a second goes on without it.
    ~ConsoleServer();
    ConsoleServer(const ConsoleServer&) = delete;
    ConsoleServer& operator=(const ConsoleServer&) = delete;

    /// Lets `nezumi attach` in, by a socket named after the system. On an error nobody can attach; nothing else
    /// changes.
    Expected<void> listen(std::string_view name, const std::filesystem::path& folder = console_folder());
    /// Lends it what `picture` and `graph` draw with.
    void draw_by(DrawingMaker drawing_maker) { drawing_maker_ = std::move(drawing_maker); }
    /// Lends it what `new` writes with.
    void write_by(BehaviorAuthor author) { author_ = std::move(author); }
    /// Lends it what asks components of other programs.
    void ask_peers_by(PeerAsker peers) { peers_ = std::move(peers); }
    /// What a client in this process is for.
    enum class Use {
        prompt,  ///< somebody types, while time passes
        batch,   ///< commands come from a file: nothing that is said is left out, and time moves only by their order
    };
    /// Returns the other end of a connection, for a client in this process; `who` is who acts by it.
    Expected<Descriptor> connect(Use use, const Actor& who = {Actor::Kind::console});

    /// Deals with what clients sent and with what their sessions want of the system, and while one of them works waits
    /// for that, until about `until`. Returns whether more may come.
    bool serve(Clock::time_point until);
    /// After every tick.
    void after_tick();
    /// A command of a `Use::batch` has begun and is not answered.
    bool batch_works() const;
    /// A client of `Use::batch` takes less than is said.
    bool is_behind() { return transport_.is_behind(); }
    /// Readable when something has come that `serve` should deal with.
    int file() const { return transport_.file(); }

    /// What a client hears of the log before it says otherwise.
    static constexpr LogLevel usual_level = LogLevel::info;

    /// Tells the clients that want to know. From any thread.
    void log(const LogLine& line);
    void say(const std::string& text);
    /// The same for the state in one line.
    void show_status(const std::string& text, bool running);

private:
    struct Console {
        std::unique_ptr<Session> session;     // made when it is first needed
        std::deque<Request> waiting;          // in the order in which they came
        std::optional<std::int64_t> running;  // the request whose input the session works at
        bool keys = false;
        bool batch = false;
        Actor who{Actor::Kind::console};
    };

    void tell(const Event& event, LogLevel level = LogLevel::error);
    bool set_log_level(ClientId id, LogLevel level);
    void take(const Transport::Incoming& incoming);
    void end_holds_of(const Actor& who);
    void interrupt(ClientId id, Console& console);
    void deal_with(ClientId id, Console& console);
    Expected<Session*> session_of(ClientId id, Console& console);
    void answer(ClientId id, Event event);
    bool serve_sessions(Clock::time_point until);

    RunningSystem& live_;
    ClockControl& clock_;
    DrawingMaker drawing_maker_;
    BehaviorAuthor author_;
    PeerAsker peers_;
    Bell bell_;  // of all sessions
    std::map<ClientId, Console> consoles_;
    std::vector<std::unique_ptr<Session>> leaving_;  // closed: their clients are gone
    ClientId last_served_ = 0;
    Mutex mutex_;                             // of listeners_
    std::map<ClientId, LogLevel> listeners_;  // who wants the log, from which level on
    Transport transport_;
};

/// A log line as consoles show it.
std::string console_line(const LogLine& line);

}  // namespace nezumi
