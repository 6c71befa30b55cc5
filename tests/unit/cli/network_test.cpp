// Processes as hosts: `network` in what `nezumi run`, `check` and `test` read.
#include <catch2/catch.hpp>
#include <csignal>
#include <memory>
#include <string>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

// A host that counts, and one that says what it hears; both in a domain that no other test uses.
struct TwoHosts {
    TwoHosts() {
        scratch.write("behaviors/counter.lua", R"(
local out = output("out", "TimedLong")
state.count = 0
function on_execute()
  state.count = state.count + 1
  out:write(state.count)
end
)");
        scratch.write("behaviors/listener.lua", R"(
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
behavior "it" { script = "counter" }
)")
                      .string();
        listener = scratch
                       .write("listener.lua", R"(network { name = "two", domain = 221 }
behavior "it" { script = "listener" }
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
        REQUIRE(listener.wait_for_error("host one has gone"));
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

TEST_CASE("what is wrong with topics of ROS is told by check, each at its line", "[cli][network]") {
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
    CHECK(said.find("TimedVelocity2D is made of no 'std_msgs/msg/Bool'") != std::string::npos);
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
