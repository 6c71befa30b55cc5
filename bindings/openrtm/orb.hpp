// The interface to CORBA: a module with its own threads, loaded by the first run whose file contains `rtm`.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::openrtm {

/// A port of one of our RTCs.
struct RtcPort {
    std::string path{};  ///< "controller.in": its name in the system
    std::string name{};  ///< "in": its name in the RTC
    std::string type{};  ///< "TimedShortSeq"
    bool is_in = false;
    std::string id{};  ///< repository id of the type: "IDL:Seen/Obstacle:1.0"; "": the type is one of OpenRTM's
    std::string type_id() const { return id.empty() ? "IDL:RTC/" + type + ":1.0" : id; }
    bool operator==(const RtcPort&) const = default;
};

/// The constant properties of a component as an RTC.
struct RtcProfile {
    std::string component{};  ///< name of the component in the system; "controller" is the RTC "controller0"
    std::string type{};
    double rate = 0;  ///< [Hz] of its executions
    std::vector<RtcPort> ports{};
    bool operator==(const RtcProfile&) const = default;
};

/// Properties of RTCs: pairs of name and text, in order.
using Texts = std::vector<std::pair<std::string, std::string>>;

enum class RtcState { inactive, active, error };

/// The changing properties of a component.
struct RtcSnapshot {
    RtcState state = RtcState::inactive;
    std::string set = "default";                                 ///< the active configuration set
    std::string description{}, version{}, vendor{}, category{};  ///< "" if not given
    /// The values of each set, and the widgets, bounds and types of parameters: "default", "__widget__" ...
    std::vector<std::pair<std::string, Texts>> sets{};
};

/// A request for a component, ours or of another program.
struct RtcRequest {
    enum class What {
        activate,
        deactivate,
        reset,
        use,
        set,
        connect,
        disconnect,
        exit,    ///< ends the component
        create,  ///< only for this system: adds a behaviour
        end,     ///< only for this system: ends the run
        forget,  ///< only for other programs: removes the name of an RTC that is gone from the name service
    };
    What what = What::activate;
    std::string component{};   ///< name of the component; for `connect` of others: of the connection
    std::string set{};         ///< for `use` and `set`
    Texts values{};            ///< for `set` and `create`: parameters; for `connect`: properties of the connection
    std::string from{}, to{};  ///< for `connect` and `disconnect`: two ports of ours, or two of others
    std::string id{};          ///< for `connect` of others: of the connection; may be empty
    std::string script{};      ///< for `create`: the behaviour's name
};

enum class RtcAnswer {
    done,
    refused,
    unknown,
    busy,
    taken,  ///< another component has this name
};
enum class PutAnswer { taken, malformed, unknown };

/// A requested connection to another program's RTC: made as soon as the RTC exists, and again after it was away.
struct RtcLink {
    std::string path{};       ///< "controller.in"
    std::string component{};  ///< "ConsoleOut0" or "pc.host_cxt/ConsoleOut0"
    std::string port{};       ///< "out"
    bool operator==(const RtcLink&) const = default;
};

/// A connection between two ports of our RTCs. The system carries its messages; RTCs and tools see it.
struct RtcInside {
    std::string from{};  ///< "controller.out"
    std::string to{};    ///< "mouse.target_velocity_in"
    bool operator==(const RtcInside&) const = default;
};

/// A behaviour that could be added.
struct RtcModule {
    std::string name{};  ///< "robot_controller"
    std::string type{};  ///< "RobotController"
};

/// The system's functions for CORBA's threads. None waits longer than a second for a tick.
class RtcSite {
public:
    virtual ~RtcSite() = default;

    virtual RtcSnapshot snapshot(std::string_view component) = 0;
    virtual RtcAnswer perform(const RtcRequest& request) = 0;
    /// The behaviours that can be added: those of the project, and the installed ones.
    virtual std::vector<RtcModule> modules() = 0;
    /// Takes a message for an in-port from the connection named `from`.
    virtual PutAnswer put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes,
                          std::endian order) = 0;
    /// A connection to an in-port has ended.
    virtual void left(std::string_view path, std::string_view from) = 0;
    /// An RTC or a tool has made a connection.
    virtual void joined(const RtcLink& link) = 0;
    /// A connection was ended on purpose, or it was reported by `joined` and its RTC is gone.
    virtual void ended(const RtcLink& link) = 0;
    /// Writes a line to the log.
    virtual void tell(bool is_problem, std::string text) = 0;
};

/// An RTC, ours or of another program, as the name service and its own answers describe it.
struct PeerSnapshot {
    enum class State {
        inactive,
        active,
        error,
        created,  ///< not initialized yet
        unknown,  ///< the RTC has no execution context
        silent,   ///< the RTC does not answer
        gone,     ///< the RTC's program has crashed, or its computer is off
        unasked,  ///< the RTC was not asked, because too many others did not answer
    };
    struct Port {
        std::string name{};  ///< "out"
        std::string type{};  ///< "TimedLong"; "" if it is not a data port
        bool is_in = false;
        std::vector<std::string> connections{};  ///< ids of its connections; a connection has one id at both ports
        std::string path{};                      ///< "controller.in" if it is a port of ours
    };
    std::string name{};  ///< "pc.host_cxt/ConsoleOut0"
    bool is_ours = false;
    std::string type{};
    State state = State::unknown;
    bool is_stopped = false;  ///< its execution context does not run, so the state does not change
    std::vector<Port> ports{};
    std::string set{};                                  ///< the active configuration set; "" if none
    std::vector<std::pair<std::string, Texts>> sets{};  ///< empty if all RTCs were asked without `is_whole`
};

/// A question about all RTCs or one of them, or a request to one.
struct PeerQuestion {
    std::string name{};                   ///< of the RTC, as in connections; "": all RTCs
    std::optional<RtcRequest> request{};  ///< without its `component`; if its `set` is "", the active set is meant
    bool is_whole = false;                ///< if all are asked: also for the configuration of each
};

struct PeerAnswer {
    std::string problem{};             ///< why it could not be done; "" on success
    std::string missing{};             ///< the name that was not found
    std::vector<std::string> known{};  ///< the names that exist instead
    bool was_so = false;               ///< the requested state existed already
    std::vector<PeerSnapshot> peers{};
};

/// Takes an answer. Called once for each question, by the thread that asked the question or by a thread of the ORB.
using TakeAnswer = std::function<void(const PeerQuestion& question, PeerAnswer answer)>;

/// The byte orders that connections of an out-port use.
struct WantedOrders {
    bool little = false;
    bool big = false;
};

/// The RTCs and their connections. No function waits for a peer, except the destructor.
class Orb {
public:
    /// Removes the RTCs from the name service, disconnects them and ends all threads, within about two seconds.
    virtual ~Orb() = default;

    /// Replaces the exported RTCs; unchanged ones keep their connections.
    virtual void show(std::vector<RtcProfile> profiles, std::vector<RtcLink> links) = 0;
    /// Replaces the connections between our RTCs.
    virtual void show_inside(std::vector<RtcInside> connections) = 0;
    virtual WantedOrders wanted(std::string_view path) = 0;
    /// Asks RTCs on a separate thread. Every question is answered, at the latest when the ORB ends.
    virtual void ask(PeerQuestion question, TakeAnswer take) = 0;
    /// Sends a message to the connections of an out-port that use this byte order.
    virtual void publish(std::string_view path, std::span<const std::uint8_t> bytes, std::endian order) = 0;
    /// True if the requested connection existed when it was last checked.
    virtual bool is_made(const RtcLink& link) = 0;
};

struct OrbOptions {
    std::vector<std::string> nameservers{"localhost:2809"};  ///< not empty
    std::string interface = "127.0.0.1";
    bool manager = false;  ///< tools may add and remove behaviours, and end the run
};

/// Starts the ORB. `site` must outlive it. An error says in one line what to install.
Expected<std::unique_ptr<Orb>> open_orb(const OrbOptions& options, RtcSite& site);

// The interface between the program and its module, which are always built together.
inline constexpr const char* orb_module = "nezumi_orb.so";
inline constexpr const char* open_in_module = "nezumi_open_orb";
/// The only function that the module exports. Returns the ORB, or sets `problem` and returns nullptr. Never throws.
using OpenInModule = Orb*(const OrbOptions& options, RtcSite& site, std::string& problem);

}  // namespace nezumi::openrtm
