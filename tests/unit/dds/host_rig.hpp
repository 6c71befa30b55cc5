// A host of a fake domain: a system with its network, whose clock a test turns.
#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/dds/system_network.hpp"
#include "engine/live/answer_question.hpp"
#include "engine/system/perform.hpp"
#include "engine/system/system.hpp"
#include "tests/unit/dds/fake_domain.hpp"

namespace nezumi::dds {

/// Has an in-port and an out-port of velocities, and of numbers.
class Part final : public Device {
public:
    explicit Part(std::string name) : Device(std::move(name), "Part") {}
    void sense(const Time& /*now*/) override {}
    void actuate(const Time& /*now*/) override {
        while (number.is_new()) numbers.push_back(number.read());
        if (target.is_new()) targets.push_back(target.take());
    }
    OutPort<Velocity2D>& speed = add_out_port<Velocity2D>("speed");
    OutPort<std::int32_t>& count = add_out_port<std::int32_t>("count");
    InPort<Velocity2D>& target = add_in_port<Velocity2D>("target");
    InPort<std::int32_t>& number = add_in_port<std::int32_t>("number", "", 100);
    std::vector<std::int32_t> numbers;
    std::vector<Message<Velocity2D>> targets;
};

/// Hosts that share a domain and a clock.
struct Room {
    FakeDomain domain;
    double clock = 1000;
    std::uint64_t runs = 0;
};

struct HostOptions {
    bool writable = true;
    std::string version = "1.0";
    bool lockstep = false;
    std::vector<std::string> hosts{};
    double rate = 100;
};

/// Each has one component, "part".
struct HostRig {
    HostRig(Room& its_room, std::string name, bool writable = true, const std::string& version = "1.0")
        : HostRig(its_room, std::move(name), HostOptions{.writable = writable, .version = version}) {}
    HostRig(Room& its_room, std::string name, const HostOptions& options)
        : room(its_room), transport(room.domain.join()), system({.rate = options.rate}, [this](const LogLine& line) {
              log.push_back(fmt::format("{}: {}", to_text(line.level), line.text));
          }) {
        auto made = std::make_unique<Part>("part");
        part = made.get();
        REQUIRE(system.add(std::move(made)));
        REQUIRE(part->activate(system.now()));
        trace.start(system);
        HostSettings settings;
        settings.name = std::move(name);
        settings.version = options.version;
        settings.writable = options.writable;
        settings.lockstep = options.lockstep;
        settings.hosts = options.hosts;
        settings.run = ++room.runs;
        settings.clock = [this] { return room.clock; };
        system.take_network(std::make_unique<SystemNetwork>(system, *transport, std::move(settings)));
    }
    HostRig(const HostRig&) = delete;
    HostRig& operator=(const HostRig&) = delete;

    Expected<ActResult> act(const Act& act, const Actor& who) {
        return std::visit(
            [&](const auto& each) -> Expected<ActResult> {
                if constexpr (requires { perform(system, each, who); }) {
                    return perform(system, each, who);
                } else {
                    return failure("not here");
                }
            },
            act);
    }
    ActDoor door() {
        return [this](const Act& each, const Actor& who) {
            acts.push_back(fmt::format("{} by {}", name_of(each), to_text(who)));
            return act(each, who);
        };
    }
    MessageDoor messages() {
        return [this](const Port& port, const Act& each, const Actor& who) {
            arrivals.push_back(fmt::format("{} by {}", name_of(each), to_text(who)));
            return deliver(const_cast<Port&>(port), each);
        };
    }
    void look() {
        system.network()->between_ticks(door(), [&](const Question& question, bool writable, const Actor& who) {
            return answer_question({TreeNode(system), trace, door()}, question, writable, who);
        });
    }
    void tick() {
        look();
        system.network()->before_tick(messages());
        system.tick();
    }
    /// What another host answers, asked by this one.
    template <class... Rig>
    Expected<PlainData> ask(const Question& question, Rig&... others) {
        const auto number = system.network()->ask(question);
        if (!number) return Unexpected(number.error());
        for (;;) {
            if (auto answer = system.network()->answer(*number)) return std::move(*answer);
            room.clock += 0.1;
            (others.look(), ...);
            look();
        }
    }
    std::vector<std::string> connections() const {
        std::vector<std::string> all;
        for (const ConnectionSpec& each : system.connections()) all.push_back(each.from + " > " + each.to);
        return all;
    }
    bool told(const std::string& text) const {
        for (const std::string& line : log) {
            if (line.find(text) != std::string::npos) return true;
        }
        return false;
    }

    Room& room;
    std::unique_ptr<DdsTransport> transport;  // outlives the system
    std::vector<std::string> log;
    std::vector<std::string> acts;      // that others asked for
    std::vector<std::string> arrivals;  // acts of what came for ports
    System system;
    Trace trace;
    Part* part = nullptr;
};

/// All look at each other `times` times, a tenth of a second apart, with one tick each.
template <class... Rig>
void pass(Room& room, int times, Rig&... rigs) {
    for (int i = 0; i < times; ++i) {
        room.clock += 0.1;
        (rigs.tick(), ...);
    }
}

}  // namespace nezumi::dds
