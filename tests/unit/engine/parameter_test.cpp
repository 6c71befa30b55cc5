// Parameters: who may set them, when a new value is used, and the messages about refused values.
#include "engine/components/parameter.hpp"
#include "engine/values/value_text.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;
using namespace std::string_literals;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

ParameterSpec spec(std::string name, Value initial, std::optional<double> min = {}, std::optional<double> max = {}) {
    ParameterSpec made;
    made.name = std::move(name);
    made.initial = std::move(initial);
    made.min = min;
    made.max = max;
    return made;
}

// Why this value may not be, or "" when it may.
std::string refusal(const ParameterSpec& declared, const Value& value) {
    const auto allowed = check_value(declared, value);
    return allowed ? "" : allowed.error().message;
}

Parameters two() {
    Parameters all;
    REQUIRE(all.declare(spec("speed_x", 0.0, -1.5, 1.5)));
    REQUIRE(all.declare(spec("stop_d", std::int64_t{30})));
    return all;
}

Value value_of(const Parameters& all, std::string_view name) { return all.find(name)->value; }

}  // namespace

TEST_CASE("bounds are inclusive", "[engine][parameter]") {
    const ParameterSpec speed = spec("speed_x", 0.0, -1.5, 1.5);
    CHECK(refusal(speed, 1.5).empty());
    CHECK(refusal(speed, -1.5).empty());
    CHECK(refusal(speed, 2.0) == "parameter 'speed_x' (number): 2.0 is above its maximum 1.5");
    CHECK(refusal(speed, -1.51) == "parameter 'speed_x' (number): -1.51 is below its minimum -1.5");
    const ParameterSpec count = spec("n", std::int64_t{3}, 1, 5);
    CHECK(refusal(count, std::int64_t{5}).empty());
    CHECK(refusal(count, std::int64_t{6}) == "parameter 'n' (integer): 6 is above its maximum 5");
}

TEST_CASE("a number is finite", "[engine][parameter]") {
    const ParameterSpec free = spec("x", 0.0);
    CHECK(refusal(free, nan_value) == "parameter 'x' (number): nan is not a finite number");
    CHECK(refusal(free, std::numeric_limits<double>::infinity()) ==
          "parameter 'x' (number): inf is not a finite number");
    CHECK(refusal(spec("xs", std::vector<double>{}), std::vector<double>{1, nan_value}) ==
          "parameter 'xs' (array of numbers): element 2: nan is not a finite number");
}

TEST_CASE("the type follows the default, and numbers convert where nothing is lost", "[engine][parameter]") {
    CHECK(check_value(spec("x", 0.0), std::int64_t{3}) == Value(3.0));
    CHECK(check_value(spec("n", std::int64_t{0}), 3.0) == Value(std::int64_t{3}));
    CHECK(refusal(spec("n", std::int64_t{0}), 3.5) == "parameter 'n' (integer): expected integer, got number 3.5");
    CHECK(refusal(spec("n", std::int64_t{0}), 1e300).find("expected integer") != std::string::npos);
    CHECK(refusal(spec("n", std::int64_t{0}), nan_value) ==
          "parameter 'n' (integer): expected integer, got number nan");
    CHECK(refusal(spec("b", true), std::int64_t{1}) == "parameter 'b' (boolean): expected boolean, got integer 1");
    CHECK(refusal(spec("t", "a"s), 1.0) == "parameter 't' (string): expected string, got number 1.0");
    CHECK(refusal(spec("x", 0.0), "fast"s) == "parameter 'x' (number): expected number, got string \"fast\"");
    CHECK(refusal(spec("x", 0.0), true) == "parameter 'x' (number): expected number, got boolean true");
    CHECK(check_value(spec("xs", std::vector<double>{1}), std::vector<std::int64_t>{1, 2}) ==
          Value(std::vector<double>{1, 2}));
    CHECK(check_value(spec("ns", std::vector<std::int64_t>{1}), std::vector<double>{1, 2}) ==
          Value(std::vector<std::int64_t>{1, 2}));
    CHECK(refusal(spec("ns", std::vector<std::int64_t>{1}), std::vector<double>{1.5}) ==
          "parameter 'ns' (array of integers): expected array of integers, got array of numbers { 1.5 }");
    CHECK(refusal(spec("xs", std::vector<double>{1}), 1.0).find("expected array of numbers, got number 1.0") !=
          std::string::npos);
}

TEST_CASE("an array has bounds for each element and for its size", "[engine][parameter]") {
    ParameterSpec gains = spec("gains", std::vector<double>{1.0, 0.5}, 0, 2);
    gains.min_size = 1;
    gains.max_size = 3;
    CHECK(refusal(gains, std::vector<double>{0, 2, 1}).empty());
    CHECK(refusal(gains, std::vector<double>{0, 2.5}) ==
          "parameter 'gains' (array of numbers): element 2: 2.5 is above its maximum 2.0");
    CHECK(refusal(gains, std::vector<double>{}) ==
          "parameter 'gains' (array of numbers): 0 elements are fewer than its min_size 1");
    CHECK(refusal(gains, std::vector<double>{1, 1, 1, 1}) ==
          "parameter 'gains' (array of numbers): 4 elements are more than its max_size 3");
    // An empty table of Lua is an empty array of whatever is wanted.
    CHECK(check_value(spec("names", std::vector<std::string>{"a"}), std::vector<bool>{}) ==
          Value(std::vector<std::string>{}));
}

TEST_CASE("a value outside the choices is refused with the nearest choice", "[engine][parameter]") {
    ParameterSpec mode = spec("mode", "careful"s);
    mode.choices = {"careful"s, "fast"s};
    CHECK(refusal(mode, "fast"s).empty());
    CHECK(refusal(mode, "fsat"s) ==
          "parameter 'mode' (string): \"fsat\" is not one of its choices \"careful\", \"fast\" (did you mean "
          "'fast'?)");
    ParameterSpec baud = spec("rate", std::int64_t{10});
    baud.choices = {std::int64_t{10}, std::int64_t{20}};
    CHECK(refusal(baud, 20.0).empty());
    CHECK(refusal(baud, std::int64_t{15}) == "parameter 'rate' (integer): 15 is not one of its choices 10, 20");
}

TEST_CASE("an impossible declaration is refused with its location", "[engine][parameter]") {
    const auto refused = [](ParameterSpec declared) {
        declared.place = {"a.lua", 4};
        Parameters all;
        const auto ok = all.declare(declared);
        return ok ? "" : describe(ok.error());
    };
    CHECK(refused(spec("x", 2.0, -1, 1)) ==
          "a.lua:4: parameter 'x' (number): 2.0 is above its maximum 1.0, in its default");
    CHECK(refused(spec("x", 0.0, 2, 1)) == "a.lua:4: parameter 'x' (number): min 2.0 is above max 1.0");
    CHECK(refused(spec("x", 0.0, nan_value)) == "a.lua:4: parameter 'x' (number): min and max must be finite");
    ParameterSpec odd = spec("x", 0.0);
    odd.step = -1;
    CHECK(refused(odd) == "a.lua:4: parameter 'x' (number): step must be a positive number");
    ParameterSpec sizes = spec("x", std::vector<double>{});
    sizes.min_size = 3;
    sizes.max_size = 2;
    CHECK(refused(sizes) == "a.lua:4: parameter 'x' (array of numbers): min_size 3 is above max_size 2");
    ParameterSpec mixed = spec("x", 0.0);
    mixed.choices = {0.0, "a"s};
    CHECK(refused(mixed) == "a.lua:4: parameter 'x' (number): expected number, got string \"a\", in its choices");
    Parameters all = two();
    CHECK(all.declare(spec("stop_d", 1.0)).error().message == "parameter 'stop_d' is declared twice");
}

TEST_CASE("a widget is one of the six, and fits its parameter", "[engine][parameter]") {
    const auto refused = [](ParameterSpec declared, const std::string& widget) {
        declared.widget = widget;
        Parameters all;
        const auto ok = all.declare(std::move(declared));
        return ok ? "" : ok.error().message;
    };
    const ParameterSpec number = spec("x", 0.0), bounded = spec("x", 0.0, -1, 1), flag = spec("x", false);
    ParameterSpec word = spec("x", "a"s), list = spec("x", std::vector<std::string>{"a", "b"});
    CHECK(refused(number, "slidr") ==
          "parameter 'x' (number): there is no widget 'slidr' (did you mean 'slider'?): expected one of slider, spin, "
          "radio, checkbox, ordered_list, text");
    CHECK(refused(bounded, "slider").empty());
    CHECK(refused(number, "slider") == "parameter 'x' (number): the widget 'slider' is for numbers with min and max");
    CHECK(refused(number, "spin").empty());
    CHECK(refused(word, "spin") == "parameter 'x' (string): the widget 'spin' is for numbers");
    CHECK(refused(word, "radio") == "parameter 'x' (string): the widget 'radio' is for one value with choices");
    CHECK(refused(flag, "checkbox").empty());
    CHECK(refused(list, "ordered_list") ==
          "parameter 'x' (array of strings): the widget 'ordered_list' is for an array with choices of its elements");
    word.choices = list.choices = {"a"s, "b"s, "c"s};
    CHECK(refused(word, "radio").empty());
    CHECK(refused(list, "checkbox").empty());
    CHECK(refused(list, "ordered_list").empty());
    CHECK(refused(list, "text").empty());
}

TEST_CASE("choices of an array may be those of its elements", "[engine][parameter]") {
    ParameterSpec order = spec("order", std::vector<std::string>{"a", "b"});
    order.choices = {"a"s, "b"s, "c"s};
    CHECK(refusal(order, std::vector<std::string>{"c", "a"}).empty());
    CHECK(refusal(order, std::vector<std::string>{}).empty());
    CHECK(refusal(order, std::vector<std::string>{"a", "d"}) ==
          "parameter 'order' (array of strings): \"d\" is not one of its choices \"a\", \"b\", \"c\"");
    ParameterSpec gains = spec("gains", std::vector<double>{1.0});
    gains.choices = {std::int64_t{1}, 2.5};
    Parameters all;
    REQUIRE(all.declare(gains));
    CHECK(all.set("gains", std::vector<double>{2.5, 1.0}));
    CHECK(all.set("gains", std::vector<double>{2.0}).error().message ==
          "parameter 'gains' (array of numbers): 2.0 is not one of its choices 1.0, 2.5");
}

TEST_CASE("step binds widgets only", "[engine][parameter]") {
    ParameterSpec speed = spec("x", 0.0, -1.5, 1.5);
    speed.step = 0.01;
    CHECK(refusal(speed, 0.0123).empty());
}

TEST_CASE("an unknown parameter is refused, the error suggests the nearest name, and nothing changes",
          "[engine][parameter]") {
    Parameters all = two();
    const std::uint64_t version = all.version();
    CHECK(all.set("speed_y", 1.0).error().message == "unknown parameter 'speed_y' (did you mean 'speed_x'?)");
    CHECK(all.set("volume", 1.0).error().message == "unknown parameter 'volume'");
    CHECK_FALSE(all.set("speed_x", 2.0));
    CHECK(value_of(all, "speed_x") == Value(0.0));
    CHECK_FALSE(all.find("speed_x")->set);
    CHECK(all.version() == version);
    REQUIRE(all.set("speed_x", 1.0));
    CHECK(value_of(all, "speed_x") == Value(1.0));
    CHECK(all.find("speed_x")->set);
    CHECK(all.version() != version);
}

TEST_CASE("several values are set whole or not at all", "[engine][parameter]") {
    Parameters all = two();
    CHECK_FALSE(all.set_all({{"speed_x", 1.0}, {"stop_d", "near"s}}));
    CHECK_FALSE(all.take_staged());
    CHECK(value_of(all, "speed_x") == Value(0.0));
    REQUIRE(all.set_all({{"speed_x", 1.0}, {"stop_d", 40.0}}));
    CHECK(value_of(all, "stop_d") == Value(std::int64_t{40}));
}

TEST_CASE("a staged value is checked at once and holds from the next tick", "[engine][parameter]") {
    Parameters all = two();
    CHECK_FALSE(all.stage("speed_x", 2.0));
    REQUIRE(all.stage("speed_x", 1.0));
    REQUIRE(all.stage("speed_x", 0.5));
    CHECK(value_of(all, "speed_x") == Value(0.0));
    CHECK(all.take_staged());
    CHECK(value_of(all, "speed_x") == Value(0.5));
    CHECK_FALSE(all.take_staged());
}

TEST_CASE("a new version keeps values that were set if they fit, and all others get the new default",
          "[engine][parameter]") {
    Parameters before;
    REQUIRE(before.declare(spec("kept", 0.0)));
    REQUIRE(before.declare(spec("narrowed", 0.0)));
    REQUIRE(before.declare(spec("retyped", 0.0)));
    REQUIRE(before.declare(spec("untouched", 0.0)));
    for (const char* name : {"kept", "narrowed", "retyped"}) REQUIRE(before.set(name, 1.0));
    Parameters after;
    REQUIRE(after.declare(spec("kept", 5.0)));
    REQUIRE(after.declare(spec("narrowed", 0.2, 0, 0.5)));
    REQUIRE(after.declare(spec("retyped", "text"s)));
    REQUIRE(after.declare(spec("untouched", 5.0)));
    REQUIRE(after.declare(spec("added", 5.0)));
    after.adopt(before);
    CHECK(value_of(after, "kept") == Value(1.0));
    CHECK(after.find("kept")->set);
    CHECK(value_of(after, "narrowed") == Value(0.2));
    CHECK(value_of(after, "retyped") == Value("text"s));
    CHECK(value_of(after, "untouched") == Value(5.0));
    CHECK(value_of(after, "added") == Value(5.0));
}

TEST_CASE("values are shown as Lua writes them", "[engine][parameter]") {
    CHECK(lua_text(Value(0.25)) == "0.25");
    CHECK(lua_text(Value(2.0)) == "2.0");
    CHECK(lua_text(Value(1e300)) == "1e+300");
    CHECK(lua_text(Value(std::int64_t{30})) == "30");
    CHECK(lua_text(Value(true)) == "true");
    CHECK(lua_text(Value("a\"b\\\n\x01"s)) == R"("a\"b\\\n\x01")");
    CHECK(lua_text(Value(std::vector<double>{1, 0.5})) == "{ 1.0, 0.5 }");
    CHECK(lua_text(Value(std::vector<bool>{true, false})) == "{ true, false }");
    CHECK(lua_text(Value(std::vector<std::int64_t>{})) == "{}");
}

namespace {

class WithSets : public TryComponent {
public:
    WithSets() {
        for (const char* name : {"speed_x", "speed_r"}) REQUIRE(parameters_.declare(spec(name, 0.0, -1.5, 1.5)));
        configured = {{"speed_x", 0.1}};
        REQUIRE(parameters_.set_all(configured));
        sets["careful"] = {{"speed_x", 0.05}, {"speed_r", 0.5}};
        sets["fast"] = {{"speed_x", 0.4}};
        sets["turning"] = {{"speed_r", 1.0}};
        sets["broken"] = {{"speed_r", 1.0}, {"speed_x", 9.0}};
    }
    std::pair<Value, Value> values() const {
        return {value_of(parameters_, "speed_x"), value_of(parameters_, "speed_r")};
    }
};

}  // namespace

TEST_CASE("a named set takes effect whole, and a parameter that is not in it keeps the config value",
          "[engine][parameter][set]") {
    WithSets it;
    REQUIRE(it.use("careful"));
    CHECK(it.values() == std::pair<Value, Value>{0.05, 0.5});
    CHECK(it.set_in_use() == "careful");
    REQUIRE(it.use("turning"));
    CHECK(it.values() == std::pair<Value, Value>{0.1, 1.0});
    REQUIRE(it.use("fast"));
    CHECK(it.values() == std::pair<Value, Value>{0.4, 0.0});  // neither set nor config: the default
    CHECK_FALSE(it.parameters().find("speed_r")->set);        // so that a reload follows its new default
    CHECK(it.parameters().find("speed_x")->set);
}

TEST_CASE("the parameter set default means that no set is in use", "[engine][parameter][set]") {
    WithSets it;
    REQUIRE(it.use("careful"));
    REQUIRE(it.use("default"));
    CHECK(it.set_in_use().empty());
    CHECK(it.values() == std::pair<Value, Value>{0.1, 0.0});
    CHECK_FALSE(it.parameters().find("speed_r")->set);
    CHECK(it.use("defalt").error().message == "it has no parameter set 'defalt' (did you mean 'default'?)");
}

TEST_CASE("a parameter set that is unknown or exceeds a limit changes nothing", "[engine][parameter][set]") {
    WithSets it;
    REQUIRE(it.use("careful"));
    CHECK(it.use("broken").error().message ==
          "set 'broken': parameter 'speed_x' (number): 9.0 is above its maximum 1.5");
    CHECK(it.use("carefull").error().message == "it has no parameter set 'carefull' (did you mean 'careful'?)");
    CHECK(it.values() == std::pair<Value, Value>{0.05, 0.5});
    CHECK(it.set_in_use() == "careful");
}

TEST_CASE("a value that a script sets while it executes holds from its next execution", "[engine][parameter]") {
    WithSets it;
    std::vector<Value> seen;
    it.executed = [&](TryComponent& self) -> Expected<void> {
        seen.push_back(value_of(self.parameters(), "speed_r"));
        return self.parameters().stage("speed_r", 0.7);
    };
    REQUIRE(it.activate({0, 0}));
    for (const Time now : {Time{0, 0}, Time{1, 0.01}}) {
        it.latch_inputs(now);
        it.execute(now);
    }
    CHECK(seen == std::vector<Value>{0.0, 0.7});
}
