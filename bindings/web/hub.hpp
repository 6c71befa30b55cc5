// The exchange between browsers and the ticking thread: messages from browsers, states and texts to them.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/web/access.hpp"
#include "bindings/web/changes.hpp"
#include "bindings/web/messages.hpp"
#include "bindings/web/site.hpp"
#include "bindings/web/static_files.hpp"
#include "engine/base/descriptor.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::web {

class Hub final : public Site {
public:
    /// The most messages of a browser that may wait; with one more, its connection is closed.
    static constexpr std::size_t most_waiting = 256;
    /// The most messages of a browser per second; with more, its connection is closed.
    static constexpr double most_messages = 400;
    /// [bytes] of texts that may wait for a browser; above this, log lines and output are dropped and counted.
    static constexpr std::size_t most_backlog = std::size_t{1} << 20;
    /// [bytes] Largest picture file of a floor.
    static constexpr std::size_t largest_floor = std::size_t{1} << 24;
    /// [bytes] of answers that may wait for a browser; above this, its connection is closed.
    static constexpr std::size_t longest_backlog = 4 * most_backlog;
    /// The latest log lines that a new browser gets: number of lines, and bytes.
    static constexpr std::size_t most_kept = 300, longest_kept = std::size_t{1} << 17;

    struct Incoming {
        enum class What { opened, message, closed };
        ClientId client = 0;
        What what = What::message;
        bool view_only = false;
        BrowserMessage message{};
    };

    /// `hello` is the greeting message without the browser's own fields.
    Hub(AccessControl access, StaticFiles files, PartReader parts, std::string hello);
    /// Call it before the hub serves: from then on browsers may change only the pace of time. `why` is the reason that
    /// they are shown.
    void only_show(std::string why) { only_shows_ = std::move(why); }
    Hub(const Hub&) = delete;
    Hub& operator=(const Hub&) = delete;
    ~Hub() override = default;

    const AccessControl& access() const { return access_; }

    // For the ticking thread; none of these functions waits for a browser.

    /// A file descriptor that is readable when data wait for `take`.
    int file() const { return news_.get(); }
    std::vector<Incoming> take();
    bool has_clients() const { return clients_there_ > 0; }
    /// Everything that any browser watches.
    Watch wanted() const;
    /// Takes back the last state if no browser has got it yet, so that the caller can add changes. Then call `put` with
    /// this state, or with a new one.
    std::unique_ptr<State> take_back();
    void put(std::unique_ptr<State> state);
    /// Sends to one browser. A `lossy` text is dropped if too much waits.
    void send(ClientId client, std::string text, bool lossy = false);
    /// Sends to all browsers.
    void send_all(const std::string& text, bool lossy = false);
    /// A line of the log: for all browsers, and for new ones while it is among the latest.
    void log(std::string text);
    /// Sends the last message, also to browsers that are being admitted, then closes each connection. No browser is
    /// admitted after it.
    void end(const std::string& text);
    /// Like `send_all`, but of each `slot` only the latest text counts; new browsers get it too.
    enum class Slot { system, status, peers, ended };
    void show(Slot slot, std::string text);
    /// Sets the picture file of the floor ("" for none), which browsers can request. The sockets' thread reads it.
    void show_floor(std::string file);
    /// A picture of `port` for the browsers that watch it; only the latest of each port counts.
    void show_picture(const std::string& port, std::string message);

    // The site; runs in the sockets' thread.

    HttpReply reply_to(const HttpRequest& request) override;
    Admission lets_in(const HttpRequest& request) override;
    void opened(ClientId client, const Admission& admission) override;
    bool received(ClientId client, std::string_view text) override;
    std::optional<Outgoing> next(ClientId client) override;
    void closed(ClientId client) override;

private:
    using Clock = std::chrono::steady_clock;

    struct Client {
        bool view_only = false;
        bool paces = false;  // may change the pace of time although view-only
        Watch watch{};
        std::deque<std::string> texts{};  // waiting texts
        std::size_t backlog = 0;          // [bytes] of them
        std::size_t lost = 0;
        std::size_t waiting = 0;  // number of waiting messages of this browser
        std::map<Slot, std::uint64_t> shown{};
        std::map<std::string, std::uint64_t, std::less<>> pictures{};  // by port: the last picture it got
        bool is_behind = false;  // too many bytes wait, so the connection is closed
        bool wants_floor = false;
        // Used only by the sockets' thread:
        Changes::Seen seen{};
        double allowance = most_messages;
        Clock::time_point came{};
    };
    struct Shown {
        std::string text{};
        std::uint64_t number = 0;
    };

    // The caller must hold the lock:
    void put_text(Client& client, std::string text, bool lossy);
    std::optional<Outgoing> next_text(Client& client);
    std::optional<Outgoing> next_picture(Client& client);

    void watch_anew();

    static Outgoing read_floor(const std::string& file);
    static bool is_too_fast(Client& client);

    const AccessControl access_;
    const StaticFiles files_;
    const PartReader parts_;
    const std::string hello_;
    std::string only_shows_;  // the reason of `only_show`; "": browsers may change the system
    Descriptor news_;         // eventfd
    std::atomic<int> clients_there_ = 0;

    mutable Mutex mutex_;  // for all members below that are not marked as belonging to one thread
    std::map<ClientId, Client> clients_;
    std::vector<Incoming> incoming_;
    Watch wanted_;
    std::unique_ptr<State> state_;
    std::map<Slot, Shown> slots_;
    std::string floor_;                                   // file
    std::deque<std::string> log_;                         // the latest lines
    std::size_t kept_ = 0;                                // [bytes] of them
    std::map<std::string, Shown, std::less<>> pictures_;  // by port
    std::uint64_t last_number_ = 0;
    std::optional<std::string> goodbye_;  // the last message of the run

    Changes changes_;  // used by the sockets' thread
};

/// True if the message stops all robots.
bool is_stop(const BrowserMessage& message);
/// Adds `incoming` at the end of the part from index `from`. A stop goes before all messages, but after the arrival of
/// its browser.
void put_in_order(std::vector<Hub::Incoming>& waiting, std::size_t from, Hub::Incoming incoming);

}  // namespace nezumi::web
