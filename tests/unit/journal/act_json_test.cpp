// An act comes back from its JSON as it was.
#include "bindings/journal/act_json.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bindings/journal/base64.hpp"
#include "bindings/lua/reload/lua_host.hpp"

using namespace nezumi;

namespace {

const PartReader parts{Project::of("system.lua"), &lua_scripts()};

template <class T>
T back(const T& act) {
    const auto json = nlohmann::ordered_json::parse(to_json(act, lua_scripts()).dump());
    auto read = act_from_json(Describe<T>::name, json, parts);
    if (!read) FAIL(describe(read.error()));
    return std::get<T>(*read);
}

Value back(const Value& value) { return back(SetParameter{"c", "p", value}).value; }

}  // namespace

TEST_CASE("parameters come back with their types", "[journal]") {
    for (const Value& value : {Value(true), Value(std::int64_t{-7}), Value(3.0), Value(0.1), Value(1e300),
                               Value(INFINITY), Value(std::string("a\"\n\xff")), Value(std::vector<bool>{true, false}),
                               Value(std::vector<std::int64_t>{}), Value(std::vector<double>{}),
                               Value(std::vector<double>{1.0, 0.5}), Value(std::vector<std::string>{"", "x"})}) {
        CHECK(back(value) == value);
    }
}

TEST_CASE("messages of every type are unchanged after JSON encoding and decoding", "[journal]") {
    const auto check = [](const Value& value) { CHECK(back(Hold{"a.b", value, true}).value == value); };
    for (const MessageType& message : compiled_message_types()) check(Value(*message.payload));
    check(Velocity2D{.vx = 0.1, .va = -2});
    check(std::vector<float>{0.1F, 1e-30F});
    check(CameraImage{.width = 1, .height = 1, .bpp = 8, .format = "gray8", .pixels = {0xff, 0x00}});
    check(RangeData{.ranges = {1, 2}, .geometry = {.elements = {{}, {.pose = {{1, 2, 3}, {}}}}}});
}

TEST_CASE("plain data comes back with its shape", "[journal]") {
    PlainData data;
    data.values = {{}, true, std::int64_t{1}, 1.0, std::string("\x80"), -INFINITY, TableRef{1}};
    data.tables = {{{std::string("self"), TableRef{0}}}, {{2.5, false}}};
    CHECK(back(Command{"c", "f", data}).arguments == data);
}

TEST_CASE("a disturbance keeps the components of the velocity that it does not set", "[journal]") {
    Disturb disturbance{"mouse"};
    disturbance.va = 0.5;
    const Disturb same = back(disturbance);
    CHECK_FALSE(same.vx);
    CHECK(same.va == 0.5);
}

TEST_CASE("base64 is that of RFC 4648", "[journal]") {
    for (const auto& [bytes, text] :
         {std::pair{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}}) {
        CHECK(to_base64(bytes) == text);
        CHECK(from_base64(text) == bytes);
    }
    CHECK_FALSE(from_base64("Zg="));
    CHECK_FALSE(from_base64("Z!=="));
}

TEST_CASE("an added entry is read back as it was written, without its system", "[journal]") {
    ComponentEntry eye{.name = "eye", .type = "Camera", .on = "second", .place = {"system.lua", 0}};
    eye.rate = 150;  // above the usual tick's
    const Entry same = back(Add{eye}).entry;
    REQUIRE(std::holds_alternative<ComponentEntry>(same));
    CHECK(std::get<ComponentEntry>(same).on == "second");
    CHECK(std::get<ComponentEntry>(same).rate == 150);
    CHECK(name_of(same) == "eye");
}

TEST_CASE("a marker that is hung up comes back", "[journal]") {
    const MarkerSpec marker{
        .name = "target", .id = 5, .size = 0.125, .at = {1, -2, 0.1}, .facing = -0.3, .place = {"system.lua", 0}};
    const MarkerSpec same = back(AddMarker{marker}).marker;
    CHECK(same.name == marker.name);
    CHECK(same.id == marker.id);
    CHECK(same.size == marker.size);
    CHECK(same.at == marker.at);
    CHECK(same.facing == marker.facing);
    CHECK(same.place.file == marker.place.file);
    CHECK(back(RemoveMarker{"target"}).marker == "target");
    const auto read = [](const char* text) {
        const auto act = act_from_json("AddMarker", nlohmann::ordered_json::parse(text), parts);
        return act ? "" : act.error().message;
    };
    CHECK_THAT(read(R"({"marker":{}})"), Catch::Contains("expected a marker's lua and file"));
    CHECK_THAT(read(R"({"marker":{"lua":"arena {}","file":"s.lua"}})"), Catch::Contains("expected a marker, got 0"));
}
