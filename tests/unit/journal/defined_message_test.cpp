// Random definitions of messages, and random values of them, through everything that values go through.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "bindings/journal/value_json.hpp"
#include "engine/messages/message_catalog.hpp"
#include "engine/messages/msg_file.hpp"
#include "engine/values/cdr.hpp"
#include "engine/values/limits.hpp"
#include "engine/values/value_text.hpp"
#include "tests/unit/random_message.hpp"

using namespace nezumi;

namespace {

Expected<const Type*> compiled(const FieldDefinition& field) { return compiled_payload(field.kind); }

// As a file of ROS has it.
std::string msg_text(const MessageDefinition& definition) {
    const std::map<std::string, std::string, std::less<>> words{
        {"boolean", "bool"},   {"octet", "uint8"},   {"short", "int16"},  {"long", "int32"},
        {"longlong", "int64"}, {"ushort", "uint16"}, {"ulong", "uint32"}, {"ulonglong", "uint64"},
        {"float", "float32"},  {"double", "float64"}};
    std::string text;
    for (const FieldDefinition& field : definition.fields) {
        const auto word = words.find(field.kind);
        std::string shape;
        if (!field.shape.empty()) shape = field.shape[0] == 0 ? "[]" : fmt::format("[{}]", field.shape[0]);
        text += fmt::format("{}{} {}\n", word != words.end() ? word->second : field.kind, shape, field.name);
    }
    return text;
}

}  // namespace

TEST_CASE("a message of any definition comes back as it was, through file, CDR and journal", "[journal][message]") {
    for (unsigned seed = 1; seed <= 400; ++seed) {
        RandomMessages random(seed);
        MessageDefinition definition = random.definition(fmt::format("random/R{}", seed));
        const std::string text = msg_text(definition);
        INFO("seed " << seed << "\n" << text);
        MessageCatalog catalog;
        const auto type = catalog.define(definition, compiled);
        REQUIRE(type);
        CHECK(catalog.define(definition, compiled) == type);

        // Names within a package are of that package; these are compiled in.
        auto read = read_msg({fmt::format("random/R{}.msg", seed), definition.place.file, text}, "random");
        REQUIRE(read);
        for (FieldDefinition& field : read->fields) field.kind = field.kind.substr(field.kind.find('/') + 1);
        CHECK(catalog.define(*read, compiled) == type);

        Value value = make_payload(*type);
        for (int i = 0; i < 3; ++i) {
            random.fill(value);
            const Value copy = value;
            CHECK(copy == value);
            CHECK(mix_payload(7, copy) == mix_payload(7, value));
            for (const std::endian order : {std::endian::little, std::endian::big}) {
                Octets bytes;
                write_cdr(bytes, {.order = order, .header = true}, value);
                Value again = make_payload(*type);
                REQUIRE(read_cdr(bytes, {.header = true}, again));
                CHECK(again == value);
            }
            const auto json = nlohmann::ordered_json::parse(value_to_json(value).dump());
            Value again = make_payload(*type);
            REQUIRE(read_value(json, again) == "");
            CHECK(again == value);

            // By its type's name, where any value may stand.
            const OtherForms forms{.message = [&](const std::string& name) { return catalog.find(name); }};
            const Value any = value;
            std::array<Value, 2> pair{any, Value(1.5)};
            std::array<Value, 2> other;
            REQUIRE(read_value(value_to_json(pair, forms), other, forms) == "");
            CHECK(other == pair);
        }
    }
}

TEST_CASE("a value that was assigned or moved is the other one", "[journal][message]") {
    MessageCatalog catalog;
    MessageDefinition definition{.name = "Some", .place = {"some.msg"}};
    definition.fields.push_back({.name = "texts", .kind = "string", .shape = {3}});
    definition.fields.push_back({.name = "places", .kind = "SeenMarker", .shape = {0}});
    definition.fields.push_back({.name = "rows", .kind = "double", .shape = {2, 0}});
    definition.fields.push_back({.name = "kind", .choices = {"a", "b"}, .initial = Value("b")});
    const auto type = catalog.define(definition, compiled);
    REQUIRE(type);
    Value value = make_payload(*type);
    CHECK(lua_text(value) == R"({ texts = { "", "", "" }, places = {}, rows = {}, kind = "b" })");
    RandomMessages random(1);
    for (int i = 0; i < 100; ++i) {
        random.fill(value);
        Value other = make_payload(*type);
        random.fill(other);
        other = value;
        CHECK(other == value);
        Value moved = std::move(other);
        CHECK(moved == value);
        ValuePlace(moved).reset();
        CHECK(moved == make_payload(*type));
    }
}

TEST_CASE("numbers and lengths that a field refuses are reported", "[journal][message]") {
    MessageCatalog catalog;
    MessageDefinition inner{.name = "Inner", .place = {"inner.msg"}};
    inner.fields.push_back({.name = "x", .kind = "short", .limits = {.min = 0, .max = 5}});
    const auto inside = catalog.define(inner, compiled);
    REQUIRE(inside);
    MessageDefinition outer{.name = "Outer", .place = {"outer.msg"}};
    outer.fields.push_back({.name = "all", .kind = "Inner", .shape = {0}, .limits = {.length = 2}});
    outer.fields.push_back({.name = "text", .kind = "string", .limits = {.length = 3}});
    const auto type =
        catalog.define(outer, [&](const FieldDefinition&) -> Expected<const Type*> { return (*inside)->payload; });
    REQUIRE(type);
    Value value = make_payload(*type);
    const auto read = [&](const char* json) {
        REQUIRE(read_value(nlohmann::ordered_json::parse(json), value) == "");
        return find_misfit(value);
    };
    CHECK(read(R"({"all": [{"x": 1}, {"x": 5}], "text": "abc"})") == "");
    CHECK(read(R"({"all": [{"x": 1}, {"x": 6}], "text": ""})") ==
          "field 'all[2].x' expected an integer from 0 to 5, got 6");
    CHECK(read(R"({"all": [{"x": 1}, {"x": 1}, {"x": 1}], "text": ""})") ==
          "field 'all' expected at most 2 elements, got 3");
    CHECK(read(R"({"all": [], "text": "abcd"})") == "field 'text' expected at most 3 bytes, got 4");
}
