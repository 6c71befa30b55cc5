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

/// What a host is, and whom it trusts.
struct HostSettings {
    std::string name;
    std::string version;                                ///< of nezumi
    bool writable = true;                               ///< others may connect to its in-ports
    bool sealed = false;                                ///< the transport's messages are
    std::uint64_t run = 0;                              ///< another number at each start
    std::function<double()> clock = monotonic_seconds;  ///< [s], never backwards
    bool lockstep = false;                              ///< time is that of its partners
    std::vector<std::string> hosts{};                   ///< as in `Lockstep`
};

/// A connection with another host is an ordinary connection at both ends, to a component that stands for the other's:
/// "ev3/vehicle". Who was asked for it announces it; the other makes it as an act of that host, or refuses it and says
/// why. It ends when either end ends it, and outlives either end's absence.
class SystemNetwork final : public Network, private PortObserver {
public:
    /// Both must outlive the network. Nothing is said or heard before the first `between_ticks`.
    SystemNetwork(System& system, DdsTransport& transport, HostSettings settings);

    Expected<void> reach(std::string_view path, const Port& other) override;
    void between_ticks(const ActDoor& act) override;
    void before_tick(const MessageDoor& deliver) override;
    Expected<std::uint64_t> ask(const Question& question) const override;
    std::optional<Expected<PlainData>> answer(std::uint64_t number) const override;
    std::vector<Host> hosts() const override;
    bool brought(const ConnectionSpec& connection) const override;
    bool may_tick() override { return !lockstep_ || lockstep_->may_tick(); }
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
    std::vector<AnnouncedPort> own_ports() const;
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
    double next_ = 0;                                            // [s] by the clock: when to look at others again
    bool failed_ = false;                                        // there is no announcing; told
    std::map<Ends, std::string> brought_;                        // by which host
    std::map<Ends, std::string> refusals_;                       // of what others want: why
    std::set<std::string> problems_;                             // ports that could not be carried; told
    std::map<std::string, std::uint64_t, std::less<>> numbers_;  // of the messages last sent, by topic
    std::map<std::string, Outlet, std::less<>> outlets_;         // by "name.port"
    std::uint64_t layout_ = 0;                                   // whose ports are announced
    std::uint64_t followed_ = 0;                                 // whose ports the outlets have
    int told_ = 0;                                               // refusals
    int looked_ = 0;                                             // connections that others were given who may only look
};

}  // namespace nezumi::dds
