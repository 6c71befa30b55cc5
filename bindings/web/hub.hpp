// What is between browsers and the thread that ticks: their messages one way, states and texts the other.
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
    /// Messages of a browser that nobody has dealt with; one more and its connection is closed.
    static constexpr std::size_t most_waiting = 256;
    /// Messages of a browser in a second; more, and its connection is closed.
    static constexpr double most_messages = 400;
    /// [bytes] of texts that wait for a browser; beyond them log lines and output are left out and counted.
    static constexpr std::size_t most_backlog = std::size_t{1} << 20;
    /// [bytes] of the file of a floor's picture.
    static constexpr std::size_t largest_floor = std::size_t{1} << 24;
    /// [bytes] of answers and such that wait for a browser; beyond them its connection is closed.
    static constexpr std::size_t longest_backlog = 4 * most_backlog;
    /// The latest lines of the log, which who comes is shown: so many, and so many bytes of them.
    static constexpr std::size_t most_kept = 300, longest_kept = std::size_t{1} << 17;

    struct Incoming {
        enum class What { opened, message, closed };
        ClientId client = 0;
        What what = What::message;
        bool view_only = false;
        BrowserMessage message{};
    };

    /// `hello` is the message that greets a browser, without what is its own.
    Hub(AccessControl access, StaticFiles files, PartReader parts, std::string hello);
    Hub(const Hub&) = delete;
    Hub& operator=(const Hub&) = delete;
    ~Hub() override = default;

    const AccessControl& access() const { return access_; }

    // From the thread that ticks; none of it waits for a browser.

    /// Readable while something waits for `take`.
    int file() const { return news_.get(); }
    std::vector<Incoming> take();
    bool has_clients() const { return clients_there_ > 0; }
    /// What some browser watches.
    Watch wanted() const;
    /// The last state, when it was not taken yet, to be added to; and back, or another.
    std::unique_ptr<State> take_back();
    void put(std::unique_ptr<State> state);
    /// To one browser. What is `lossy` is left out when too much waits.
    void send(ClientId client, std::string text, bool lossy = false);
    /// To all of them.
    void send_all(const std::string& text, bool lossy = false);
    /// A line of the log: to all, and to those who come while it is one of the latest.
    void log(std::string text);
    /// Says goodbye, also to who is just being let in: whoever has got that is closed, and nobody else is let in.
    void end(const std::string& text);
    /// The same as `send_all`, and of each `slot` only the latest counts: also to those who come later.
    enum class Slot { system, status };
    void show(Slot slot, std::string text);
    /// The file of the picture on the floor, "" for none: to who asks for it. It is read in the sockets' thread.
    void show_floor(std::string file);
    /// A picture of `port`: to who watches it, and of each port only the latest counts.
    void show_picture(const std::string& port, std::string message);

    // The site, in the sockets' thread.

    HttpReply reply_to(const HttpRequest& request) override;
    Admission lets_in(const HttpRequest& request) override;
    void opened(ClientId client, bool view_only) override;
    bool received(ClientId client, std::string_view text) override;
    std::optional<Outgoing> next(ClientId client) override;
    void closed(ClientId client) override;

private:
    using Clock = std::chrono::steady_clock;

    struct Client {
        bool view_only = false;
        Watch watch{};
        std::deque<std::string> texts{};  // that wait
        std::size_t backlog = 0;          // [bytes] of them
        std::size_t lost = 0;
        std::size_t waiting = 0;  // of its messages
        std::map<Slot, std::uint64_t> shown{};
        std::map<std::string, std::uint64_t, std::less<>> pictures{};  // by port: the one that it got
        bool is_behind = false;                                        // too much waits: it is closed
        bool wants_floor = false;
        // Of the sockets' thread alone:
        Changes::Seen seen{};
        double allowance = most_messages;
        Clock::time_point came{};
    };
    struct Shown {
        std::string text{};
        std::uint64_t number = 0;
    };

    // With the lock held:
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
    Descriptor news_;  // eventfd
    std::atomic<int> clients_there_ = 0;

    mutable Mutex mutex_;  // of all below, but for what is said to be of one thread
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
    std::optional<std::string> goodbye_;  // said when the run ended

    Changes changes_;  // of the sockets' thread
};

/// Whether it stops all robots.
bool is_stop(const BrowserMessage& message);
/// Puts what came behind all that waits, from place `from` on; but a stop before all of it, only behind the coming of
/// its browser.
void put_in_order(std::vector<Hub::Incoming>& waiting, std::size_t from, Hub::Incoming incoming);

}  // namespace nezumi::web
