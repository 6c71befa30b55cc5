// The consoles of a running system: a session for each client. Reads and acts are done between ticks.
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

/// Call all functions from the ticking thread.
class ConsoleServer {
public:
    using Clock = std::chrono::steady_clock;

    /// `live` and `clock` must outlive this object.
    ConsoleServer(RunningSystem& live, ClockControl& clock) : live_(live), clock_(clock) {}
    /// Stops running inputs. If one does not end within a second, its thread is abandoned.
    ~ConsoleServer();
    ConsoleServer(const ConsoleServer&) = delete;
    ConsoleServer& operator=(const ConsoleServer&) = delete;

    /// Lets `nezumi attach` connect, through a socket with the name of the system. On an error clients can't attach;
    /// nothing else changes.
    Expected<void> listen(std::string_view name, const std::filesystem::path& folder = console_folder());
    /// Sets the function that `picture` and `graph` draw with.
    void draw_by(DrawingMaker drawing_maker) { drawing_maker_ = std::move(drawing_maker); }
    /// Sets the function that `new` writes with.
    void write_by(BehaviorAuthor author) { author_ = std::move(author); }
    /// Sets the function that sends requests to components of other programs.
    void ask_peers_by(PeerAsker peers) { peers_ = std::move(peers); }
    /// The purpose of a client in this process.
    enum class Use {
        prompt,  ///< a person types, while time passes
        batch,   ///< commands come from a file: no output is dropped, and time passes only by commands such as `step`
    };
    /// Returns the client's end of a connection, for a client in this process. `who` is the actor of its acts.
    Expected<Descriptor> connect(Use use, const Actor& who = {Actor::Kind::console});

    /// Handles requests of clients, and requests of their sessions to the system. While a session works, waits for its
    /// requests, until about `until`. Returns whether more requests may come.
    bool serve(Clock::time_point until);
    /// Call this after every tick.
    void after_tick();
    /// Whether a command of a `Use::batch` client is running.
    bool is_batch_running() const;
    /// True if a `Use::batch` client reads its output too slowly, so that the run should wait.
    bool is_behind() { return transport_.is_behind(); }
    /// A file descriptor that is readable if there is something for `serve`.
    int file() const { return transport_.file(); }

    /// The log level of a client that has not set one.
    static constexpr LogLevel usual_level = LogLevel::info;

    /// Sends the line to the clients that want the log. Can be called from any thread.
    void log(const LogLine& line);
    void say(const std::string& text);
    /// Sends the status line to the clients.
    void show_status(const std::string& text, bool running);

private:
    struct Console {
        std::unique_ptr<Session> session;     // made when it is first needed
        std::deque<Request> waiting;          // in the order in which they came
        std::optional<std::int64_t> running;  // the request that the session works on
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
    std::vector<std::unique_ptr<Session>> leaving_;  // closed sessions; their threads may still run
    ClientId last_served_ = 0;
    Mutex mutex_;                             // of listeners_
    std::map<ClientId, LogLevel> listeners_;  // clients that want the log, with their levels
    Transport transport_;
};

/// A log line as consoles show it.
std::string console_line(const LogLine& line);

}  // namespace nezumi
