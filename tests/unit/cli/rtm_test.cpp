// `nezumi run` among RTCs.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>

#include "engine/ports/cdr.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/openrtm/names.hpp"

using namespace nezumi;

namespace {

std::string exported_mouse(const std::string& nameserver) {
    return "robot \"mouse\" { model = \"raspimouse\" }\nrtm { export = \"mouse\", nameserver = \"" + nameserver +
           "\" }\n";
}

std::string hash_of(const std::string& out) {
    const std::string begin = "trace hash: ";
    const std::size_t at = out.find(begin);
    return at == std::string::npos ? "none" : out.substr(at + begin.size(), 16);
}

std::string forward() {
    std::vector<std::uint8_t> bytes;
    write_cdr_message(bytes, Velocity2D{.vx = 0.1}, 0);
    std::string text;
    for (const std::uint8_t byte : bytes) text += fmt::format("{:02x}", byte);
    return text;
}

}  // namespace

TEST_CASE("what RTCs do is in the journal, and a replay without them ends alike", "[cli][rtm][wallclock]") {
    std::string hash;
    Scratch folder;
    const std::string journal = folder.path("run.journal").string();
    std::string system;
    {
        const Names names;
        system = folder.write("system.lua", exported_mouse(names.address())).string();
        Program run({"run", system, "--headless", "--duration", "8", "--journal", journal, "--trace-hash"});
        REQUIRE(run.wait_for_error("rtm: mouse is "));
        Peer out({fake_rtc(), names.address(), "Out0", "out", "TimedVelocity2D", "out"});
        REQUIRE(out.heard("ready") == "ready");
        out.say("connect mouse0 target_velocity_in dataflow_type=push");
        REQUIRE(out.heard("connected ") == "connected 0");
        for (int i = 0; i < 20; ++i) {
            out.say("send " + forward());
            CHECK(out.heard("sent ") == "sent 0");
        }
        CHECK(run.wait() == 0);
        hash = hash_of(run.out);
    }
    Program still({"run", folder.write("still.lua", "robot \"mouse\" { model = \"raspimouse\" }").string(),
                   "--headless", "--speed", "max", "--duration", "8", "--trace-hash"});
    CHECK(still.wait() == 0);
    CHECK(hash_of(still.out) != hash);  // it did move
    Program replay({"run", system, "--headless", "--replay", journal, "--trace-hash"});
    CHECK(replay.wait() == 0);
    CHECK(hash_of(replay.out) == hash);
    CHECK(replay.error.find("rtm:") == std::string::npos);
}

TEST_CASE("a run without a name service says so once, and goes on", "[cli][rtm][wallclock]") {
    need_omniorb();
    Scratch folder;
    const std::string address = "localhost:" + std::to_string(free_port());
    Program run({"run", folder.write("system.lua", exported_mouse(address)).string(), "--headless", "--duration", "4"});
    CHECK(run.wait() == 0);
    const std::string said = "rtm: no name service answers at " + address + ": start one, as omniNames";
    CHECK(run.error.find(said) != std::string::npos);
    CHECK(run.error.find(said) == run.error.rfind(said));
}
