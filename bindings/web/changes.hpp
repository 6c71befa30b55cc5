// The changes in a system since a browser last got its state.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bindings/web/web_frame.hpp"

namespace nezumi::web {

/// The parts of the state that a browser wants, in addition to things and markers.
struct Watch {
    std::vector<std::string> ports{};  ///< "name.port"
    bool truth = false;                ///< poses of robots
    bool rays = false;
    bool peers = false;                   ///< components of other programs
    std::vector<std::string> pictures{};  ///< "name.port"
    std::vector<std::string> members{};   ///< "mouse.truth", "controller.probes", "controller.state"
    bool operator==(const Watch&) const = default;
};

/// The state of a system after a tick, as far as browsers want to see it. Made by the ticking thread and passed on as a
/// whole.
struct State {
    WebFrame now{};  ///< complete, but without the ports, which are below
    struct Port {
        std::uint64_t count = 0;  ///< messages since the start
        Octets payload{};
    };
    std::map<std::string, Port, std::less<>> ports{};  ///< the changed ports, by "name.port"
    std::vector<WebMember> members{};                  ///< the present values of the watched members
    std::uint64_t layout = 0;                          ///< if it differs, the system has changed and everything is new
};

/// The last known value of each part of the state, with the number of the state in which it changed. Used by one
/// thread.
class Changes {
public:
    /// The state that a browser has received last.
    struct Seen {
        std::uint64_t sequence = 0;
        std::vector<std::uint64_t> counts{};  ///< of each watched port
    };

    void take(State&& state);
    /// True if there is a change that the browser has not received.
    bool is_news(const Seen& seen) const { return changed_ > seen.sequence; }
    /// Returns what the browser has not received, and marks it as received.
    WebFrame since(Seen& seen, const Watch& watch) const;

private:
    template <class T>
    struct Dated {
        T value{};
        std::uint64_t changed = 0;
    };
    template <class T>
    void merge(std::vector<Dated<T>>& known, std::vector<T>&& news);

    std::uint64_t sequence_ = 0;  // of the last state taken
    std::uint64_t changed_ = 0;   // of the last state with a change
    std::uint64_t layout_ = 0;
    WebFrame now_;  // without lists
    std::vector<Dated<WebRobot>> robots_;
    std::vector<Dated<WebThing>> things_;
    std::vector<Dated<WebMarker>> markers_;
    std::vector<Dated<std::vector<WebRay>>> rays_;  // index: robot
    std::map<std::string, Dated<State::Port>, std::less<>> ports_;
    std::map<std::string, Dated<WebMember>, std::less<>> members_;
};

}  // namespace nezumi::web
