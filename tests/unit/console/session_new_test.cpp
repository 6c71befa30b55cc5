// The console has new behaviours written.
#include <catch2/catch.hpp>

#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

namespace {

struct Author {
    BehaviorRequest request;
    SessionOptions options() {
        SessionOptions options;
        options.author = [this](const std::filesystem::path&,
                                const BehaviorRequest& given) -> Expected<std::vector<std::string>> {
            request = given;
            if (given.name == "taken") return failure("behaviors/taken.lua is there already");
            return std::vector<std::string>{"behaviors/" + given.name + ".lua", "tests/" + given.name + "_test.lua"};
        };
        return options;
    }
};

}  // namespace

TEST_CASE("new writes a behaviour with ports, parameters and documentation", "[console][new]") {
    Author author;
    SessionRig it(counter_system, {{"counter", counter_behavior}}, author.options());
    CHECK(it.type(R"(new "follower" { inputs = { "light:TimedShortSeq:sensors" }, outputs = { "out:TimedVelocity2D" },
                                      params = { "gain=0.5" }, callbacks = { "on_activated" }, doc = "Follows." })") ==
          "wrote behaviors/follower.lua, tests/follower_test.lua");
    CHECK(author.request.name == "follower");
    CHECK(author.request.inputs == std::vector<std::string>{"light:TimedShortSeq:sensors"});
    CHECK(author.request.outputs == std::vector<std::string>{"out:TimedVelocity2D"});
    CHECK(author.request.parameters == std::vector<std::string>{"gain=0.5"});
    CHECK(author.request.callbacks == std::vector<std::string>{"on_activated"});
    CHECK(author.request.doc == "Follows.");
}

TEST_CASE("new reports the error of a wrong request", "[console][new]") {
    Author author;
    SessionRig it(counter_system, {{"counter", counter_behavior}}, author.options());
    CHECK(
        it.type("new 'x' { input = {} }") ==
        "! new: there is no field 'input' (did you mean 'inputs'?); known are inputs, outputs, params, callbacks, doc");
    CHECK(it.type("new 'x' { inputs = 'light' }") ==
          "! new: inputs: expected a list of strings, as in { \"distance:TimedShortSeq\" }");
    CHECK(it.type("new 'taken' {}") == "! new: behaviors/taken.lua is there already");
    SessionRig without;
    CHECK(without.type("new 'x' {}") == "! new: this program can't write files: use `nezumi run`");
}
