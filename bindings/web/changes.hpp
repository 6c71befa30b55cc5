// What has changed in a system since a browser saw it last.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bindings/web/web_frame.hpp"

namespace nezumi::web {

/// What one browser wants to see besides things and markers.
struct Watch {
    std::vector<std::string> ports{};  ///< "name.port"
    bool truth = false;                ///< poses of robots
    bool rays = false;
    std::vector<std::string> pictures{};  ///< "name.port"
    std::vector<std::string> members{};   ///< "mouse.truth", "controller.probes", "controller.state"
    bool operator==(const Watch&) const = default;
};

/// A system after a tick, as far as somebody wants to see it. Made by the thread that ticks, given away whole.
struct State {
    WebFrame now{};  ///< without ports; of everything there is
    struct Port {
        std::uint64_t count = 0;  ///< messages since the start
        Octets payload{};
    };
    std::map<std::string, Port, std::less<>> ports{};  ///< "name.port": those that have changed
    std::vector<WebMember> members{};                  ///< as they are now
    std::uint64_t layout = 0;                          ///< another one: nothing is what it was
};

/// All that has been told, with when it changed. Of one thread.
class Changes {
public:
    /// What a browser has got.
    struct Seen {
        std::uint64_t sequence = 0;
        std::vector<std::uint64_t> counts{};  ///< of each port that it watches
    };

    void take(State&& state);
    /// Whether something has changed that it has not got.
    bool is_news(const Seen& seen) const { return changed_ > seen.sequence; }
    /// What it has not got; from now on it has.
    WebFrame since(Seen& seen, const Watch& watch) const;

private:
    template <class T>
    struct Dated {
        T value{};
        std::uint64_t changed = 0;
    };
    template <class T>
    void merge(std::vector<Dated<T>>& known, std::vector<T>&& news);

    std::uint64_t sequence_ = 0;  // of the state that was taken last
    std::uint64_t changed_ = 0;   // of the one that brought something new
    std::uint64_t layout_ = 0;
    WebFrame now_;  // without lists
    std::vector<Dated<WebRobot>> robots_;
    std::vector<Dated<WebThing>> things_;
    std::vector<Dated<WebMarker>> markers_;
    std::vector<Dated<std::vector<WebRay>>> rays_;  // by robot
    std::map<std::string, Dated<State::Port>, std::less<>> ports_;
    std::map<std::string, Dated<WebMember>, std::less<>> members_;
};

}  // namespace nezumi::web
