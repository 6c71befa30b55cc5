// A word that a program registers: neither the engine nor the readers of system files know it.
#include "engine/system/peer_word_of.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <string_view>

#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/files/system_text.hpp"
#include "engine/records/write_record.hpp"
#include "engine/system/build_system.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi {
namespace radio {

struct RadioSpec {
    double band = 433;
    Place place{};
};

}  // namespace radio

template <>
struct Describe<radio::RadioSpec> {
    static constexpr std::string_view name = "radio";
    static constexpr std::string_view doc = "Reaches radio stations.";
    static constexpr FieldList fields{
        Setting{"band", &radio::RadioSpec::band, "MHz", "of all stations", {.range = NumberRange::positive}},
        Internal{&radio::RadioSpec::place},
    };
};

namespace radio {

class RadioWord final : public PeerWordOf<RadioSpec> {
public:
    std::string_view port_form() const override { return "radio:STATION"; }
    Expected<void> check(const SystemSpec& system) const override {
        for (const ConnectionSpec& each : system.connections) {
            if (has_port(each.to) && find(system) == nullptr)
                return failure("connect: " + each.to + " needs the word radio", each.place);
        }
        return {};
    }
    Expected<void> check_port(std::string_view end) const override {
        if (end.size() > port_form().find(':') + 1) return {};
        return failure("expected \"radio:STATION\", got '" + std::string(end) + "'");
    }
    Expected<void> check_connection(const System& /*system*/, const PeerSpec* spec,
                                    const ConnectionSpec& connection) const override {
        if (spec == nullptr) return failure("there is no radio");
        if (connection.to != "radio:noise") return {};
        return failure(connection.to + " is not on this band");
    }

protected:
    void complete(RadioSpec& given, Fields& fields, const PeerCall& call) const override {
        if (given.band > 1000) fields.check().wrong({"band"}, "is too high");
        if (call.is_taken("radio")) fields.check().wrong_at({}, "the name is already used");
    }
    std::string text_of(const RadioSpec& given) const override { return "radio " + write_record(given) + "\n"; }
};

const RadioWord word{};

Expected<SystemSpec> read(std::string_view text, const PeerWords& words = {&word}) {
    return read_system_text(text, "s.lua", Project::of(root / "s.lua", {root}), {.peer_words = words});
}

std::string refusal(std::string_view text, const PeerWords& words = {&word}) {
    const auto spec = read(text, words);
    return spec ? "" : describe(spec.error());
}

// The error of the system as it is built, without components.
std::string built(const SystemSpec& spec, const PeerWords& words) {
    Makers makers;
    makers.peer_words = words;
    const auto system = build_system(spec, makers, {});
    if (!system) return describe(system.error());
    return (*system)->foreign_connections().empty() ? "no connection" : "";
}

}  // namespace radio
}  // namespace nezumi

using namespace nezumi;

TEST_CASE("a registered word is read, checked and written", "[lua][system_file][peers]") {
    const auto spec = radio::read("radio { band = 868 }\nconnect('c.out', 'radio:news')");
    REQUIRE(spec);
    REQUIRE(radio::RadioWord::find(*spec) != nullptr);
    CHECK(radio::RadioWord::find(*spec)->band == 868);
    CHECK(spec->peers.at("radio")->place().line == 1);
    const std::string text = write_system_text(*spec, "x");
    CHECK(text == "--- x\nradio { band = 868.0 }\n\n\nconnect(\"c.out\", \"radio:news\")\n");
    CHECK(write_system_text(*radio::read(text), "x") == text);
    CHECK(radio::read("seed(1)")->peers.empty());
}

TEST_CASE("errors in the use of a registered word have their locations", "[lua][system_file][peers]") {
    CHECK(radio::refusal("radio {\n  bend = 1 }") == "s.lua:2:3: radio: unknown field 'bend' (did you mean 'band'?)");
    CHECK(radio::refusal("radio { band = 2000 }") == "s.lua:1:9: radio: field 'band' is too high");
    CHECK(radio::refusal("radio {}\nradio {}") == "s.lua:2: radio: is set already, at s.lua:1");
    CHECK(radio::refusal("radio(5)") == "s.lua:1: radio: expected a table, got number");
    CHECK(radio::refusal("connect('c.out', 'radio:')") == "s.lua:1: connect: expected \"radio:STATION\", got 'radio:'");
    CHECK(radio::refusal("connect('radio:a', 'radio:b')") ==
          "s.lua:1: connect: both ends are ports of other programs: one of them must be of this system");
    CHECK(radio::refusal("connect('c.out', 'radio:a')") == "s.lua:1: connect: radio:a needs the word radio");
    CHECK_THAT(radio::refusal("radoi {}"), Catch::Contains("did you mean 'radio'?"));
}

TEST_CASE("a word that no one has registered is an unknown global", "[lua][system_file][peers]") {
    for (const std::string word : {"radio", "network", "ros", "rtm"})
        CHECK_THAT(radio::refusal(word + " {}", {}), Catch::Contains("unknown global '" + word + "'"));
    CHECK(radio::refusal("connect('c.out', 'radio:news')", {}) ==
          "s.lua:1: connect: expected \"name.port\", got 'radio:news'");
}

TEST_CASE("a registered word checks connections with its peers", "[lua][system_file][peers]") {
    const auto spec_to = [](const std::string& end) {
        SystemSpec spec;
        spec.connections.push_back({"c.out", end, {"s.lua", 1}});
        radio::word.put(spec, {});
        return spec;
    };
    CHECK(radio::built(spec_to("radio:news"), {&radio::word}) == "");
    CHECK(radio::built(spec_to("radio:noise"), {&radio::word}) == "s.lua:1: connect: radio:noise is not on this band");
    SystemSpec without = spec_to("radio:news");
    without.peers.clear();
    CHECK(radio::built(without, {&radio::word}) == "s.lua:1: connect: there is no radio");
    for (const PeerWords& words : {PeerWords{}, PeerWords{&radio::word}}) {
        CHECK(radio::built(spec_to("other:x"), words) ==
              "s.lua:1: connect: c.out to other:x: this program can't connect to ports of other programs");
    }
}
