// The browsers of a running system: shows them its state, and executes their requests between two ticks.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings/console/server.hpp"
#include "bindings/web/console_relay.hpp"
#include "bindings/web/drives.hpp"
#include "bindings/web/earlier.hpp"
#include "bindings/web/editor.hpp"
#include "bindings/web/explanations.hpp"
#include "bindings/web/hub.hpp"
#include "bindings/web/peer_desk.hpp"
#include "bindings/web/pictures.hpp"
#include "bindings/web/scenario_runs.hpp"
#include "bindings/web/seeks.hpp"
#include "bindings/web/sockets.hpp"
#include "bindings/web/state_reader.hpp"
#include "engine/live/act_worker.hpp"
#include "engine/live/clock_control.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::web {

struct WebOptions {
    SocketOptions sockets{};
    std::filesystem::path page{};  ///< folder of the page's files
    std::string version{};         ///< of nezumi
    Pictures::Encode encode{};     ///< encodes pictures for browsers
    PeerSource peers{};            ///< optional
    EditorOptions editor{};
    std::string only_shows{};               ///< why browsers may change only the pace of time; "": they may change all
    std::vector<std::string> conditions{};  ///< of a failed scenario that the page shows, one line each
};

/// Must be called from the ticking thread.
class WebServer {
public:
    using Clock = std::chrono::steady_clock;

    /// The most states per second for a browser, and the most descriptions of the system per second.
    static constexpr double states = 60;
    static constexpr double descriptions = 10;

    /// Starts to serve. All arguments must outlive the server. An error gives the reason in one line.
    static Expected<std::unique_ptr<WebServer>> open(RunningSystem& live, ClockControl& clock, ConsoleServer& consoles,
                                                     const WebOptions& options);
    /// Says goodbye to the browsers. Their holds stay as they are.
    ~WebServer();
    WebServer(const WebServer&) = delete;
    WebServer& operator=(const WebServer&) = delete;

    /// The addresses for full access and for viewing only.
    std::string url() const;
    std::string view_url() const;

    /// Whether a browser has the page open. The own connection of a class does not count.
    bool is_watched() const;
    /// Tells all browsers, also later ones, how the run ended.
    void show_end(const std::string& text, bool is_good);

    /// Processes requests until about `until` and sends changes. `late` is how late the last tick was [s]. Returns true
    /// if more work waits.
    bool serve(Clock::time_point until, double late);
    /// Adds the file descriptors that are readable when `serve` has work.
    void add_files(std::vector<int>& files) const;

    /// Sends the line to the browsers.
    void log(const LogLine& line);
    void say(const std::string& text);
    void show_status(const std::string& text, bool running);

private:
    struct Browser {
        Actor who;
        bool view_only = false;
    };

    WebServer(RunningSystem& live, ClockControl& clock, ConsoleServer& consoles, const WebOptions& options);

    void deal_with(const Hub::Incoming& incoming);
    void note(const Browser& browser, const std::string& what);
    enum class Reply { now, later };
    void answer(ClientId client, std::int64_t id, const Expected<void>& done);
    Expected<Reply> perform(ClientId client, const Browser& browser, const BrowserMessage& message);
    Expected<void> set_time(const TimeMessage& time, const Browser& browser);
    Expected<Reply> prepare(ClientId client, std::int64_t id, const Browser& browser, const ActMessage& wanted);
    void finish_prepared();
    void show(double late, Clock::time_point now);
    void describe_system(Clock::time_point now);

    std::string url_with(const std::string& token) const;

    RunningSystem& live_;
    ClockControl& clock_;
    const std::string origin_;  // without the port
    Hub hub_;
    StateReader state_reader_;
    Drives drives_;
    ConsoleRelay relay_;
    std::map<ClientId, Browser> browsers_;
    std::vector<Hub::Incoming> waiting_;
    std::size_t dealt_ = 0;  // number of handled messages in waiting_
    struct Prepared {
        ClientId client = 0;
        std::int64_t id = 0;
        Actor who;
        ActMessage wanted;
    };
    Prepared prepared_;  // the request whose act worker_ prepares
    ActWorker worker_;
    Seeks seeks_;
    Explanations explanations_;
    Earlier earlier_;
    PeerDesk peers_;
    Clock::time_point due_{};  // when the next state is sent
    Clock::time_point described_{};
    std::uint64_t fingerprint_ = 0;
    std::uint64_t layout_ = 0;
    int starts_ = 0;
    std::unique_ptr<Sockets> sockets_;
    // Destroyed first, because they wake the sockets:
    std::unique_ptr<Pictures> pictures_;
    std::unique_ptr<Editor> editor_;
    std::unique_ptr<ScenarioRuns> scenarios_;
};

}  // namespace nezumi::web
