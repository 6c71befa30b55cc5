// The network of one system: announces it, finds other hosts, and keeps the connections with them.
#pragma once

#include <cstdint>
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
#include "bindings/dds/host_requests.hpp"
#include "bindings/dds/host_table.hpp"
#include "bindings/dds/lockstep.hpp"
#include "bindings/dds/port_topic.hpp"
#include "bindings/dds/remote_component.hpp"
#include "bindings/dds/strangers.hpp"
#include "bindings/dds/transport.hpp"
#include "engine/system/network.hpp"
#include "engine/system/system.hpp"

namespace nezumi::dds {

/// The identity of a host and its trust in others.
struct HostSettings {
    std::string name;
    std::string version;                                ///< of nezumi
    bool writable = true;                               ///< others may connect to its in-ports
    bool sealed = false;                                ///< the transport encrypts its messages
    std::uint64_t run = 0;                              ///< a different number at each start
    std::function<double()> clock = monotonic_seconds;  ///< [s], monotonic
    bool lockstep = false;                              ///< waits for other hosts in every tick, see `Lockstep`
    std::vector<std::string> hosts{};                   ///< as in `Lockstep`
};

/// A connection with another host is an ordinary connection on both hosts, to a component that represents the other
/// host's component: "ev3/vehicle". The host where the connection was requested announces it. The other host makes the
/// same connection as an act of that host, or refuses it with a reason. A connection ends when either host disconnects
/// it; it stays while a host is absent.
class SystemNetwork final : public Network, private PortObserver {
public:
    /// The system and the transport must outlive the network. Nothing is sent or received before the first
    /// `between_ticks`.
    SystemNetwork(System& system, DdsTransport& transport, HostSettings settings);

    Expected<void> reach(std::string_view path, const Port& other) override;
    void between_ticks(const ActDoor& act, const QuestionDoor& answer) override;
    void before_tick(const MessageDoor& deliver) override;
    Expected<std::uint64_t> ask(const Question& question) const override;
    std::optional<Expected<PlainData>> answer(std::uint64_t number) const override;
    std::vector<Host> hosts() const override;
    bool brought(const ConnectionSpec& connection) const override;
    bool may_tick() override { return !lockstep_ || lockstep_->may_tick(); }
    bool is_in_lockstep() const override { return lockstep_.has_value(); }
    void add_files(std::vector<int>& files) const override {
        if (lockstep_) lockstep_->add_files(files);
    }
    void leave() override {
        if (lockstep_) lockstep_->leave();
    }

private:
    void latched(const System& system) override;
    bool open();
    void look(const ActDoor& act);
    void listen();
    std::vector<Ends> present() const;
    Expected<bool> can_be(const Ends& ends, const Announcement& host) const;
    bool make_what_others_want(const std::vector<Ends>& present, const ActDoor& act);
    void end_what_they_no_longer_want(const std::vector<Ends>& present, const ActDoor& act);
    void end_what_is_refused(const std::vector<Ends>& present, const ActDoor& act);
    void open_topics(const std::vector<Ends>& present);
    void announce(const std::vector<Ends>& present);
    void tell_problem(const std::string& path);
    void announce_ports(Announcement& next) const;
    void note_waiting();
    std::string whole(std::string_view path) const;
    std::string local(std::string_view path) const;
    std::string other_of(const Ends& ends) const;
    void refuse(const Ends& ends, const std::string& why);

    System& system_;
    DdsTransport& transport_;
    HostSettings settings_;
    HostTable hosts_;
    mutable HostRequests requests_;
    Strangers strangers_;
    std::optional<Lockstep> lockstep_;
    std::unique_ptr<Writer> announcer_;
    std::unique_ptr<Reader> listener_;
    Announcement said_;
    double next_ = 0;                                            // [s] by the clock: the next check of others
    bool failed_ = false;                                        // announcing is impossible; reported
    std::map<Ends, std::string> brought_;                        // the requesting host of each connection
    std::map<Ends, std::string> refusals_;                       // of connections requested by others: the reasons
    std::set<std::string> problems_;                             // ports that can't be sent; reported
    std::map<std::string, std::uint64_t, std::less<>> numbers_;  // of the last messages, by topic
    std::map<std::string, Outlet, std::less<>> outlets_;         // by "name.port"
    std::uint64_t layout_ = 0;                                   // the layout that is announced
    std::uint64_t followed_ = 0;                                 // the layout of the outlets
    int told_ = 0;                                               // number of refusals
    int looked_ = 0;  // connections that others made while they may only read
};

}  // namespace nezumi::dds
