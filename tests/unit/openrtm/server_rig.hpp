// A live system among RTCs, as the part with CORBA sees it: without one.
#pragma once

#include <atomic>
#include <catch2/catch.hpp>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/openrtm/rtm_server.hpp"
#include "engine/values/cdr.hpp"
#include "tests/unit/live_rig.hpp"

namespace nezumi::openrtm {

inline const std::string exported_system = R"(
robot    "mouse"      { model = "raspimouse" }
behavior "controller" { script = "counter", sets = { fast = { speed_x = 0.5 } } }
rtm { export = { "mouse", "controller" } }
connect("controller.out", "rtm:Mouse0.target_velocity_in")
)";

constexpr double time_of_test = 1.7e9;  // [s] since 1970

// What is told to the other side.
struct Told {
    std::vector<RtcProfile> profiles{};
    std::vector<RtcLink> links{};
    std::vector<RtcInside> inside{};
    std::map<std::string, WantedOrders, std::less<>> wanted{};
    std::vector<RtcLink> made{};
    std::vector<std::pair<std::string, std::vector<std::uint8_t>>> sent{};
    OrbOptions options{};
    std::vector<PeerQuestion> questions{};
    PeerAnswer answer{};
    int shown = 0;
    bool ended = false;
};

class TellingOrb final : public Orb {
public:
    explicit TellingOrb(Told& told) : told_(told) {}
    ~TellingOrb() override { told_.ended = true; }
    TellingOrb(const TellingOrb&) = delete;
    TellingOrb& operator=(const TellingOrb&) = delete;
    void show(std::vector<RtcProfile> profiles, std::vector<RtcLink> links) override {
        told_.profiles = std::move(profiles);
        told_.links = std::move(links);
        ++told_.shown;
    }
    void show_inside(std::vector<RtcInside> connections) override { told_.inside = std::move(connections); }
    void ask(PeerQuestion question, TakeAnswer take) override {
        told_.questions.push_back(question);
        take(question, told_.answer);
    }
    bool is_made(const RtcLink& link) override {
        return std::find(told_.made.begin(), told_.made.end(), link) != told_.made.end();
    }
    WantedOrders wanted(std::string_view path) override {
        const auto found = told_.wanted.find(path);
        return found != told_.wanted.end() ? found->second : WantedOrders{};
    }
    void publish(std::string_view path, std::span<const std::uint8_t> bytes, std::endian order) override {
        const std::string name = std::string(path) + (order == std::endian::little ? " little" : " big");
        told_.sent.emplace_back(name, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
    }

private:
    Told& told_;
};

// Remembers who did what.
struct Acts final : ActObserver {
    void acted(const ActTime& /*when*/, std::shared_ptr<const PastAct> act,
               const Expected<ActResult>& result) override {
        lines.push_back(std::string(name_of(act->act)) + " by " + to_text(act->who) +
                        (result ? "" : ": " + result.error().message));
    }
    void ran_out_of_time(const ActTime& /*when*/, const std::string& /*component*/,
                         const Component::OutOfTime& /*call*/) override {}
    std::vector<std::string> lines;
};

struct ServerRig : LiveRig {
    explicit ServerRig(const std::string& system = exported_system, const BuildOptions& build = {})
        : ServerRig(system, {{"counter", counter_behavior}}, build) {}
    ServerRig(const std::string& system, const std::map<std::string, std::string>& behaviors,
              const BuildOptions& build = {})
        : LiveRig(system, behaviors, disk(), build) {
        live->observe_acts(&acts);
        auto opened = RtmServer::open(host(), [this](const OrbOptions& options, RtcSite&) {
            told.options = options;
            return Expected<std::unique_ptr<Orb>>(std::make_unique<TellingOrb>(told));
        });
        if (!opened) FAIL(describe(opened.error()));
        server = std::move(*opened);
    }
    RtmHost host() {
        return {.system = [this]() -> const System& { return live->system(); },
                .spec = [this]() -> const SystemSpec& { return live->spec(); },
                .starts = [this] { return live->starts(); },
                .act = [this](const Act& act, const Actor& who) { return live->act(act, who); },
                .deliver = [this](const Port& port, const Act& act,
                                  const Actor& who) { return live->deliver(port, act, who); },
                .say = [this](bool, const std::string& line) { said_lines.push_back(line); },
                .wall_clock = [] { return time_of_test; }};
    }
    void turn(int ticks = 1) {
        for (; ticks > 0; --ticks) {
            server->before_tick();
            live->tick();
            server->after_tick();
        }
    }
    template <class T>
    PutAnswer put(const std::string& path, const T& value) {
        std::vector<std::uint8_t> bytes;
        write_cdr_message(bytes, value, 0);
        return server->put(path, "Peer0.out_x", bytes, std::endian::little);
    }
    // What an RTC asks, in a thread as CORBA's are.
    RtcAnswer ask(const RtcRequest& request) {
        RtcAnswer answer = RtcAnswer::busy;
        std::atomic<bool> answered = false;
        std::thread asks([&] {
            answer = server->perform(request);
            answered = true;
        });
        while (!answered) {
            server->serve();
            std::this_thread::yield();
        }
        asks.join();
        return answer;
    }

    Acts acts;
    Told told;
    std::vector<std::string> said_lines;
    std::unique_ptr<RtmServer> server;
};

}  // namespace nezumi::openrtm
