// Reads the state of a running system for browsers, between two ticks.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings/web/changes.hpp"
#include "engine/live/clock_control.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::web {

class StateReader {
public:
    /// `live` and `clock` must outlive this object.
    StateReader(const RunningSystem& live, const ClockControl& clock) : live_(live), clock_(clock) {}

    /// Adds changes to a state that no browser has got yet, or begins a new state if `state` is null.
    std::unique_ptr<State> at(std::unique_ptr<State> state, const Watch& wanted, double late);

private:
    void add_ports(State& state, const Watch& wanted);
    void add_members(State& state, const Watch& wanted) const;

    const RunningSystem& live_;
    const ClockControl& clock_;
    int starts_ = 0;
    std::uint64_t layout_ = 0;  // layout of the system at the last reading
    std::uint64_t number_ = 0;  // counts layouts; goes on over restarts
    Watch watched_;
    std::map<std::string, std::uint64_t, std::less<>> counts_;  // message counts of ports at the last reading
};

}  // namespace nezumi::web
