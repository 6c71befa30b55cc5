// Simulations of several hosts that advance together: each tick waits for the other hosts' messages of their last tick.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/dds/ends.hpp"
#include "bindings/dds/host_table.hpp"
#include "bindings/dds/port_topic.hpp"
#include "bindings/dds/step.hpp"
#include "bindings/dds/transport.hpp"
#include "engine/system/network.hpp"
#include "engine/system/system.hpp"

namespace nezumi::dds {

/// Conservative synchronization: with every tick each host sends its published messages to each partner, and starts the
/// next tick when it has received those of all partners. So a message published in one host's tick is received in the
/// next tick of the other, independent of their clocks. Partners are hosts with a connection between them, and hosts
/// named by one of them. When two hosts meet later, they begin with the next tick of each; from then on they make the
/// same number of ticks.
class Lockstep {
public:
    static constexpr double patience = 1;      ///< [s] of waiting before it is reported
    static constexpr double repetition = 0.2;  ///< [s] between repetitions of a step while this host waits
    static constexpr std::int64_t most_ticks = std::int64_t{1} << 53;  ///< more than any run has

    struct Settings {
        std::string host{};                ///< this host
        std::uint64_t run = 0;             ///< as announced
        std::vector<std::string> hosts{};  ///< further hosts to wait for before the first tick, without a connection
        std::function<double()> clock{};   ///< [s], monotonic
    };

    /// The system and the transport must outlive it.
    Lockstep(System& system, DdsTransport& transport, Settings settings)
        : system_(system), transport_(transport), settings_(std::move(settings)) {}
    ~Lockstep() { leave(); }
    Lockstep(const Lockstep&) = delete;
    Lockstep& operator=(const Lockstep&) = delete;

    // Called in this order at every check of other hosts. `connections`: the existing connections with other hosts.

    /// True if connections with others may be made now. Before the first tick all expected hosts must be there, so that
    /// connections are always made in the same order.
    bool may_connect(const HostTable& hosts, const std::vector<Ends>& connections) const;
    /// Finds new partners and ends partnerships. `connected`: no requested connection is missing.
    void meet(const HostTable& hosts, const std::vector<Ends>& connections, bool connected);
    /// Adds this host's data for lockstep to its announcement.
    void announce(Announcement& said, const std::vector<Ends>& connections) const;

    /// Called between two ticks, as often as possible: receives, repeats possibly lost steps, reports waiting.
    void serve();
    /// True if all partners have reached this tick, and always after `leave`.
    bool may_tick();
    /// Called before a tick: writes the messages that partners published in their last tick.
    void deliver(const MessageDoor& give);
    /// Called when all ports have latched for a tick: sends the step.
    void publish();
    /// Ends the lockstep because this host's run is over: the other hosts continue without it.
    void leave();

    /// True if messages to and from this host are sent with its steps.
    bool carries(std::string_view host) const { return partners_.contains(host); }
    void add_files(std::vector<int>& files) const;

private:
    struct Partner {
        std::uint64_t run = 0;
        std::int64_t began = 0;                     // this host's tick of the first step
        std::optional<std::int64_t> their_began{};  // the other host's, after its first step was received
        std::unique_ptr<Writer> writer{};
        std::unique_ptr<Reader> reader{};
        std::set<std::string, std::less<>> ports{};  // of this host, "name.port", that the other one needs
        std::deque<Step> said{};                     // the last two steps sent: the other host may have missed both
        std::map<std::int64_t, Step> heard{};        // received but not used, by the sender's tick
        double heard_at = 0;                         // [s] by the clock: the last message
        Step::End end = Step::goes_on;
        std::int64_t last = most_ticks;  // the other host's tick of its last step, if the lockstep has ended
        bool paused = false;
        bool in_use = false;  // this host has used a step of the partner
        std::string waits_for{};
    };

    std::int64_t tick() const { return system_.now().tick; }
    std::set<std::string> named(const std::vector<Ends>& connections) const;
    void consider(const Announcement& host, bool is_named);
    void join(const Announcement& host, bool is_named);
    void follow(const std::vector<Ends>& connections);
    void hear(Partner& partner);
    void take(Partner& partner, Step step);
    std::string find_missing();
    std::int64_t their_tick(const Partner& partner) const { return *partner.their_began + tick() - partner.began; }
    bool is_over(const Partner& partner) const {
        return partner.their_began && partner.began <= tick() && their_tick(partner) > partner.last;
    }
    void say(Partner& partner, Step& step, Step::End end);
    void deliver(const std::string& host, const StepMessage& message, const MessageDoor& give);
    void tell();
    std::string why_standing() const;

    System& system_;
    DdsTransport& transport_;
    Settings settings_;
    std::map<std::string, Partner, std::less<>> partners_;
    std::map<std::string, Published, std::less<>> published_;     // ports that partners need, by "name.port"
    std::uint64_t layout_ = 0;                                    // the layout of these ports
    std::set<std::uint64_t> over_;                                // runs of hosts that have left or were restarted
    std::map<std::string, std::string, std::less<>> absent_;      // before the first tick: hosts to wait for, and why
    std::set<std::pair<std::string, std::uint64_t>> told_apart_;  // incompatible hosts and runs
    bool met_ = false;                                            // `meet` was called
    bool left_ = false;
    double said_at_ = 0;                  // [s] by the clock
    std::string missing_;                 // the host that is waited for; "": none
    std::optional<double> stands_since_;  // [s] by the clock
    std::string told_;                    // the reported reason of waiting
    Octets bytes_;
};

}  // namespace nezumi::dds
