// From a system as data to one that runs: every reason why not, with the place of its line.
#include "engine/system/build_system.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/engine/fake_world.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;

namespace {

// A behaviour with a parameter `speed_x` within -1.5 and 1.5.
class WithSpeed : public TryComponent {
public:
    explicit WithSpeed(std::string name) : TryComponent(std::move(name)) {
        ParameterSpec bounded;
        bounded.name = "speed_x";
        bounded.initial = 0.0;
        bounded.min = -1.5;
        bounded.max = 1.5;
        static_cast<void>(parameters_.declare(bounded));
    }
};

struct Plan {
    Plan() {
        spec.models["mouse"] = fake_mouse();
        makers.world = [](const ArenaSpec&, const PhysicsSpec&,
                          const std::function<void(const std::string&)>&) -> Expected<std::unique_ptr<World>> {
            return std::make_unique<FakeWorld>();
        };
        makers.behavior = [this](const BehaviorEntry& entry,
                                 const MakerContext& context) -> Expected<std::unique_ptr<Component>> {
            seed = context.seed;
            if (entry.script == "broken") return failure("unexpected symbol", {"broken.lua", 3});
            return std::make_unique<WithSpeed>(entry.name);
        };
        makers.components["Camera"]["sim"] = [](const ComponentEntry& entry,
                                                System&) -> Expected<std::unique_ptr<Component>> {
            return std::make_unique<TryComponent>(entry.name);
        };
        makers.bodies["mouse_driver"] = [this](const RobotEntry&,
                                               const RobotSpec& model) -> Expected<std::unique_ptr<RobotBody>> {
            if (!has_hardware) return failure("/dev/rtmotor_raw_l0 is not there: is the driver loaded?");
            return std::make_unique<FakeBody>(real, model, not_simulated);
        };
    }
    RobotEntry& robot(std::string name, double x = 0) {
        RobotEntry entry;
        entry.name = std::move(name);
        entry.model = "mouse";
        entry.pose.position.x = x;
        entry.place = {"s.lua", next_line++};
        spec.entries.emplace_back(entry);
        return std::get<RobotEntry>(spec.entries.back());
    }
    BehaviorEntry& behavior(std::string name) {
        BehaviorEntry entry;
        entry.name = std::move(name);
        entry.place = {"s.lua", next_line++};
        spec.entries.emplace_back(entry);
        return std::get<BehaviorEntry>(spec.entries.back());
    }
    void component(std::string name, std::string type, std::string backend = "") {
        ComponentEntry entry;
        entry.backend = std::move(backend);
        entry.name = std::move(name);
        entry.type = std::move(type);
        entry.place = {"s.lua", next_line++};
        spec.entries.emplace_back(entry);
    }
    void connect(std::string from, std::string to) {
        spec.connections.push_back({std::move(from), std::move(to), {"s.lua", next_line++}});
    }
    std::string refusal() {
        const auto built = build_system(spec, makers, {});
        return built ? "" : describe(built.error());
    }
    std::unique_ptr<System> build(const BuildOptions& options = {}) {
        auto built = build_system(spec, makers, options);
        INFO((built ? "" : describe(built.error())));
        REQUIRE(built);
        return std::move(*built);
    }

    FakeHull real;  ///< of the robot with the driver
    bool has_hardware = true;
    SystemSpec spec;
    Makers makers;
    std::uint64_t seed = 0;
    int next_line = 1;
};

}  // namespace

TEST_CASE("a warning of a world has the time of its tick", "[engine][build]") {
    Plan plan;
    std::function<void(const std::string&)> warn;
    plan.makers.world = [&warn](
                            const ArenaSpec&, const PhysicsSpec&,
                            const std::function<void(const std::string&)>& how) -> Expected<std::unique_ptr<World>> {
        warn = how;
        return std::make_unique<FakeWorld>();
    };
    std::vector<LogLine> log;
    const auto system = plan.build({.log = [&log](const LogLine& line) { log.push_back(line); }});
    for (int i = 0; i < 50; ++i) system->tick();
    warn("it slipped");
    REQUIRE(log.size() == 1);
    CHECK(log.front().text == "it slipped");
    CHECK(log.front().seconds == Approx(0.5));
}

TEST_CASE("a system is built in the order of its file, configured and wired, and nothing is active",
          "[engine][build]") {
    Plan plan;
    plan.behavior("controller").config = {{"speed_x", 0.5}};
    plan.robot("mouse");
    plan.component("eye", "Camera");
    plan.behavior("sleeper").active = false;
    plan.connect("controller.speed", "mouse.velocity_in");
    const auto system = plan.build();
    std::vector<std::string> names;
    for (const auto& component : system->components()) {
        names.push_back(component->name());
        CHECK(component->state() == LifeState::inactive);
    }
    CHECK(names == std::vector<std::string>{"controller", "mouse", "eye", "sleeper"});
    CHECK(system->find("controller")->parameters().find("speed_x")->value == Value(0.5));
    CHECK(system->peers(**system->port("mouse.velocity_in")) == std::vector<std::string>{"controller.speed"});
    activate_all(*system, plan.spec);
    CHECK(system->find("controller")->state() == LifeState::active);
    CHECK(system->find("mouse")->state() == LifeState::active);
    CHECK(system->find("sleeper")->state() == LifeState::inactive);
    system->tick();
}

TEST_CASE("a component that can't be activated is in ERROR, and the others go on", "[engine][build]") {
    Plan plan;
    plan.behavior("bad");
    plan.behavior("good");
    const auto system = plan.build();
    dynamic_cast<TryComponent&>(*system->find("bad")).activated = [](TryComponent&) -> Expected<void> {
        return failure("no");
    };
    activate_all(*system, plan.spec);
    CHECK(system->find("bad")->state() == LifeState::error);
    CHECK(system->find("good")->state() == LifeState::active);
}

TEST_CASE("the limits in a system file replace those of the model, and the others stay", "[engine][build]") {
    Plan plan;
    plan.robot("fast").limits.speed = 2.0;
    plan.robot("slow").limits.yaw_acceleration = 1.0;
    const auto system = plan.build();
    CHECK(system->find_robot("fast")->guard().limits() ==
          Limits{.speed = 2.0, .yaw_rate = 6, .acceleration = 2, .yaw_acceleration = 12});
    CHECK(system->find_robot("slow")->guard().limits() ==
          Limits{.speed = 0.5, .yaw_rate = 6, .acceleration = 2, .yaw_acceleration = 1});
}

TEST_CASE("the seed is that of the file, otherwise the caller's, unless the caller's must win", "[engine][build]") {
    Plan plan;
    plan.behavior("it");
    CHECK(plan.build({.seed = 5})->settings().seed == 5);
    CHECK(plan.seed == 5);
    plan.spec.seed = 7;
    plan.build({.seed = 5});
    CHECK(plan.seed == 7);
    plan.build({.seed = 5, .seed_wins = true});
    CHECK(plan.seed == 5);
}

TEST_CASE("the error of a wrong entry has its location", "[engine][build]") {
    const auto refused = [](const auto& spoil) {
        Plan plan;
        plan.robot("mouse");
        spoil(plan);
        return plan.refusal();
    };
    CHECK(refused([](Plan& p) { p.robot("other").model = "mose"; }) ==
          "s.lua:2: robot 'other': there is no model 'mose' (did you mean 'mouse'?)");
    CHECK(refused([](Plan& p) { p.makers.world = nullptr; }) ==
          "s.lua:1: robot 'mouse': there is no simulated world to put it in");
    CHECK(refused([](Plan& p) { p.robot("other").backend = "x"; }) ==
          "s.lua:2: robot 'other': there is no backend 'x'; there are sim, mouse_driver");
    CHECK(refused([](Plan& p) { p.robot("other").backend = "mouse_drvier"; }) ==
          "s.lua:2: robot 'other': there is no backend 'mouse_drvier' (did you mean 'mouse_driver'?)");
    CHECK(refused([](Plan& p) {
              p.robot("other").backend = "mouse_driver";
              p.has_hardware = false;
          }) == "s.lua:2: /dev/rtmotor_raw_l0 is not there: is the driver loaded?");
    CHECK(refused([](Plan& p) {
              p.makers.bodies.clear();
              p.spec.models.at("mouse").hardware.driver = "mouse_driver";
              p.robot("other").backend = "mouse_drvier";
          }) == "s.lua:2: robot 'other': there is no backend 'mouse_drvier' (did you mean 'mouse_driver'?)");
    CHECK(refused([](Plan& p) { p.component("eye", "Camera", "v4l2"); }) ==
          "s.lua:2: component 'eye': there is no backend 'v4l2'; there is sim");
    CHECK(refused([](Plan& p) { p.robot("other", 200); }) == "s.lua:2: robot 'other' overlaps box 1: move one of them");
    CHECK(refused([](Plan& p) { p.robot("mouse"); }) == "s.lua:2: the name 'mouse' is given twice, first in line 1");
    CHECK(refused([](Plan& p) { p.behavior("it").script = "broken"; }) == "broken.lua:3: unexpected symbol");
    CHECK(refused([](Plan& p) { p.behavior("it").rate = 200; }) ==
          "s.lua:2: it: a rate of 200 Hz is above the tick's 100 Hz");
    CHECK(refused([](Plan& p) {
              BehaviorEntry& it = p.behavior("it");
              it.config = {{"speed_x", 2.0}};
              it.places = {{"config.speed_x", {"s.lua", 4, 7}}};
          }) == "s.lua:4:7: it: config: parameter 'speed_x' (number): 2.0 is above its maximum 1.5");
    CHECK(refused([](Plan& p) {
              p.behavior("it").config = {{"speed_y", 1.0}};
          }) == "s.lua:2: it: config: unknown parameter 'speed_y' (did you mean 'speed_x'?)");
    CHECK(refused([](Plan& p) {
              p.behavior("it").config = {{"speed_x", 2.0}};
          }) == "s.lua:2: it: config: parameter 'speed_x' (number): 2.0 is above its maximum 1.5");
    CHECK(refused([](Plan& p) {
              p.behavior("it").sets["fast"] = {{"speed_x", 9.0}};
          }) == "s.lua:2: it: set 'fast': parameter 'speed_x' (number): 9.0 is above its maximum 1.5");
    CHECK(refused([](Plan& p) {
              BehaviorEntry& it = p.behavior("it");
              it.sets["fast"] = {{"speed_x", 1.0}};
              it.set = "fsat";
          }) == "s.lua:2: it has no parameter set 'fsat' (did you mean 'fast'?)");
    CHECK(refused([](Plan& p) { p.component("eye", "Camra"); }) ==
          "s.lua:2: component 'eye': there is no type 'Camra' (did you mean 'Camera'?)");
    CHECK(refused([](Plan& p) {
              p.makers.components["Joystick"] = p.makers.components["Camera"];
              p.component("eye", "RobotController");
          }) == "s.lua:2: component 'eye': there is no type 'RobotController'; there are Camera, Joystick");
    CHECK(refused([](Plan& p) { p.connect("mouse.ir", "mouse.velocity_in"); }) ==
          "s.lua:2: types differ: mouse.ir is TimedShortSeq, mouse.velocity_in is TimedVelocity2D (did you mean "
          "'mouse.velocity'?)");
    CHECK(refused([](Plan& p) {
              p.spec.rate = 60;
              p.spec.rate_place = {"s.lua", 9};
          }).starts_with("s.lua:9: rate: a tick of 60 Hz"));
}

TEST_CASE("a robot that names its driver is simulated where the run has no drivers", "[engine][system]") {
    Plan plan;
    plan.makers.bodies.clear();
    plan.robot("mouse").backend = "mouse_driver";
    CHECK(plan.refusal() == "s.lua:1: robot 'mouse': there is no backend 'mouse_driver'; there is sim");
    plan.spec.models.at("mouse").hardware.driver = "mouse_driver";
    CHECK_FALSE(plan.build()->find_robot("mouse")->is_real());
}

TEST_CASE("an unknown driver is refused, also if nothing is real", "[engine][system]") {
    Plan plan;
    plan.robot("mouse");
    plan.spec.models.at("mouse").hardware.driver = "raspimose";
    CHECK_FALSE(plan.build()->find_robot("mouse")->is_real());
    plan.makers.drivers = {"ev3", "raspimouse"};
    CHECK(plan.refusal() ==
          "s.lua:1: robot 'mouse': hardware: there is no driver 'raspimose' (did you mean 'raspimouse'?)");
}

TEST_CASE("one robot of a system may be real and the others simulated", "[engine][build][hardware]") {
    Plan plan;
    plan.robot("first");
    plan.robot("mouse").backend = "mouse_driver";
    plan.robot("last").backend = "sim";
    const auto system = plan.build();
    activate_all(*system, plan.spec);
    CHECK(system->find_robot("mouse")->is_real());
    CHECK_FALSE(system->find_robot("first")->is_real());
    CHECK(system->find_robot("first")->id() == 0);
    CHECK(system->find_robot("last")->id() == 1);  // the world knows of two
    for (const char* name : {"mouse", "last"})
        system->find(name)->find_in_port("velocity_in")->inject(Velocity2D{.vx = 0.1});
    system->tick();
    const auto& world = dynamic_cast<const FakeWorld&>(*system->world());
    CHECK(plan.real.speeds.left > 0);
    CHECK(world.hulls[0]->speeds == Wheels{});
    CHECK(world.hulls[1]->speeds.left > 0);
    REQUIRE(system->remove("mouse"));
    CHECK(plan.real.speeds == Wheels{});
    CHECK(system->find_robot("last")->id() == 1);
}

TEST_CASE("a system with only real robots needs no world", "[engine][build][hardware]") {
    Plan plan;
    plan.makers.world = nullptr;
    plan.robot("mouse").backend = "mouse_driver";
    const auto system = plan.build();
    CHECK(system->world() == nullptr);
    system->tick();
}

TEST_CASE("a real robot does no more than its description allows the hardware", "[engine][build][hardware][safety]") {
    Plan plan;
    plan.spec.models["mouse"].drive.hardware_limits = {
        .speed = 0.2, .yaw_rate = 9, .acceleration = 0.5, .yaw_acceleration = 4};
    RobotEntry& mouse = plan.robot("mouse");
    mouse.backend = "mouse_driver";
    mouse.limits.speed = 2.0;         // only in simulation may a system raise a limit
    mouse.limits.acceleration = 0.1;  // to lower one is always allowed
    const auto system = plan.build();
    CHECK(system->find_robot("mouse")->guard().limits() ==
          Limits{.speed = 0.2, .yaw_rate = 6, .acceleration = 0.1, .yaw_acceleration = 4});
}

TEST_CASE("limits above those of a real robot are reported once, with its actual limits and how to raise them",
          "[engine][build][hardware][safety]") {
    Plan plan;
    plan.spec.models["mouse"].drive.limits = {.speed = 0.5, .yaw_rate = 6, .acceleration = 2, .yaw_acceleration = 12};
    Limits& hardware = plan.spec.models["mouse"].drive.hardware_limits;
    hardware = {.speed = 0.2, .yaw_rate = 2, .acceleration = 0.52, .yaw_acceleration = 4};
    RobotEntry& mouse = plan.robot("mouse");
    mouse.backend = "mouse_driver";
    mouse.limits = {.speed = 1.0, .yaw_rate = 2, .acceleration = 1.5, .yaw_acceleration = std::nullopt};
    std::vector<std::string> told;
    const auto tell = [&] {
        told.clear();
        const auto system = plan.build({.log = [&](const LogLine& line) { told.push_back(line.text); }});
        activate_all(*system, plan.spec);
        for (int i = 0; i < 10; ++i) system->tick();
        return told;
    };
    CHECK(tell() == std::vector<std::string>{
                        "s.lua:1: robot 'mouse': limits: the real robot gets 0.2 m/s instead of 1, 0.52 m/s^2 instead "
                        "of 1.5: once its odometry is calibrated (nezumi calibrate odometry) it gets 0.5 m/s, 1.5 "
                        "m/s^2"});
    hardware = plan.spec.models["mouse"].drive.limits;  // as after a calibration
    CHECK(tell() ==
          std::vector<std::string>{"s.lua:1: robot 'mouse': limits: the real robot gets 0.5 m/s instead of 1: its "
                                   "model allows no more, and a system file can exceed that only in simulation"});
    mouse.limits.speed = 0.4;
    CHECK(tell().empty());
    mouse.limits.speed = 1.0;
    mouse.backend = "sim";
    CHECK(tell().empty());
    CHECK(plan.build()->find_robot("mouse")->guard().limits().speed == 1.0);
}

TEST_CASE("a robot that is refused while a system runs leaves nothing behind", "[engine][build]") {
    Plan plan;
    plan.robot("first");
    auto system = plan.build();
    RobotEntry late;
    late.name = "late";
    late.model = "mouse";
    late.pose.position.x = 200;
    const auto refused = add_entry(*system, late, plan.spec, plan.makers);
    REQUIRE_FALSE(refused);
    CHECK(system->find("late") == nullptr);
    system->tick();
    late.pose.position.x = 1;
    const auto added = add_entry(*system, late, plan.spec, plan.makers);
    REQUIRE(added);
    CHECK(system->find_robot("late")->id() == 1);
    system->tick();
}

TEST_CASE("robots keep the numbers that their world gave them when one of them goes", "[engine][build]") {
    Plan plan;
    plan.robot("a");
    plan.robot("b");
    auto system = plan.build();
    REQUIRE(system->remove("a"));
    CHECK(system->find_robot("b")->id() == 1);
    RobotEntry late;
    late.name = "c";
    late.model = "mouse";
    REQUIRE(add_entry(*system, late, plan.spec, plan.makers));
    CHECK(system->find_robot("c")->id() == 2);
    REQUIRE(system->find("c")->activate(system->now()));
    system->tick();
    const auto& world = dynamic_cast<const FakeWorld&>(*system->world());
    CHECK(world.hulls[2]->all_speeds.size() == 1);
}
