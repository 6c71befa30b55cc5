// Simulations of several hosts that advance together: a tick waits for what the others have published in theirs.
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

/// Conservative synchronization: each host tells each partner with every tick what it has published, and runs the next
/// tick when it has that of all its partners. So what is published in a tick of one is taken in the next tick of the
/// other, whatever their clocks do. Partners are hosts with a connection between them, and those that one of them
/// names. Two that meet late begin with the next tick of each: from then on so many ticks of the one are as many of the
/// other.
class Lockstep {
public:
    static constexpr double patience = 1;      ///< [s] that time stands before that is told
    static constexpr double repetition = 0.2;  ///< [s] until a step is said again while time stands
    static constexpr std::int64_t most_ticks = std::int64_t{1} << 53;  ///< no run comes so far

    struct Settings {
        std::string host{};                ///< this one
        std::uint64_t run = 0;             ///< as announced
        std::vector<std::string> hosts{};  ///< to wait for before the first tick, beside those of connections
        std::function<double()> clock{};   ///< [s], never backwards
    };

    /// The system and the transport must outlive it.
    Lockstep(System& system, DdsTransport& transport, Settings settings)
        : system_(system), transport_(transport), settings_(std::move(settings)) {}
    ~Lockstep() { leave(); }
    Lockstep(const Lockstep&) = delete;
    Lockstep& operator=(const Lockstep&) = delete;

    // At each look, in this order. `connections`: those there are with other hosts.

    /// Whether others are given connections now: before the first tick when all are there who are waited for, so that
    /// connections are made in the same order each time.
    bool may_connect(const HostTable& hosts, const std::vector<Ends>& connections) const;
    /// Finds partners, and parts from those that are none any more. `connected`: nothing that others want is left to be
    /// made.
    void meet(const HostTable& hosts, const std::vector<Ends>& connections, bool connected);
    /// Adds what others must know.
    void announce(Announcement& said, const std::vector<Ends>& connections) const;

    /// Between two ticks, as often as may be: hears others, repeats what they may lack, tells who is waited for.
    void serve();
    /// Whether all partners have come as far. True for ever once this host has left.
    bool may_tick();
    /// Before a tick: has what partners published in theirs written.
    void deliver(const MessageDoor& give);
    /// All ports have latched for a tick: tells it.
    void publish();
    /// The run is over: the others go on without this host.
    void leave();

    /// Whether messages to and from this host come with its steps.
    bool carries(std::string_view host) const { return partners_.contains(host); }
    void add_files(std::vector<int>& files) const;

private:
    struct Partner {
        std::uint64_t run = 0;
        std::int64_t began = 0;                     // this host's tick of the first step
        std::optional<std::int64_t> their_began{};  // the other's, once it has been heard
        std::unique_ptr<Writer> writer{};
        std::unique_ptr<Reader> reader{};
        std::set<std::string, std::less<>> ports{};  // of this host, "name.port", that the other wants
        std::deque<Step> said{};                     // the last two: the other may lack both
        std::map<std::int64_t, Step> heard{};        // by their tick; not taken yet
        double heard_at = 0;                         // [s] by the clock: the last sign of life
        Step::End end = Step::goes_on;
        std::int64_t last = most_ticks;  // their tick of the last step, once there is one
        bool paused = false;
        bool in_use = false;  // a step was taken
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
    std::map<std::string, Published, std::less<>> published_;     // ports that partners want, by "name.port"
    std::uint64_t layout_ = 0;                                    // whose ports those are
    std::set<std::uint64_t> over_;                                // runs of hosts that have left, or were started again
    std::map<std::string, std::string, std::less<>> absent_;      // before the first tick: who is waited for, and why
    std::set<std::pair<std::string, std::uint64_t>> told_apart_;  // hosts and runs that can't keep in step
    bool met_ = false;                                            // there was a look
    bool left_ = false;
    double said_at_ = 0;                  // [s] by the clock
    std::string missing_;                 // who is waited for; "": nobody
    std::optional<double> stands_since_;  // [s] by the clock
    std::string told_;                    // why time stands
    Octets bytes_;
};

}  // namespace nezumi::dds
