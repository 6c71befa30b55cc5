// CORBA's side of the system, in threads of its own: a module that is loaded by the first run whose file says `rtm`.
#pragma once

#include <bit>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::openrtm {

/// A port of an RTC of ours.
struct RtcPort {
    std::string path{};  ///< "controller.in": how the system calls it
    std::string name{};  ///< "in": how it is called there
    std::string type{};  ///< "TimedShortSeq"
    bool is_in = false;
    bool operator==(const RtcPort&) const = default;
};

/// A component as others see it, as far as it never changes.
struct RtcProfile {
    std::string component{};  ///< its name in the system; "controller" is the RTC "controller0"
    std::string type{};
    double rate = 0;  ///< [Hz] of its executions
    std::vector<RtcPort> ports{};
    bool operator==(const RtcProfile&) const = default;
};

/// Names with what belongs to them, in order: as RTCs have values, all of them texts.
using Texts = std::vector<std::pair<std::string, std::string>>;

enum class RtcState { inactive, active, error };

/// What changes of a component.
struct RtcSnapshot {
    RtcState state = RtcState::inactive;
    std::string set = "default";                                 ///< the configuration set in use
    std::string description{}, version{}, vendor{}, category{};  ///< "" for what it does not say
    /// The values of each set, the widgets, bounds and types of parameters: "default", "__widget__" ...
    std::vector<std::pair<std::string, Texts>> sets{};
};

/// What somebody wants of a component of ours.
struct RtcRequest {
    enum class What { activate, deactivate, reset, use, set };
    What what = What::activate;
    std::string component{};
    std::string set{};  ///< of `use` and `set`
    Texts values{};     ///< of `set`: parameters of the set
};

enum class RtcAnswer { done, refused, unknown, busy };
enum class PutAnswer { taken, malformed, unknown };

/// A connection that is wanted: made as soon as the other RTC is there, and made again when it was away.
struct RtcLink {
    std::string path{};       ///< "controller.in"
    std::string component{};  ///< "ConsoleOut0" or "pc.host_cxt/ConsoleOut0"
    std::string port{};       ///< "out"
    bool operator==(const RtcLink&) const = default;
};

/// The system, as CORBA's threads ask for it. None of it waits for a tick for longer than a second.
class RtcSite {
public:
    virtual ~RtcSite() = default;

    virtual RtcSnapshot snapshot(std::string_view component) = 0;
    virtual RtcAnswer perform(const RtcRequest& request) = 0;
    /// A message for an in-port, from a connection that is called `from`.
    virtual PutAnswer put(std::string_view path, std::string_view from, std::span<const std::uint8_t> bytes,
                          std::endian order) = 0;
    /// A connection to an in-port is gone.
    virtual void left(std::string_view path, std::string_view from) = 0;
    /// Somebody has ended a connection that is wanted, and the RTC at its other end lives on.
    virtual void ended(const RtcLink& link) = 0;
    /// Something that a person should know.
    virtual void tell(bool is_problem, std::string text) = 0;
};

/// An RTC of another program, or of ours, as the name service has it and as it answers.
struct PeerSnapshot {
    enum class State {
        inactive,
        active,
        error,
        created,  ///< not initialized yet
        unknown,  ///< it has no execution context
        silent,   ///< it does not answer
        gone,     ///< nobody is there any more: its program crashed, or its computer is off
        unasked,  ///< too many others did not answer
    };
    struct Port {
        std::string name{};  ///< "out"
        std::string type{};  ///< "TimedLong"; "" of one that carries no data
        bool is_in = false;
        int connections = 0;
    };
    std::string name{};  ///< "pc.host_cxt/ConsoleOut0"
    std::string type{};
    State state = State::unknown;
    std::vector<Port> ports{};
    std::string set{};                                  ///< the configuration set in use; "" where there is none
    std::vector<std::pair<std::string, Texts>> sets{};  ///< not where all RTCs are listed
};

/// What somebody wants to know of RTCs, or of one of them.
struct PeerQuestion {
    std::string name{};                   ///< as in connections; "": all of them are looked at
    std::optional<RtcRequest> request{};  ///< what it is to do, without its `component`; "" is the set in use
};

struct PeerAnswer {
    std::string problem{};             ///< why it could not be done; "" when it could
    std::string missing{};             ///< the name that there is none of,
    std::vector<std::string> known{};  ///< among these
    std::vector<PeerSnapshot> peers{};
};

/// Makes of an answer what is told to a person. Called in a thread of CORBA's side.
using TellPeers = Expected<std::string>(const PeerQuestion& question, const PeerAnswer& answer);

/// The byte orders in which connections want an out-port's messages.
struct WantedOrders {
    bool little = false;
    bool big = false;
};

/// What RTCs see. None of it waits for a peer, but for its end.
class Orb {
public:
    /// Takes the RTCs out of the name service, disconnects them and ends all threads, within about two seconds.
    virtual ~Orb() = default;

    /// These are RTCs from now on, and no others; who stays as it was keeps its connections.
    virtual void show(std::vector<RtcProfile> profiles, std::vector<RtcLink> links) = 0;
    virtual WantedOrders wanted(std::string_view path) = 0;
    /// Asks RTCs of other programs, in a thread for this: every question is answered, at the end of the ORB at last.
    virtual std::future<Expected<std::string>> ask(PeerQuestion question, TellPeers* tell) = 0;
    /// Hands a message to the connections of an out-port that want it in this order.
    virtual void publish(std::string_view path, std::span<const std::uint8_t> bytes, std::endian order) = 0;
    /// Whether a connection that is wanted is there, as far as that is known.
    virtual bool is_made(const RtcLink& link) = 0;
};

struct OrbOptions {
    std::string nameserver = "localhost:2809";
    std::string interface = "127.0.0.1";
};

/// Begins. `site` must outlive it. The error says in one line why it can't: what to install.
Expected<std::unique_ptr<Orb>> open_orb(const OrbOptions& options, RtcSite& site);

// What the program and its module know of each other: they are built together.
inline constexpr const char* orb_module = "nezumi_orb.so";
inline constexpr const char* open_in_module = "nezumi_open_orb";
/// The module's one function: CORBA's side, or nullptr with the `problem`. It throws nothing.
using OpenInModule = Orb*(const OrbOptions& options, RtcSite& site, std::string& problem);

}  // namespace nezumi::openrtm
