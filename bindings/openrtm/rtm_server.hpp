// Exports a running system to RTCs: processes their messages and requests between two ticks, and sends them the
// messages of ports.
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
#include "engine/base/time_of_day.hpp"
#include "engine/system/act.hpp"
#include "engine/system/network.hpp"
#include "engine/system/published.hpp"
#include "engine/system/system.hpp"

namespace nezumi::openrtm {

/// The running system, also after restarts. All functions are called by the ticking thread, unless noted.
struct RtmHost {
    std::function<const System&()> system;
    std::function<const SystemSpec&()> spec;
    std::function<int()> starts;  ///< increases when the system is replaced
    /// Performs an act.
    ActDoor act;
    /// Delivers a message.
    MessageDoor deliver;
    std::function<void(bool is_problem, const std::string& line)> say;
    /// Wakes the ticking thread; any thread may call it. Optional.
    std::function<void()> wake{};
    /// Adds a behaviour. Optional, as the next two.
    std::function<Expected<void>(const RtcRequest& request)> create{};
    /// The behaviours that can be added; any thread may call it.
    std::function<std::vector<RtcModule>()> modules{};
    /// Ends the run.
    std::function<void()> end{};
    /// [s] since 1970: the time for stamps of messages of real robots.
    std::function<double()> wall_clock = time_of_day;
};

/// All functions must be called from the ticking thread, except for those of `RtcSite`.
class RtmServer final : public RtcSite {
public:
    /// The longest time that a request of an RTC waits for a tick.
    static constexpr std::chrono::milliseconds patience{1000};
    /// The period at which states and parameters are updated for RTCs.
    static constexpr std::chrono::milliseconds snapshot_period{100};

    using OrbMaker = std::function<Expected<std::unique_ptr<Orb>>(const OrbOptions& options, RtcSite& site)>;

    /// Exports the system. An error has the location of the wrong line, or says what to install.
    static Expected<std::unique_ptr<RtmServer>> open(RtmHost host, const OrbMaker& make_orb = open_orb);
    /// Ends the export.
    ~RtmServer() override;
    RtmServer(const RtmServer&) = delete;
    RtmServer& operator=(const RtmServer&) = delete;

    /// Writes the messages received since the last tick to the in-ports.
    void before_tick();
    /// Sends what was published in the tick.
    void after_tick();
    /// Processes requests of RTCs and writes log lines, also without ticks.
    void serve();
    /// Asks about RTCs of other programs, or sends a request to one. Does not wait. The answer is a text for the
    /// console. Open questions are answered at the latest when the server ends.
    std::future<Expected<std::string>> ask(PeerQuestion question);
    /// Like `ask` about all RTCs, but the answer is JSON for the page.
    std::future<std::string> look();

    std::uint64_t malformed() { return inbox_.malformed(); }
    std::uint64_t dropped() { return inbox_.dropped(); }

    // For CORBA's threads:
    RtcSnapshot snapshot(std::string_view component) override;
    RtcAnswer perform(const RtcRequest& request) override;
    std::vector<RtcModule> modules() override;
    PutAnswer put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes,
                  std::endian order) override;
    void left(std::string_view path, std::string_view from) override;
    void joined(const RtcLink& link) override;
    void ended(const RtcLink& link) override;
    void tell(bool is_problem, std::string text) override;

private:
    explicit RtmServer(RtmHost host) : host_(std::move(host)) {}

    struct Outlet {
        std::string path;
        const MessageType* type;
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
    void take_up(const std::vector<RtcLink>& joined);
    void take_away(const std::vector<RtcLink>& ended);
    void take_snapshots();
    void show_inside();
    RtcAnswer perform_now(const RtcRequest& request);
    RtcAnswer create(const RtcRequest& request);
    RtcAnswer set_values(const Component& component, const RtcRequest& request);
    Expected<ActResult> act(const Act& act);
    RtcAnswer done(const Act& wanted);

    const RtmHost host_;
    std::vector<Outlet> outlets_;
    std::vector<std::string> exported_;
    std::set<std::string, std::less<>> paths_;  // of the exported ports
    std::vector<RtcInside> inside_;             // connections between them
    std::vector<ConnectionSpec> wanted_;        // connections, as exported
    std::set<std::string> misfits_;             // the last errors of connections that can't be made
    std::uint64_t layout_ = 0;
    int starts_ = 0;
    std::chrono::steady_clock::time_point taken_at_{};
    bool is_stopped_ = false;                     // by an emergency stop; reported
    std::map<std::string, std::string> refused_;  // the last error of a port's messages
    std::vector<std::uint8_t> buffer_;

    Inbox inbox_;
    Mutex mutex_;  // for the next five
    std::map<std::string, RtcSnapshot, std::less<>> snapshots_;
    std::vector<Line> lines_;
    std::vector<RtcLink> joined_, ended_;
    std::map<std::string, std::string> malformed_;  // the last error, by connection
    std::unique_ptr<Orb> orb_;                      // destroyed first: its threads use the other members
};

}  // namespace nezumi::openrtm
