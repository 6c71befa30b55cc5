// `nezumi run` among RTCs.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>

#include "engine/values/cdr.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/openrtm/names.hpp"

using namespace nezumi;

namespace {

std::string exported_mouse(const std::string& nameserver) {
    return "robot \"mouse\" { model = \"raspimouse\" }\nrtm { export = \"mouse\", nameserver = \"" + nameserver +
           "\" }\n";
}

std::string hash_told_in(const std::string& out) {
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

TEST_CASE("the acts of RTCs are in the journal, and a replay without RTCs ends in the same way",
          "[cli][rtm][wallclock]") {
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
        hash = hash_told_in(run.out);
    }
    Program still({"run", folder.write("still.lua", "robot \"mouse\" { model = \"raspimouse\" }").string(),
                   "--headless", "--speed", "max", "--duration", "8", "--trace-hash"});
    CHECK(still.wait() == 0);
    CHECK(hash_told_in(still.out) != hash);  // it did move
    Program replay({"run", system, "--headless", "--replay", journal, "--trace-hash"});
    CHECK(replay.wait() == 0);
    CHECK(hash_told_in(replay.out) == hash);
    CHECK(replay.error.find("rtm:") == std::string::npos);
}

TEST_CASE("a run without a name service says so once, and goes on", "[cli][rtm][wallclock]") {
    need_omniorb();
    Scratch folder;
    const std::string address = "localhost:" + std::to_string(free_port());
    Program run({"run", folder.write("system.lua", exported_mouse(address)).string(), "--headless", "--duration", "4"});
    CHECK(run.wait() == 0);
    const std::string said = "rtm: no name service answers at " + address + ": start one, for example omniNames";
    CHECK(run.error.find(said) != std::string::npos);
    CHECK(run.error.find(said) == run.error.rfind(said));
}

TEST_CASE("a network interface that this computer does not have is refused in one line", "[cli][rtm][wallclock]") {
    const Names names;
    Scratch folder;
    const std::string text = "robot \"mouse\" { model = \"raspimouse\" }\nrtm { export = \"mouse\", nameserver = \"" +
                             names.address() + "\", interface = \"192.0.2.1\" }\n";
    const std::string system = folder.write("system.lua", text).string();
    Program run({"run", system, "--headless", "--duration", "1"});
    CHECK(run.wait() == 2);
    CHECK(run.error == system + ":2: rtm: can't listen at 192.0.2.1: is that an address of this computer?\n");
}

TEST_CASE("a console works with RTCs: it lists, configures, activates and connects them", "[cli][rtm][wallclock]") {
    const Names names;
    Scratch folder;
    const std::string system = folder.write("system.lua", exported_mouse(names.address())).string();
    const std::string commands = folder
                                     .write("commands",
                                            "ls \"rtm:Out0\"\nrtm(\"Out0\", { speed = 0.75 })\nactivate \"rtm:Out0\"\n"
                                            "connect(\"rtm:Out0.out\", \"mouse.target_velocity_in\")\nrun(5)\n"
                                            "mouse.target_velocity_in.peers\nls \"rtm:Out1\"\nsave \"saved.lua\"\n")
                                     .string();
    Peer out({fake_rtc(), names.address(), "Out0", "out", "TimedVelocity2D", "out"});
    REQUIRE(out.heard("ready") == "ready");
    Program run({"run", system, "--batch", "--speed", "1"}, folder.path().string(), commands);
    CHECK(out.heard("uses ") == "uses default speed=0.75");
    CHECK(out.heard("activated") == "activated");
    CHECK(out.heard("joined ") == "joined Out0.out_mouse.target_velocity_in");
    CHECK(run.wait() == 1);
    CHECK(run.out.find("Out0  Fake, INACTIVE\n  out out  TimedVelocity2D  not connected\n  config.speed = 0.5\n") !=
          std::string::npos);
    CHECK(run.out.find("{ \"rtm:Out0.out\" }") != std::string::npos);
    CHECK(run.error.find("line 7: ls: there is no RTC 'Out1' in the name service (did you mean 'Out0'?)") !=
          std::string::npos);
    CHECK(text_of_file(folder.path("saved.lua")).find("connect(\"rtm:Out0.out\", \"mouse.target_velocity_in\")") !=
          std::string::npos);
}
