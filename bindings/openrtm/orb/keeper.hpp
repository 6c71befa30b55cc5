// The thread that registers RTCs in the name service and keeps their connections alive.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/manager_object.hpp"
#include "bindings/openrtm/orb/name_servers.hpp"
#include "bindings/openrtm/orb/rtc_object.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {

class Keeper {
public:
    Keeper(const Home& home, const OrbOptions& options);
    /// Removes all RTCs from the name service and disconnects them.
    ~Keeper();
    Keeper(const Keeper&) = delete;
    Keeper& operator=(const Keeper&) = delete;

    // These are called by the ticking thread, and do not wait for a peer.
    void show(std::vector<RtcProfile> profiles, std::vector<RtcLink> links);
    void show_inside(std::vector<RtcInside> connections);
    WantedOrders wanted(std::string_view path);
    bool is_made(const RtcLink& link);
    void publish(std::string_view path, std::span<const std::uint8_t> bytes, std::endian order);

private:
    using Clock = std::chrono::steady_clock;
    using Rtc = PortableServer::Servant_var<RtcObject>;
    struct Exports {
        std::vector<RtcProfile> profiles{};
        std::vector<RtcLink> links{};
    };

    struct Link {
        RtcLink wanted{};
        RTC::PortService_var theirs{};                ///< the other port, after the connection was made
        std::string id{};                             ///< of the last connection
        std::optional<Clock::time_point> ended_at{};  ///< when it was noticed that the connection is gone
        bool is_ended = false;                        ///< it was ended on purpose, so it is not made again
        bool is_joined = false;                       ///< an RTC or a tool has made it: it is not made again
    };
    /// A connection made by an RTC or a tool.
    struct Joined {
        std::string id{};
        std::optional<Link> link{};  ///< none: the RTC of the other port is unknown
        Clock::time_point at{};
    };

    bool is_ending();
    void run();
    void take_wanted(const Exports& wanted);
    void take_links(const std::vector<RtcLink>& wanted);
    void withdraw(const std::vector<Rtc>& gone);
    std::string free_instance(const std::string& name, const std::string& kind);
    void begin_manager();
    void register_all();
    void register_at(NameService& names, const std::string& shown, const std::string& name, CORBA::Object_ptr object);
    void unbind(const std::string& name, CORBA::Object_ptr object);
    void look_after_connections();
    void make_links();
    void look_for_joined();
    void connect_inside();
    void lose(Link& link, bool is_over);
    void note_made();
    bool is_to_be_made(Link& link, PortObject& port);
    void tell_once(const std::string& about, bool is_problem, const std::string& text);
    PortObject* find_port(std::string_view path);

    const Home home_;
    NameServers names_;
    const bool has_manager_;
    PortableServer::Servant_var<ManagerObject> manager_;
    std::vector<Link> links_;                  // used only by the thread, as the next three
    std::vector<Joined> joined_;               // reported to the system, but not yet requested by it
    std::map<std::string, std::string> told_;  // the last messages, by subject
    int rounds_ = 0;

    Mutex mutex_;  // for all members below; never held while a peer is called
    std::condition_variable changed_;
    std::vector<Rtc> rtcs_;
    std::vector<RtcLink> made_;
    Exports wanted_;
    std::vector<RtcInside> inside_;
    bool is_new_ = false;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace nezumi::openrtm
