// Log lines of a system.
#include "engine/base/log.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/system/system.hpp"

using namespace nezumi;

TEST_CASE("a log line has the time of its tick", "[engine][system]") {
    class Talker final : public Device {
    public:
        Talker() : Device("talker", "Talker") {}
        void sense(const Time&) override { log(LogLevel::warn, "senses"); }
        void actuate(const Time&) override { log(LogLevel::warn, "acts"); }
    };
    std::vector<std::string> said;
    System system({.rate = 4, .physics_step = 0.05}, [&](const LogLine& line) {
        said.push_back(fmt::format("{} {} {}", line.seconds, line.component, line.text));
    });
    REQUIRE(system.add(std::make_unique<Talker>()));
    REQUIRE((*system.component("talker"))->activate(system.now()));
    system.tick();
    system.tick();
    CHECK(said ==
          std::vector<std::string>{"0 talker senses", "0 talker acts", "0.25 talker senses", "0.25 talker acts"});
}
