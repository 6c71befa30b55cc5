// A running system among RTCs: what they send and want is done between two ticks, what ports publish is sent on.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/openrtm/inbox.hpp"
#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/rtc_profiles.hpp"
#include "engine/base/mutex.hpp"
#include "engine/system/act.hpp"
#include "engine/system/network.hpp"
#include "engine/system/published.hpp"
#include "engine/system/system.hpp"

namespace nezumi::openrtm {

/// The system, as it is from one start to the next. All of it is called by the thread that ticks.
struct RtmHost {
    std::function<const System&()> system;
    std::function<const SystemSpec&()> spec;
    std::function<int()> starts;  ///< grows when the system is another
    /// The one door.
    ActDoor act;
    /// And that for messages.
    MessageDoor deliver;
    std::function<void(bool is_problem, const std::string& line)> say;
    /// Wakes the thread that ticks, from any thread. May be empty.
    std::function<void()> wake{};
};

/// But for the part of `RtcSite` all of it is to be called from the thread that ticks.
class RtmServer final : public RtcSite {
public:
    /// How long a request of an RTC waits for its turn.
    static constexpr std::chrono::milliseconds patience{1000};
    /// How often what RTCs see of states and parameters is brought up to date.
    static constexpr std::chrono::milliseconds snapshot_period{100};

    using OrbMaker = std::function<Expected<std::unique_ptr<Orb>>(const OrbOptions& options, RtcSite& site)>;

    /// Begins to be seen. The error has the place of the line that is wrong, or says what to install.
    static Expected<std::unique_ptr<RtmServer>> open(RtmHost host, const OrbMaker& make_orb = open_orb);
    /// Nobody sees the system any more.
    ~RtmServer() override;
    RtmServer(const RtmServer&) = delete;
    RtmServer& operator=(const RtmServer&) = delete;

    /// Lets what has come since the last tick into the in-ports.
    void before_tick();
    /// Sends on what was published in the tick.
    void after_tick();
    /// Does what RTCs want, says what is to be said: also while no tick comes.
    void serve();
    /// Asks about RTCs of other programs, or for something of one; the answer is what to tell a person. Waits for
    /// nobody, nor does the end of the server leave it without an answer.
    std::future<Expected<std::string>> ask(PeerQuestion question);

    std::uint64_t malformed() { return inbox_.malformed(); }
    std::uint64_t dropped() { return inbox_.dropped(); }

    // For CORBA's threads:
    RtcSnapshot snapshot(std::string_view component) override;
    RtcAnswer perform(const RtcRequest& request) override;
    PutAnswer put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes,
                  std::endian order) override;
    void left(std::string_view path, std::string_view from) override;
    void ended(const RtcLink& link) override;
    void tell(bool is_problem, std::string text) override;

private:
    explicit RtmServer(RtmHost host) : host_(std::move(host)) {}

    struct Outlet {
        std::string path;
        Published published;
    };
    struct Line {
        bool is_problem;
        std::string text;
    };

    Expected<void> show();
    std::vector<RtcLink> fitting_links();
    void follow_changes();
    void follow_stop();
    void take_away(const std::vector<RtcLink>& ended);
    void take_snapshots();
    RtcAnswer perform_now(const RtcRequest& request);
    RtcAnswer set_values(const Component& component, const RtcRequest& request);
    RtcAnswer done(const Act& act);

    const RtmHost host_;
    std::vector<Outlet> outlets_;
    std::vector<std::string> exported_;
    std::vector<ConnectionSpec> wanted_;  // connections, as they were shown
    std::set<std::string> misfits_;       // what was said last of those that are not to be made
    std::uint64_t layout_ = 0;
    int starts_ = 0;
    std::chrono::steady_clock::time_point taken_at_{};
    bool is_stopped_ = false;                     // by an emergency stop; told
    std::map<std::string, std::string> refused_;  // messages of a port: what was said of it last
    std::vector<std::uint8_t> buffer_;

    Inbox inbox_;
    Mutex mutex_;  // of the next four
    std::map<std::string, RtcSnapshot, std::less<>> snapshots_;
    std::vector<Line> lines_;
    std::vector<RtcLink> ended_;
    std::map<std::string, std::string> malformed_;  // what was said last, by connection
    std::unique_ptr<Orb> orb_;                      // first to go: its threads ask the rest
};

}  // namespace nezumi::openrtm
