// Payloads and parameters cross between C++ and Lua whole, or the message says which part does not fit.
#include "bindings/lua/values/codec.hpp"

#include <catch2/catch.hpp>
#include <memory>

using namespace nezumi;

namespace {

struct Lua {
    std::unique_ptr<lua_State, decltype(&lua_close)> state{luaL_newstate(), lua_close};
    operator lua_State*() const { return state.get(); }

    // Leaves the value of an expression on the stack.
    int value(const std::string& expression) const {
        luaL_openlibs(state.get());
        REQUIRE(luaL_dostring(state.get(), ("return " + expression).c_str()) == LUA_OK);
        return lua_gettop(state.get());
    }
};

// The payload that an expression gives, or the text of the mismatch.
template <class T>
Expected<T> read(const std::string& expression) {
    const Lua lua;
    auto payload = read_payload(lua, lua.value(expression), message_of<T>());
    CHECK(lua_gettop(lua) == 1);  // reading leaves the stack as it was
    if (!payload) return Unexpected(payload.error());
    return payload->template get<T>();
}

template <class T>
std::string mismatch(const std::string& expression) {
    const auto payload = read<T>(expression);
    return payload ? "it fits" : payload.error().message;
}

template <class T>
void check_round_trip(const T& value) {
    const Lua lua;
    push_payload(lua, Value(value));
    const auto back = read_payload(lua, 1, message_of<T>());
    REQUIRE(back.has_value());
    CHECK((back->template get<T>() == value));
}

Expected<Value> parameter(const std::string& expression) {
    const Lua lua;
    return read_parameter(lua, lua.value(expression));
}

}  // namespace

TEST_CASE("every message type crosses to Lua and back", "[lua][codec]") {
    check_round_trip(true);
    check_round_trip<std::int16_t>(-32768);
    check_round_trip<std::int32_t>(2147483647);
    check_round_trip(0.1F);
    check_round_trip(0.1);
    check_round_trip(std::string("a\0b", 3));
    check_round_trip(std::vector<bool>{true, false, true});
    check_round_trip(std::vector<std::int16_t>{1, 2, 3, 4});
    check_round_trip(std::vector<std::int32_t>{});
    check_round_trip(std::vector<float>{0.5F});
    check_round_trip(std::vector<double>{0.1, -1e300});
    check_round_trip(std::vector<std::string>{"", "x"});
    check_round_trip(Velocity2D{0.1, 0.2, 0.3});
    check_round_trip(Pose2D{{1, 2}, 3});
    check_round_trip(Pose3D{{1, 2, 3}, {4, 5, 6}});
    check_round_trip(
        RangeData{{0.5, 1.5}, {{{1, 2, 3}, {4, 5, 6}}, {7, 8, 9}, {{}, {{{1, 1, 1}, {}}, {}}}}, {.maxAngle = 3}});
    check_round_trip(CameraImage{2, 1, 8, "gray8", 1.0, {0, 255}});
}

TEST_CASE("ranges may be infinite or no number, and no other field", "[lua][codec]") {
    const auto ranges = read<RangeData>("{ ranges = { math.huge, -math.huge, 0/0, 0.5 } }").value().ranges;
    REQUIRE(ranges.size() == 4);
    CHECK(ranges[0] == INFINITY);
    CHECK(ranges[1] == -INFINITY);
    CHECK(std::isnan(ranges[2]));
    CHECK(mismatch<RangeData>("{ config = { maxRange = math.huge } }") ==
          "field 'config.maxRange' expected a finite number, got inf");
    CHECK(mismatch<std::vector<double>>("{ 1, 0/0 }") == "element 2 expected a finite number, got nan");
}

TEST_CASE("a single-valued type is the plain Lua value", "[lua][codec]") {
    const Lua lua;
    push_payload(lua, std::int16_t{7});
    CHECK(lua_isinteger(lua, -1));
    push_payload(lua, 7.0);
    CHECK_FALSE(lua_isinteger(lua, -1));
    push_payload(lua, true);
    CHECK(lua_isboolean(lua, -1));
    push_payload(lua, std::string("text"));
    CHECK(lua_type(lua, -1) == LUA_TSTRING);
}

TEST_CASE("a structure is a table of its fields and a sequence starts at 1", "[lua][codec]") {
    const Lua lua;
    push_payload(lua, Pose2D{{1, 2}, 3});
    lua_setglobal(lua, "pose");
    push_payload(lua, std::vector<std::int16_t>{10, 20});
    lua_setglobal(lua, "values");
    push_payload(lua, CameraImage{.pixels = {65, 66}});
    lua_setglobal(lua, "image");
    luaL_openlibs(lua);
    CHECK(luaL_dostring(lua,
                        "assert(pose.position.x == 1 and pose.position.y == 2 and pose.heading == 3)"
                        "assert(values[1] == 10 and values[2] == 20 and #values == 2)"
                        "assert(image.pixels == 'AB' and getmetatable(image) == nil)") == LUA_OK);
}

TEST_CASE("a field left out is 0", "[lua][codec]") {
    CHECK(read<Velocity2D>("{ va = 2 }").value() == Velocity2D{.va = 2});
    CHECK(read<Velocity2D>("{}").value() == Velocity2D{});
    CHECK(read<Pose2D>("{ position = { y = 1 } }").value() == Pose2D{.position = {0, 1}});
}

TEST_CASE("an unknown field is an error with the nearest, or with all there are", "[lua][codec]") {
    CHECK(mismatch<Velocity2D>("{ vz = 1 }") == "unknown field 'vz' (did you mean 'vx'?)");
    CHECK(mismatch<Velocity2D>("{ speed = 1 }") == "unknown field 'speed' (its fields are vx, vy, va)");
    CHECK(mismatch<Velocity2D>("{ 0.1, 0.2 }") == "unknown field '[1]' (its fields are vx, vy, va)");
    CHECK(mismatch<Velocity2D>("{ [print] = 1 }") == "unknown field '[function]' (its fields are vx, vy, va)");
    CHECK(mismatch<Pose2D>("{ position = { xx = 1 } }") == "unknown field 'position.xx' (did you mean 'x'?)");
}

TEST_CASE("a field of the wrong type is named with what was expected and found", "[lua][codec]") {
    CHECK(mismatch<Velocity2D>("{ vx = '1' }") == "field 'vx' expected a number, got string");
    CHECK(mismatch<Velocity2D>("{ vx = true }") == "field 'vx' expected a number, got boolean");
    CHECK(mismatch<Pose2D>("{ position = { x = {} } }") == "field 'position.x' expected a number, got table");
    CHECK(mismatch<Pose2D>("{ position = 1 }") == "field 'position' expected a table, got number");
    CHECK(mismatch<RangeData>("{ ranges = { 1, 2, 'x' } }") == "field 'ranges[3]' expected a number, got string");
    CHECK(mismatch<RangeData>("{ geometry = { elements = { {}, { pose = { position = { x = 'a' } } } } } }") ==
          "field 'geometry.elements[2].pose.position.x' expected a number, got string");
    CHECK(mismatch<CameraImage>("{ pixels = { 1, 2 } }") == "field 'pixels' expected a string, got table");
    CHECK(mismatch<std::vector<std::int16_t>>("{ 1, 2, 'x' }") == "element 3 expected an integer, got string");
    CHECK(mismatch<std::vector<bool>>("{ 1 }") == "element 1 expected a boolean, got number");
    CHECK(mismatch<Velocity2D>("nil") == "expected a table, got nil");
    CHECK(mismatch<std::vector<double>>("3") == "expected an array, got number");
    CHECK(mismatch<bool>("1") == "expected a boolean, got number");
    CHECK(mismatch<std::string>("12") == "expected a string, got number");
    CHECK(mismatch<double>("'0x10'") == "expected a number, got string");
}

TEST_CASE("of several faults the first in the order of the description is named", "[lua][codec]") {
    for (int i = 0; i < 20; ++i) {
        CHECK(mismatch<Velocity2D>("{ va = 'x', vy = 'x', bb = 1, aa = 1 }") ==
              "field 'vy' expected a number, got string");
        CHECK(mismatch<Velocity2D>("{ bb = 1, cc = 1, aa = 1, [true] = 1 }").substr(0, 22) == "unknown field '[true]'");
    }
}

TEST_CASE("a float fits an integer only when it is whole and in range", "[lua][codec]") {
    CHECK(read<std::int16_t>("3.0").value() == 3);
    CHECK(mismatch<std::int16_t>("3.5") == "expected an integer, got 3.5");
    CHECK(mismatch<std::int16_t>("40000") == "expected an integer from -32768 to 32767, got 40000");
    CHECK(mismatch<std::int16_t>("40000.0") == "expected an integer from -32768 to 32767, got 40000");
    CHECK(mismatch<std::int16_t>("-32769") == "expected an integer from -32768 to 32767, got -32769");
    CHECK(mismatch<std::int32_t>("1e30") == "expected an integer from -2147483648 to 2147483647, got 1e+30");
    CHECK(mismatch<std::int32_t>("0/0") == "expected an integer, got nan");
    CHECK(mismatch<std::int32_t>("math.huge") == "expected an integer, got inf");
    CHECK(mismatch<CameraImage>("{ width = -1 }") == "field 'width' expected an integer from 0 to 65535, got -1");
}

TEST_CASE("a number is finite, and within the range of its type", "[lua][codec]") {
    CHECK(mismatch<double>("0/0") == "expected a finite number, got nan");
    CHECK(mismatch<double>("-math.huge") == "expected a finite number, got -inf");
    CHECK(mismatch<Velocity2D>("{ vx = math.huge }") == "field 'vx' expected a finite number, got inf");
    CHECK(mismatch<float>("1e300") ==
          "expected a number from -3.4028234663852886e+38 to 3.4028234663852886e+38, got 1e+300");
    CHECK(mismatch<std::vector<float>>("{ 1, 0/0 }") == "element 2 expected a finite number, got nan");
    CHECK(read<double>("1").value() == 1.0);
}

TEST_CASE("a sequence has the elements 1 to n and nothing else", "[lua][codec]") {
    using Shorts = std::vector<std::int16_t>;
    CHECK(read<Shorts>("{ [3] = 3, [1] = 1, [2] = 2 }").value() == Shorts{1, 2, 3});
    CHECK(read<Shorts>("{}").value().empty());
    CHECK(mismatch<Shorts>("{ 1, nil, 3 }") == "expected an array without holes, got no element 2 before element 3");
    CHECK(mismatch<Shorts>("{ [0] = 1, 2 }") ==
          "expected an array (elements 1, 2, ...), got a table with the key '[0]'");
    CHECK(mismatch<Shorts>("{ 1, x = 2 }") == "expected an array (elements 1, 2, ...), got a table with the key 'x'");
    CHECK(mismatch<Shorts>("{ 1, [1.5] = 2 }") ==
          "expected an array (elements 1, 2, ...), got a table with the key '[1.5]'");
    CHECK(mismatch<Shorts>("{ [1] = 1, [1 << 60] = 2 }") ==
          "expected an array without holes, got no element 2 before element 1152921504606846976");
    CHECK(mismatch<Shorts>("(function() local t = {} for i = 0, 62 do t[1 << i] = 1 end return t end)()") ==
          "expected an array without holes, got no element 3 before element 4611686018427387904");
}

TEST_CASE("no metamethod of a value runs", "[lua][codec]") {
    CHECK(read<Velocity2D>("setmetatable({}, { __index = function() error('ran') end })").value() == Velocity2D{});
    CHECK(read<Velocity2D>("setmetatable({ vx = 1 }, { __index = { va = 1 }, __pairs = error })").value() ==
          Velocity2D{.vx = 1});
    CHECK(read<std::vector<double>>("setmetatable({ 1 }, { __len = function() return 1 << 60 end })").value() ==
          std::vector<double>{1});
}

TEST_CASE("a table that contains itself does not fit", "[lua][codec]") {
    CHECK(mismatch<Pose2D>("(function() local t = {} t.position = t return t end)()") ==
          "unknown field 'position.position' (its fields are x, y)");
    CHECK(mismatch<std::vector<double>>("(function() local t = {} t[1] = t return t end)()") ==
          "element 1 expected a number, got table");
}

TEST_CASE("a parameter's value is read as what it is in Lua", "[lua][codec]") {
    CHECK(parameter("true").value() == Value(true));
    CHECK(parameter("30").value() == Value(std::int64_t{30}));
    CHECK(parameter("30.0").value() == Value(30.0));
    CHECK(parameter("'30'").value() == Value(std::string("30")));
    CHECK(parameter("{ true }").value() == Value(std::vector<bool>{true}));
    CHECK(parameter("{ 1, 2 }").value() == Value(std::vector<std::int64_t>{1, 2}));
    CHECK(parameter("{ 1, 0.5 }").value() == Value(std::vector<double>{1, 0.5}));
    CHECK(parameter("{ 'a' }").value() == Value(std::vector<std::string>{"a"}));
    CHECK(parameter("{}").value() == Value(std::vector<double>{}));
}

TEST_CASE("a value that can't be a parameter is refused with the reason", "[lua][codec]") {
    CHECK(parameter("nil").error().message == "expected a boolean, a number, a string or an array of them, got nil");
    CHECK(parameter("print").error().message ==
          "expected a boolean, a number, a string or an array of them, got function");
    CHECK(parameter("{ 1, 'a' }").error().message == "element 2 expected a number, as the first one, got string");
    CHECK(parameter("{ {} }").error().message == "element 1 expected a boolean, a number or a string, got table");
    CHECK(parameter("{ x = 1 }").error().message ==
          "expected an array (elements 1, 2, ...), got a table with the key 'x'");
    CHECK(parameter("{ 1, nil, 2 }").error().message ==
          "expected an array without holes, got no element 2 before element 3");
}

TEST_CASE("a parameter's value is pushed as the script's own", "[lua][codec]") {
    const Lua lua;
    push_payload(lua, std::vector<double>{1.0, 0.5});
    CHECK(lua_rawlen(lua, -1) == 2);
    push_payload(lua, std::int64_t{3});
    CHECK(lua_isinteger(lua, -1));
}
