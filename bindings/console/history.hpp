// Remembers what ports carried, for plots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/live/live_system.hpp"

namespace nezumi {

/// What one port carried: the numbers and truth values of each message, in order.
struct Series {
    struct Sample {
        double seconds;              ///< simulated, of the message
        std::vector<double> values;  ///< one for each label that it has; 0 and 1 for truth values
    };
    std::vector<std::string> labels;  ///< "vx", "[1]", "" for a single value
    std::deque<Sample> samples;       ///< oldest first
};

class History {
public:
    static constexpr std::size_t most_ports = 200;     ///< of a system, so that every one is followed from the start
    static constexpr std::size_t most_samples = 6000;  ///< of each port: a minute at 100 Hz
    static constexpr std::size_t most_values = 16;     ///< of each message

    /// After every tick. Costs a comparison a port, and a copy of each new message.
    void after_tick(const LiveSystem& live);
    /// Follows this port from now on, however many there are.
    void follow(const std::string& path) { followed_.insert(path); }
    /// What is remembered of "name.port"; null when that is nothing.
    const Series* find(const std::string& path) const;

private:
    struct Entry {
        const Port* port = nullptr;
        std::string path;
        std::uint64_t count = 0;
        Series* series = nullptr;  ///< in `series_`; null: not followed
    };

    void look(const Component& component, const Port& port, std::size_t place, bool all);

    std::vector<Entry> entries_;  // in the order of components and ports
    std::map<std::string, Series, std::less<>> series_;
    std::set<std::string, std::less<>> followed_;
    std::size_t looked_for_ = 0;  // size of `followed_` when `entries_` were made
};

}  // namespace nezumi
