// An out-port and an in-port that listens to it, and times, for the tests of ports.
#pragma once

#include <catch2/catch.hpp>

#include <cstdint>
#include <vector>

#include "engine/ports/port.hpp"

namespace nezumi {

inline Time at(std::int64_t tick) { return {tick, static_cast<double>(tick) / 100}; }

using Values = std::vector<std::int32_t>;

struct Pair {
    explicit Pair(std::size_t queue = 0) : in("in", "", queue) { in.connect(out); }
    /// One tick in which the out-port's owner wrote these.
    void pass(std::int64_t tick, const Values& values) {
        for (const std::int32_t value : values) out.write(value);
        out.latch(at(tick));
        in.latch(at(tick));
    }
    Values read_all() {
        Values all;
        while (in.is_new()) all.push_back(in.read());
        return all;
    }
    OutPort<std::int32_t> out{"out"};
    InPort<std::int32_t> in;
};

}  // namespace nezumi
