// A node of ROS in a system with one part, and what ROS would send it.
#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/dds/ros/node.hpp"
#include "engine/values/cdr.hpp"
#include "tests/unit/dds/host_rig.hpp"

namespace nezumi::dds {

template <class M>
Octets bytes_of(const M& message) {
    Octets bytes;
    write_cdr(bytes, {.header = true}, message);
    return bytes;
}

/// A node of ROS in a system with one part, and another place in its domain.
template <class P>
struct NodeRigOf {
    NodeRigOf(const RosSpec& spec, std::unique_ptr<P> made, bool real = false)
        : system({.real_time = real, .clock = [this] { return clock; }},
                 [this](const LogLine& line) { log.push_back(line.text); }) {
        part = made.get();
        REQUIRE(system.add(std::move(made)));
        REQUIRE(part->activate(system.now()));
        auto added =
            RosNode::add(system, spec, *place, {.clock = [this] { return clock; }, .wall_clock = [] { return 1.5e9; }});
        if (!added) refusal = describe(added.error());
    }
    RosNode& node() { return dynamic_cast<RosNode&>(*system.find("ros/mouse")); }
    void tick() {
        node().between_ticks();
        node().before_tick([this](const Port& port, const Act& act, const Actor& who) {
            arrivals.push_back(fmt::format("{} by {}", name_of(act), to_text(who)));
            return deliver(const_cast<Port&>(port), act);
        });
        system.tick();
    }

    double clock = 100;
    FakeDomain domain;
    std::unique_ptr<DdsTransport> place = domain.join();
    std::unique_ptr<DdsTransport> other = domain.join();
    std::vector<std::string> log;
    std::vector<std::string> arrivals;  // acts of what came
    std::string refusal;
    System system;
    P* part = nullptr;
};

struct NodeRig : NodeRigOf<Part> {
    explicit NodeRig(const RosSpec& spec, bool real = false) : NodeRigOf(spec, std::make_unique<Part>("part"), real) {}
};

inline RosSpec spec_of(std::vector<RosTopic> publish, std::vector<RosTopic> subscribe) {
    RosSpec spec;
    spec.node = "mouse";
    spec.publish = std::move(publish);
    spec.subscribe = std::move(subscribe);
    return spec;
}

}  // namespace nezumi::dds
