// Parameters as scripts declare, read and set them.
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

TEST_CASE("a parameter's type follows its default", "[lua][parameters]") {
    ScriptRig rig(R"(
param("whole", 30) param("number", 0.0) param("truth", true) param("text", "abc") param("array", { 1.0, 0.5 })
function on_execute()
  assert(math.type(config.whole) == "integer" and math.type(config.number) == "float")
  assert(config.truth == true and config.text == "abc" and config.array[2] == 0.5 and #config.array == 2)
end)");
    Parameters& parameters = rig.component->parameters();
    CHECK(parameters.set("whole", 3.0));
    CHECK(describe(parameters.set("whole", 3.5).error()) ==
          "parameter 'whole' (integer): expected integer, got number 3.5");
    CHECK(parameters.set("number", std::int64_t{3}));
    CHECK(parameters.set("array", std::vector<std::int64_t>{1, 2}));
    rig.activate();
    CHECK(parameters.set("array", std::vector<double>{1.0, 0.5}));
    rig.tick();
    CHECK(rig.error() == "");
}

TEST_CASE("bounds are inclusive and hold whoever sets the value", "[lua][parameters]") {
    ScriptRig rig(R"(
param("speed", 0.0, { min = -1.5, max = 1.5, step = 0.01, widget = "slider", unit = "m/s", doc = "how fast" })
function on_execute() config.speed = 1.5 + config.speed end)");
    const ParameterSpec& spec = rig.component->parameters().find("speed")->spec;
    CHECK(spec.min == -1.5);
    CHECK(spec.max == 1.5);
    CHECK(spec.step == 0.01);
    CHECK(spec.widget == "slider");
    CHECK(spec.unit == "m/s");
    CHECK(spec.doc == "how fast");
    rig.activate().tick(2);
    CHECK(rig.error() == "robot_controller.lua:3: parameter 'speed' (number): 3.0 is above its maximum 1.5");
    CHECK(rig.component->parameters().find("speed")->value == Value(1.5));
}

TEST_CASE("config.x = v in a script is checked at once and holds from the next tick", "[lua][parameters]") {
    ScriptRig rig(R"(
param("x", 1)
local seen = output("seen", "TimedLongSeq")
function on_execute()
  config.x = config.x + 1
  config.x = config.x + 10
  seen:write { config.x }
end)");
    rig.activate();
    for (const std::int32_t expected : {1, 11, 21}) {
        rig.tick();
        CHECK(rig.out<std::vector<std::int32_t>>("seen").read() == std::vector<std::int32_t>{expected});
    }
}

TEST_CASE("config.x = v in a script holds from the next tick in every state and at every rate", "[lua][parameters]") {
    const auto value = [](const ScriptRig& rig) { return rig.component->parameters().find("x")->value; };
    const auto set = [](ScriptRig& rig, std::int64_t to) {
        PlainData arguments;
        arguments.values.emplace_back(to);
        REQUIRE(rig.component->call_command("give", arguments, rig.now));
    };
    const std::string text = "param('x', 1)\ncommand('give', function(v) config.x = v end)\n";
    ScriptRig inactive(text);
    set(inactive, 44);
    CHECK(value(inactive) == Value(std::int64_t{1}));
    inactive.component->latch_inputs(inactive.now);
    CHECK(value(inactive) == Value(std::int64_t{44}));

    ScriptRig broken(text + "function on_execute() error('x') end function on_aborting() config.x = 5 end\n");
    broken.activate().tick();
    CHECK(broken.status() == "ERROR");
    broken.component->latch_inputs(broken.now);
    CHECK(value(broken) == Value(std::int64_t{5}));
}

TEST_CASE("a file that names a parameter it does not declare is refused, also in code that never runs",
          "[lua][parameters]") {
    const std::string head = "param('speed_x', 0.0)\nfunction on_execute() if now() > 1e9 then ";
    const std::string says = "robot_controller.lua:2:56: config: unknown parameter 'sped_x' (did you mean 'speed_x'?)";
    CHECK(refusal(head + "print(config.sped_x) end end") == says);
    CHECK(refusal(head + "      config.sped_x = 1 end end") == says);
    CHECK(refusal(head + "print(config.speed_x) end end").empty());
    CHECK(refusal(head + "local config = {} print(config.sped_x) end end").empty());
    INFO("what is declared in any way is known");
    CHECK(refusal("for i = 1, 2 do param('p' .. i, i) end function on_execute() print(config.p2) end").empty());
}

TEST_CASE("an unknown parameter is an error with the nearest name, read or set", "[lua][parameters]") {
    const std::string head = "param('speed_x', 0.0)";
    CHECK(failure_of(head, "return config['sped' .. '_x']") ==
          "robot_controller.lua:3: unknown parameter 'sped_x' (did you mean 'speed_x'?)");
    CHECK(failure_of(head, "config['sped' .. '_x'] = 1") ==
          "robot_controller.lua:3: unknown parameter 'sped_x' (did you mean 'speed_x'?)");
    CHECK(failure_of(head, "return config[1]") == "robot_controller.lua:3: unknown parameter '1'");
    CHECK(failure_of(head, "config.speed_x = {}") ==
          "robot_controller.lua:3: parameter 'speed_x' (number): expected number, got array of numbers {}");
    CHECK(failure_of(head, "config.speed_x = print") ==
          "robot_controller.lua:3: parameter 'speed_x': expected a boolean, a number, a string or an array of them, "
          "got function");
    CHECK(failure_of(head, "config.speed_x = 0/0") ==
          "robot_controller.lua:3: parameter 'speed_x' (number): nan is not a finite number");
}

TEST_CASE("an array is read-only and replaced whole", "[lua][parameters]") {
    const std::string head = "param('gains', { 1.0, 0.5 }, { min = 0, max = 2, min_size = 1, max_size = 3 })";
    CHECK(failure_of(head, "config.gains[1] = 3") ==
          "robot_controller.lua:3: can't set 'config.gains[1]': 'config.gains' is read-only");
    CHECK(failure_of(
              head, "assert(not pcall(rawset, config.gains, 1, 3)) assert(not pcall(table.insert, config.gains, 3))") ==
          "");
    CHECK(failure_of(head,
                     "local n = 0 for i, v in ipairs(config.gains) do n = n + v end for _, v in pairs(config.gains) do "
                     "n = n + v end "
                     "assert(n == 3 and #config.gains == 2 and select('#', table.unpack(config.gains)) == 2)") == "");
    CHECK(failure_of(head, "config.gains = { 1, 2, 0 }") == "");
    CHECK(failure_of(head, "config.gains = { 3.0 }") ==
          "robot_controller.lua:3: parameter 'gains' (array of numbers): element 1: 3.0 is above its maximum 2.0");
    CHECK(failure_of(head, "config.gains = {}") ==
          "robot_controller.lua:3: parameter 'gains' (array of numbers): 0 elements are fewer than its min_size 1");
    CHECK(failure_of(head, "config.gains = { 1, 1, 1, 1 }") ==
          "robot_controller.lua:3: parameter 'gains' (array of numbers): 4 elements are more than its max_size 3");
    CHECK(failure_of(head, "config.gains = { 1, 'a' }") ==
          "robot_controller.lua:3: parameter 'gains': element 2 expected a number, as the first one, got string");
}

TEST_CASE("an array of parameters can be written to a port and given to another parameter", "[lua][parameters]") {
    ScriptRig rig(
        "param('a', { 1.0, 0.5 }) param('b', { 0.0 })\nlocal out = output('out', 'TimedDoubleSeq')\n"
        "function on_execute() out:write(config.a) config.b = config.a end");
    rig.activate().tick(2);
    CHECK(rig.error() == "");
    CHECK(rig.out<std::vector<double>>("out").read() == std::vector<double>{1.0, 0.5});
    CHECK(rig.component->parameters().find("b")->value == Value(std::vector<double>{1.0, 0.5}));
}

TEST_CASE("config can be walked through, and not tampered with", "[lua][parameters]") {
    const std::string head = "param('b', 2) param('a', 1)";
    CHECK(failure_of(head, "local s = '' for k, v in pairs(config) do s = s .. k .. v end assert(s == 'a1b2', s)") ==
          "");
    CHECK(failure_of(head,
                     "assert(getmetatable(config) == false and not pcall(rawset, config, 'a', 5) and not "
                     "pcall(setmetatable, config, {}))") == "");
    CHECK(failure_of(
              head, "local function find() for k, v in pairs(config) do return config end end assert(find().a == 1)") ==
          "");
}

TEST_CASE("a declaration that is wrong is refused", "[lua][parameters]") {
    const std::string at = "robot_controller.lua:1: ";
    CHECK(refusal("param('x', nil)") ==
          at + "parameter 'x': its default expected a boolean, a number, a string or an array of them, got nil");
    CHECK(refusal("param('x')") ==
          at + "parameter 'x': its default expected a boolean, a number, a string or an array of them, got nil");
    CHECK(refusal("param('x', {1, 'a'})") ==
          at + "parameter 'x': its default element 2 expected a number, as the first one, got string");
    CHECK(refusal("param('x', { a = 1 })") ==
          at + "parameter 'x': its default expected an array (elements 1, 2, ...), got a table with the key 'a'");
    CHECK(refusal("param('x', print)") ==
          at + "parameter 'x': its default expected a boolean, a number, a string or an array of them, got function");
    CHECK(refusal("param('x', 0/0)") == at + "parameter 'x' (number): nan is not a finite number, in its default");
    CHECK(refusal("param('x', 1, { min = 2, max = 1 })") == at + "parameter 'x' (integer): min 2.0 is above max 1.0");
    CHECK(refusal("param('x', 5, { max = 1 })") ==
          at + "parameter 'x' (integer): 5 is above its maximum 1, in its default");
    CHECK(refusal("param('x', 5, { min = math.huge })") ==
          at + "parameter 'x': option 'min' expected a finite number, got inf");
    CHECK(refusal("param('x', 5, { maxx = 1 })") == at + "parameter 'x': unknown option 'maxx' (did you mean 'max'?)");
    CHECK(refusal("param('x', 5, { max = '1' })") == at + "parameter 'x': option 'max' expected a number, got string");
    CHECK(refusal("param('x', 'a', { max = 1 })") ==
          at + "parameter 'x': option 'max' is for numbers, and the parameter is of type string");
    CHECK(refusal("param('x', 1, { min_size = 1 })") ==
          at + "parameter 'x': option 'min_size' is for arrays, and the parameter is of type integer");
    CHECK(refusal("param('x', 5, { max = 1e12 })").empty());
    CHECK(refusal("param('x', 5, { step = 0 })") ==
          at + "parameter 'x': option 'step' expected a positive number, got 0");
    CHECK(refusal("param('x', 5, { widget = 'slidr' })") ==
          at + "parameter 'x': option 'widget' expected one of slider, spin, radio, checkbox, ordered_list, text, got "
               "'slidr' (did you mean 'slider'?)");
    CHECK(refusal("param('x', 5, { widget = 'slider' })") ==
          at + "parameter 'x' (integer): the widget 'slider' is for numbers with min and max");
    CHECK(refusal("param('x', 5, 'a text')") == at + "parameter 'x': options expected a table, got string");
    CHECK(refusal("param('x', 'a', { choices = { 'left', 'right' } })") ==
          at + "parameter 'x' (string): \"a\" is none of its choices \"left\", \"right\", in its default");
    CHECK(refusal("param('x', 1, { choices = { 1, 'c' } })") ==
          at + "parameter 'x' (integer): expected integer, got string \"c\", in its choices");
    CHECK(refusal("param('x', 1, { choices = {} })") ==
          at + "parameter 'x': option 'choices' is empty: nothing could be chosen");
    CHECK(refusal("param('x', 1, { choices = 3 })") ==
          at + "parameter 'x': option 'choices' expected an array, got number");
    CHECK(refusal("param(1, 1)") == at + "param: its name expected a string, got number");
    CHECK(refusal("param('x', 1)\nparam('x', 2)") ==
          "robot_controller.lua:2: parameter 'x' is declared twice (first in line 1)");
}

TEST_CASE("choices bind whoever sets the value", "[lua][parameters]") {
    const std::string head = "param('mode', 'slow', { choices = { 'slow', 'fast' } })";
    CHECK(failure_of(head, "config.mode = 'fast'") == "");
    CHECK(failure_of(head, "config.mode = 'fsat'") ==
          "robot_controller.lua:3: parameter 'mode' (string): \"fsat\" is none of its choices \"slow\", \"fast\" (did "
          "you mean 'fast'?)");
}

TEST_CASE("the top level of a file reads the values that the system file gave, and sets none", "[lua][parameters]") {
    ScriptRig rig(
        "param('n', 1)\nlocal n = config.n\nlocal out = output('out', 'TimedLong')\nfunction on_activated() "
        "out:write(n) end",
        {.configured = {{"n", std::int64_t{7}}}});
    rig.activate().tick();
    CHECK(rig.out<std::int32_t>("out").read() == 7);
    CHECK(refusal("param('n', 1)\nconfig.n = 2") ==
          "robot_controller.lua:2: config.n can't be set while the file loads");
}
