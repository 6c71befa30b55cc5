// A live system that is exported for real: a name service of its own, and RTCs that are other programs.
#pragma once

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bindings/openrtm/rtm_server.hpp"
#include "engine/values/cdr.hpp"
#include "tests/unit/live_rig.hpp"
#include "tests/unit/openrtm/names.hpp"
#include "tests/unit/openrtm/peer.hpp"

namespace nezumi {

/// A behaviour that has ports, and does nothing: tests write and look at them.
inline std::string relay_behavior(std::string_view type) {
    return fmt::format(
        "input(\"in\", \"{0}\", \"\")\noutput(\"out\", \"{0}\", \"\")\n"
        "param(\"speed\", 0.5, {{ min = 0, max = 1 }})\nfunction on_execute() end\n",
        type);
}

struct WireRig : Names, LiveRig {
    explicit WireRig(std::string_view type = "TimedLong", const std::string& more = "")
        : LiveRig(
              "robot \"mouse\" { model = \"raspimouse\" }\nbehavior \"relay\" { script = \"relay\" }\n"
              "rtm { export = { \"mouse\", \"relay\" }, nameserver = \"" +
                  address() + "\" }\n" + more,
              {{"relay", relay_behavior(type)}}) {
        auto opened =
            openrtm::RtmServer::open({.system = [this]() -> const System& { return live->system(); },
                                      .spec = [this]() -> const SystemSpec& { return live->spec(); },
                                      .starts = [this] { return live->starts(); },
                                      .act = [this](const Act& act, const Actor& who) { return live->act(act, who); },
                                      .deliver = [this](const Port& port, const Act& act,
                                                        const Actor& who) { return live->deliver(port, act, who); },
                                      .say = [this](bool, const std::string& line) { told += line + "\n"; }});
        if (!opened) FAIL(describe(opened.error()));
        server = std::move(*opened);
    }

    void turn() {
        server->before_tick();
        live->tick();
        server->after_tick();
    }
    template <class Condition>
    bool until(const Condition& condition, double seconds = 60) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (!condition()) {
            if (std::chrono::steady_clock::now() > end) return false;
            turn();
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return true;
    }
    bool tells(const std::string& text) {
        return until([&] { return told.find(text) != std::string::npos; });
    }
    /// The same of a whole line: "connected: ..." is a part of "not connected: ..." as well.
    bool tells_line(const std::string& line) { return tells("\n" + line + "\n"); }
    /// An RTC with one port; ready, and so are we.
    std::unique_ptr<Peer> rtc(const std::string& name, const std::string& port, std::string_view type,
                              const std::string& direction) {
        auto peer = std::make_unique<Peer>(
            std::vector<std::string>{fake_rtc(), address(), name, port, std::string(type), direction});
        REQUIRE(hears(*peer, "ready") == "ready");
        is_known = is_known || tells("relay is ");
        REQUIRE(is_known);
        return peer;
    }
    std::string hears(Peer& peer, const std::string& begin) {
        return peer.heard(begin, [this] { turn(); });
    }
    std::string answer(Peer& peer, const std::string& line, const std::string& begin) {
        peer.say(line);
        return hears(peer, begin);
    }
    void publish(const Value& value) { REQUIRE(live->act(Write{"relay.out", value}, {Actor::Kind::console})); }
    Value arrived() { return component("relay").find_in_port("in")->value(); }

    std::string told = "\n";
    bool is_known = false;  // the name service has us
    std::unique_ptr<openrtm::RtmServer> server;
};

inline std::string hex_of(const Value& value, std::endian order) {
    std::vector<std::uint8_t> bytes;
    write_cdr_message(bytes, value, 1.5, {.order = order});
    std::string text;
    for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

/// The payload of "got HEX"; the zero of the type where there is none.
inline Value payload_of(const std::string& line, const MessageType* type, std::endian order) {
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 4; i + 1 < line.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(line.substr(i, 2), nullptr, 16)));
    auto value = make_payload(type);
    double tm = 0;
    INFO(line);
    CHECK(read_cdr_message(bytes, value, tm, {.order = order}));
    return value;
}

}  // namespace nezumi
