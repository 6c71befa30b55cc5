// Processes as hosts: `network` in what `nezumi run`, `check` and `test` read.
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

// A host that counts, and one that says what it hears; both in a domain that no other test uses.
struct TwoHosts {
    TwoHosts() {
        scratch.write("behaviors/counting.lua", R"(
local out = output("out", "TimedLong")
state.count = 0
function on_execute()
  state.count = state.count + 1
  out:write(state.count)
end
)");
        scratch.write("behaviors/listening.lua", R"(
local heard = input("in", "TimedLong", "", { queue = 50 })
local silent = 0
function on_execute()
  if heard.is_new then
    if silent > 100 or silent == 0 then log.warn("hears") end
    while heard.is_new do heard:read() end
    silent = 1
  elseif silent > 0 then
    silent = silent + 1
    if silent == 100 then log.warn("hears nothing any more") end
  end
end
)");
        counter = scratch
                      .write("counter.lua", R"(network { name = "one", domain = 221 }
behavior "it" { script = "counting" }
)")
                      .string();
        listener = scratch
                       .write("listener.lua", R"(network { name = "two", domain = 221 }
behavior "it" { script = "listening" }
connect("one/it.out", "it.in")
)")
                       .string();
    }
    Scratch scratch;
    std::string counter, listener;
};

}  // namespace

TEST_CASE("a port of another process is found, lost when that is killed, and found again",
          "[cli][network][wallclock]") {
    TwoHosts hosts;
    Program listener({"run", hosts.listener, "--headless"});
    for (int i = 0; i < 2; ++i) {
        listener.error.clear();
        Program counter({"run", hosts.counter, "--headless"});
        INFO(listener.error);
        INFO(counter.error);
        REQUIRE(listener.wait_for_error("hears"));
        counter.send(SIGKILL);
        counter.wait();
        REQUIRE(listener.wait_for_error("hears nothing any more"));
        REQUIRE(listener.wait_for_error("host one has left"));
    }
    listener.send(SIGINT);
    CHECK(listener.wait() == 0);
}

TEST_CASE("an interface that is not there ends a run before it begins", "[cli][network]") {
    Scratch scratch;
    const std::string system =
        scratch.write("s.lua", "seed(1)\nnetwork { name = \"a\", domain = 222, interface = \"none9\" }\n").string();
    const Outcome ran = run_nezumi({"run", system, "--headless", "--duration", "1"});
    CHECK(ran.status == 2);
    CHECK(ran.error.find("s.lua:2: network: the domain can't be opened: ") != std::string::npos);
    CHECK(ran.error.find("none9") != std::string::npos);
    CHECK(run_nezumi({"check", system}).status == 0);
}

TEST_CASE("check reports each wrong topic of ROS at its line", "[cli][network]") {
    Scratch scratch;
    const std::string system = scratch
                                   .write("s.lua", R"(robot "mouse" { model = "raspimouse" }
ros { node = "n",
  publish = { ["mouse.current_velocity_ou"] = "/v" },
  subscribe = { ["/cmd_vel"] = { port = "mouse.target_velocity_in", type = "std_msgs/msg/Bool" } },
}
)")
                                   .string();
    const Outcome checked = run_nezumi({"check", system});
    CHECK(checked.status != 0);
    const std::string said = checked.out + checked.error;
    CHECK(said.find("s.lua:3:") != std::string::npos);
    CHECK(said.find("did you mean 'current_velocity_out'?") != std::string::npos);
    CHECK(said.find("s.lua:4:") != std::string::npos);
    CHECK(said.find("TimedVelocity2D can't be made from 'std_msgs/msg/Bool'") != std::string::npos);
}

TEST_CASE("a system of several hosts is tried in a scenario, where no other host is", "[cli][network]") {
    TwoHosts hosts;
    hosts.scratch.write("listener_test.lua", R"(
scenario("is alone", { timeout = 5 }, function(s)
  local world = s:load "listener.lua"
  s:run(1)
  s:check(world.it.status == "ACTIVE")
  s:check(world.it.ports["in"].connected)
end)
)");
    const Outcome tested = run_nezumi({"test", hosts.scratch.path("listener_test.lua").string()});
    INFO(tested.out + tested.error);
    CHECK(tested.status == 0);
}

TEST_CASE("a secret is made once, for its owner alone", "[cli][network]") {
    Scratch scratch;
    const std::string file = scratch.path("seminar.key").string();
    const Outcome made = run_nezumi({"network", "secret", file});
    CHECK(made.status == 0);
    CHECK(made.out.find("seminar.key is a new secret") != std::string::npos);
    using std::filesystem::perms;
    CHECK(std::filesystem::status(file).permissions() == (perms::owner_read | perms::owner_write));
    const Outcome again = run_nezumi({"network", "secret", file});
    CHECK(again.status == 2);
    CHECK(again.error.find("exists already") != std::string::npos);
}

TEST_CASE("a missing secret, one that others can read, or an invalid one ends a run", "[cli][network]") {
    Scratch scratch;
    const std::string system =
        scratch.write("s.lua", "network { name = \"a\", domain = 223, secret = \"s.key\" }\nseed(1)\n").string();
    const auto said = [&] {
        const Outcome ran = run_nezumi({"run", system, "--headless", "--duration", "1"});
        CHECK(ran.status == 2);
        return ran.error;
    };
    CHECK(said().find("s.lua:1: network: the secret 's.key' does not exist: `nezumi network secret FILE` makes one") !=
          std::string::npos);
    const auto key = scratch.write("s.key", "nezumi secret 1\nnone\n");
    std::filesystem::permissions(key, std::filesystem::perms{0644});
    CHECK(said().find("can be read by others: chmod 600") != std::string::npos);
    std::filesystem::permissions(key, std::filesystem::perms{0600});
    CHECK(said().find("the secret 's.key' is not valid") != std::string::npos);
}

TEST_CASE("hosts of a secret find each other, and those without it do not", "[cli][network][wallclock]") {
    TwoHosts hosts;
    REQUIRE(run_nezumi({"network", "secret", hosts.scratch.path("s.key").string()}).status == 0);
    const std::string with = ", secret = \"s.key\" }", none = " }";
    const auto host = [&](const std::string& name, const std::string& behavior, const std::string& key,
                          const std::string& rest) {
        return hosts.scratch
            .write(name + ".lua", "network { name = \"" + name + "\", domain = 224" + key +
                                      "\nbehavior \"it\" { script = \"" + behavior + "\" }\n" + rest)
            .string();
    };
    const std::string hears = "connect(\"one/it.out\", \"it.in\")\n";
    Program one({"run", host("one", "counting", with, ""), "--headless"});
    Program two({"run", host("two", "listening", with, hears), "--headless"});
    Program three({"run", host("three", "listening", none, hears), "--headless"});
    CHECK(two.wait_for_error("hears"));
    CHECK_FALSE(three.wait_for_error("hears", 3));
}

TEST_CASE("the console reads, sets and commands a component of another host", "[cli][network][wallclock]") {
    Scratch scratch;
    const std::string driven = scratch
                                   .write("driven.lua", R"(network { name = "one", domain = 223 }
behavior "driver" { script = "robot_controller", config = { speed_x = 0.1 } }
)")
                                   .string();
    const std::string asks = scratch.write("asks.lua", "network { name = \"two\", domain = 223 }\n").string();
    const std::string lines = scratch
                                  .write("lines.txt", R"(run(5)
print(hosts.one.driver.type, hosts.one.driver.status, hosts.one.driver.config.speed_x)
hosts.one.driver.config.speed_x = 0.25
print(hosts.one.driver.config.speed_x)
print(hosts.one.driver:deactivate(), hosts.one.driver.status)
print(hosts.one.driver.out)
hosts.one.driver.config.speed_x = 99
hosts.one.driver:measure(1)
hosts.ona
)")
                                  .string();
    Program one({"run", driven, "--headless"});
    const Outcome ran = run_nezumi({"run", asks, "--batch", "--speed", "1"}, "", lines);
    INFO(ran.error);
    CHECK(ran.out.find("RobotController\tACTIVE\t0.1\n0.25\nINACTIVE\tINACTIVE\none/driver.out  TimedVelocity2D  {") !=
          std::string::npos);
    const std::string said = ran.out + ran.error;
    CHECK(said.find("host one: parameter 'speed_x' (number): 99.0 is above its maximum 1.5") != std::string::npos);
    CHECK(said.find("host one: driver has no 'measure'") != std::string::npos);
    CHECK(said.find("there is no host 'ona' (did you mean 'one'?)") != std::string::npos);
}

TEST_CASE("messages from the network are in the journal, and a replay without the network is the same",
          "[cli][network][wallclock]") {
    TwoHosts hosts;
    Program counter({"run", hosts.counter, "--headless"});
    const std::string journal = hosts.scratch.path("j").string();
    const Outcome ran =
        run_nezumi({"run", hosts.listener, "--headless", "--duration", "3", "--journal", journal, "--trace-hash"});
    REQUIRE(ran.status == 0);
    REQUIRE(ran.error.find("hears") != std::string::npos);
    counter.send(SIGKILL);
    counter.wait();
    const Outcome again =
        run_nezumi({"run", hosts.listener, "--headless", "--speed", "max", "--replay", journal, "--trace-hash"});
    INFO(again.error);
    CHECK(again.status == 0);
    CHECK(again.out == ran.out);
    CHECK(again.error.find("hears") != std::string::npos);
}

TEST_CASE("the hosts of a domain are listed", "[cli][network][wallclock]") {
    TwoHosts hosts;
    Program counter({"run", hosts.counter, "--headless"});
    std::string out;
    for (int i = 0; i < 10 && out.find("host one") == std::string::npos; ++i)
        out = run_nezumi({"network", "list", "--domain", "221", "--seconds", "2"}).out;
    CHECK(out.find("host one  nezumi 0.") != std::string::npos);
    CHECK(run_nezumi({"network", "list", "--domain", "225", "--seconds", "0.2"}).out == "domain 225 is empty\n");
    CHECK(run_nezumi({"network", "list", "--domain", "300"}).error ==
          "nezumi: network list: --domain: expected 0 to 232, got 300\n");
}
