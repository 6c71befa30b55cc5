// The tables of types: what they say, and values that are looked at and changed by them.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/ports/payload.hpp"
#include "engine/system/act.hpp"
#include "engine/values/value_text.hpp"

using namespace nezumi;

namespace {

struct Sample {
    bool on = true;
    std::optional<double> limit{};
    std::array<std::int8_t, 3> levels{};
    std::vector<bool> flags{};

    static constexpr FieldList fields{
        Field{"on", &Sample::on, "", "a boolean"},
        Field{"limit", &Sample::limit, "m", ""},
        Field{"levels", &Sample::levels, "", ""},
        Field{"flags", &Sample::flags, "", ""},
    };
};

}  // namespace

TEST_CASE("a type's table has what its description says, in order", "[engine][type]") {
    const Type& type = type_of<Sample>();
    CHECK(&type == &type_of<Sample>());
    CHECK(type.kind == Type::Kind::structure);
    CHECK(type.name == "Sample");
    CHECK(type.size == sizeof(Sample));
    REQUIRE(type.fields.size() == 4);
    CHECK(type.fields[0].name == "on");
    CHECK(type.fields[0].doc == "a boolean");
    CHECK(type.fields[0].type == &type_of<bool>());
    CHECK(type.fields[1].unit == "m");
    CHECK(type.fields[1].type->kind == Type::Kind::optional);
    CHECK(type.fields[2].type->length == 3);
    CHECK(type.fields[2].type->element == &type_of<std::int8_t>());
    CHECK(type.fields[3].type->single().kind == Type::Kind::boolean);
    CHECK(type_of<Octets>().kind == Type::Kind::octets);
}

TEST_CASE("an integer's range is that of its width and sign", "[engine][type]") {
    CHECK(type_of<std::int8_t>().integer_range() == std::pair<std::int64_t, std::int64_t>(-128, 127));
    CHECK(type_of<std::uint16_t>().integer_range() == std::pair<std::int64_t, std::int64_t>(0, 65535));
    CHECK(type_of<std::int64_t>().integer_range() ==
          std::pair(std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()));
    CHECK(type_of<std::uint64_t>().integer_range() ==
          std::pair(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
}

TEST_CASE("a value is looked at and changed by its type's table", "[engine][type]") {
    Sample sample{.levels = {1, 2, 3}, .flags = {false, true}};
    const ValuePlace place = sample;
    const auto& fields = type_of<Sample>().fields;

    CHECK(place.field(fields[1]).count() == 0);
    place.field(fields[1]).resize(1);
    *static_cast<double*>(place.field(fields[1]).first()) = 0.5;
    CHECK(sample.limit == 0.5);

    int sum = 0;
    for_each_element(place.view().field(fields[2]), [&](const ValueView& level) {
        sum += level.as<std::int8_t>();
        return sum < 3;
    });
    CHECK(sum == 3);

    for_each_element(place.field(fields[3]), [](const ValuePlace& flag) {
        flag.as<bool>() = !flag.as<bool>();
        return true;
    });
    CHECK(sample.flags == std::vector<bool>{true, false});
}

TEST_CASE("a value has its type, and copies are equal and apart from each other", "[engine][type]") {
    const Value empty;
    CHECK(empty.is_nothing());
    Value range = RangeData{.ranges = {0.1, 0.2}};
    const Value copy = range;
    CHECK(copy == range);
    CHECK(&copy.type() == &type_of<RangeData>());
    CHECK(copy.is<RangeData>());
    CHECK(copy.get_if<Velocity2D>() == nullptr);
    ValuePlace(range).as<RangeData>().ranges[1] = 0.3;
    CHECK_FALSE(copy == range);
    CHECK(copy.get<RangeData>().ranges == std::vector<double>{0.1, 0.2});
    CHECK(std::move(range).get<RangeData>().ranges == std::vector<double>{0.1, 0.3});
    CHECK_FALSE(Value(1.0) == Value(1.0F));
    CHECK(Value(type_of<Velocity2D>()) == Value(Velocity2D{}));
}

TEST_CASE("a value that was moved from holds nothing, and scalars and texts are moved whole", "[engine][type]") {
    Value number = 0.5, text = "a text that is too long to lie within a string itself";
    const Value same_number = number, same_text = text;
    const Value moved_number = std::move(number), moved_text = std::move(text);
    CHECK(number.is_nothing());
    CHECK(text.is_nothing());
    CHECK(moved_number == same_number);
    CHECK(moved_text == same_text);
    number = moved_text;
    CHECK(number.get<std::string>() == same_text.get<std::string>());
}

TEST_CASE("the names of its members describe an act", "[engine][type]") {
    const Type& hold = type_of<Hold>();
    CHECK(hold.name == "Hold");
    REQUIRE(hold.fields.size() == 3);
    CHECK(hold.fields[0].name == "port");
    CHECK(hold.fields[1].name == "value");
    CHECK(hold.fields[1].type->kind == Type::Kind::any);
    CHECK(hold.fields[2].name == "take");
    CHECK(hold.fields[2].type == &type_of<bool>());
    const Hold act{"mouse.out", 0.5, true};
    CHECK(ValueView(act).field(hold.fields[0]).as<std::string>() == "mouse.out");
    CHECK(ValueView(act).field(hold.fields[2]).as<bool>());
    CHECK(type_of<Stop>().fields.empty());
}

TEST_CASE("a walker looks through a value of any type at the one that it holds", "[engine][type]") {
    const std::vector<Value> all{0.5, "text", Value(), std::vector<double>{1.0, 2.0}, Velocity2D{.vx = 0.1}};
    CHECK(lua_text(all) == R"({ 0.5, "text", nil, { 1.0, 2.0 }, { vx = 0.1, vy = 0.0, va = 0.0 } })");
    CHECK(is_equal(all, std::vector<Value>(all)));
    CHECK_FALSE(is_equal(all, std::vector<Value>(5)));
    CHECK(is_finite(all));
    CHECK_FALSE(is_finite(std::vector<Value>{0.5, std::vector<double>{HUGE_VAL}}));
    CHECK(text_bytes(all) == 4);
}

TEST_CASE("values of every message type are equal to their copies, and not to those of another type",
          "[engine][type]") {
    for (const MessageType& one : compiled_message_types()) {
        const Value value(*one.payload);
        CHECK(message_of(value.type()) == &one);
        for (const MessageType& other : compiled_message_types()) {
            CAPTURE(one.name, other.name);
            CHECK((value == Value(*other.payload)) == (one.name == other.name));
        }
    }
}
