// What the names of a system refer to, the same for all users.
#include <catch2/catch.hpp>

#include "engine/system/act.hpp"
#include "engine/tree/member.hpp"
#include "tests/unit/engine/try_component.hpp"
#include "tests/unit/leaf_text.hpp"

using namespace nezumi;

namespace {

// A system of one component with two parameters.
struct Tree {
    Tree() {
        auto made = std::make_unique<TryComponent>();
        REQUIRE(made->parameters().declare({.name = "speed_x", .initial = 0.5, .unit = "m/s", .doc = "how fast"}));
        REQUIRE(made->parameters().declare({.name = "gains", .initial = std::vector<double>{1, 2}}));
        made->executed = [](TryComponent& self) -> Expected<void> {
            self.speed.write({.vx = 0.25});
            return {};
        };
        it = static_cast<TryComponent*>(*system.add(std::move(made)));
        REQUIRE(it->activate(system.now()));
        system.tick();
    }
    TreeNode at(std::string_view path) const { return TreeNode(system).find(path).value(); }
    std::string why_not(std::string_view path) const { return TreeNode(system).find(path).error().message; }
    // "0.25", "{}" for what holds nothing.
    std::string value(std::string_view path) const {
        const NodeValue value = at(path).value().value();
        std::string text;
        if (const auto* held = std::get_if<Value>(&value))
            visit_leaves(*held, [&](const LeafPath&, const ValueView& leaf) { text += text_of(leaf) + " "; });
        return text.empty() ? "{}" : text.substr(0, text.size() - 1);
    }

    System system{{}, nullptr};
    TryComponent* it = nullptr;
};

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("every child name of a node leads to a child with documentation", "[engine][tree]") {
    Tree tree;
    for (const std::string path : {"", "it", "it.ports", "it.config", "it.speed", "it.speed.value"}) {
        const TreeNode node = tree.at(path);
        CHECK_FALSE(node.children().empty());
        for (const std::string& name : node.children()) {
            CAPTURE(path, name);
            const auto child = node.child(name);
            REQUIRE(child);
            CHECK(tree.at(child->path()).path() == child->path());
            const bool is_said =
                child->member() != nullptr && child->port() == nullptr && child->parameter() == nullptr;
            CHECK((!is_said || !child->doc().empty()));
        }
    }
}

TEST_CASE("a name leads to a value with its type, its unit and its meaning", "[engine][tree]") {
    Tree tree;
    CHECK(tree.value("it.status") == "ACTIVE");
    CHECK(tree.value("it.rate") == "100");
    CHECK(tree.value("it.error") == "{}");
    CHECK(tree.value("it.speed.value.vx") == "0.25");
    CHECK(tree.value("it.speed.count") == "1");
    CHECK(tree.value("it.config.gains[2]") == "2");
    CHECK(tree.value("it.config.gains[3]") == "{}");
    CHECK(tree.at("it.speed.value.vx").type() == &type_of<double>());
    CHECK(tree.at("it.speed.value.vx").unit() == "m/s");
    CHECK(tree.at("it.config.speed_x").unit() == "m/s");
    CHECK(tree.at("it.config.speed_x").doc() == "how fast");
    CHECK(tree.at("it.speed.value").children() == Names{"vx", "vy", "va"});
    CHECK(tree.at("it.speed").children(TreeNode::Called::yes) ==
          Names{"drop", "freeze", "hold", "inject", "release", "write"});
}

TEST_CASE("a port's value has one path, however it is named", "[engine][tree]") {
    Tree tree;
    for (const std::string name :
         {"it.speed.vx", "it.speed.value.vx", "it.ports.speed.vx", "it.ports.speed.value.vx"}) {
        CAPTURE(name);
        CHECK(tree.at(name).path() == "it.speed.vx");
        CHECK(tree.at(name).whole() == "it.speed");
        CHECK(tree.at(name).part() == "vx");
    }
    CHECK(tree.at("it.speed.age").path() == "it.speed.age");
    CHECK(tree.at("it.config.gains[2]").part() == "gains[2]");
}

TEST_CASE("a part of a value is read from the value's node as from its own", "[engine][tree]") {
    Tree tree;
    const auto part = [&](std::string_view value, std::string_view path) {
        const TreeNode node = tree.at(value);
        CHECK(node.is_value());
        const NodeValue found = node.value_at(path).value();
        const auto* held = std::get_if<Value>(&found);
        return held != nullptr ? held->get<double>() : -1;
    };
    CHECK(part("it.speed.value", "vx") == 0.25);
    CHECK(part("it.config.gains", "[2]") == 2);
    CHECK(part("it.config.speed_x", "") == 0.5);
    CHECK(part("it.speed.value", "vz") == -1);
    CHECK(part("it.config.gains", "[3]") == -1);
    CHECK_FALSE(tree.at("it.speed").is_value());
    CHECK_FALSE(tree.at("it").is_value());
}

TEST_CASE("an unknown name is refused, and the error suggests the nearest name", "[engine][tree]") {
    Tree tree;
    CHECK(tree.why_not("itt.speed") == "there is no component 'itt' (did you mean 'it'?)");
    CHECK(tree.why_not("it.statsu") == "it has no 'statsu' (did you mean 'status'?)");
    CHECK(tree.why_not("it.gains") == "it has no 'gains': its parameter is it.config.gains");
    CHECK(tree.why_not("it.config.gain") == "it: unknown parameter 'gain' (did you mean 'gains'?)");
    CHECK(tree.why_not("it.ports.sped") == "it has no port 'sped' (did you mean 'speed'?)");
    CHECK(tree.why_not("it.speed.valu") == "it.speed has no 'valu' (did you mean 'value'?)");
    CHECK(tree.why_not("it.speed.vz") == "it.speed has no 'vz' (did you mean 'vx'?)");
    CHECK(tree.why_not("it.config.gains.x") == "it.config.gains is a list: it.config.gains[1] is its first element");
    CHECK(tree.why_not("it.config.speed_x.y") == "it.config.speed_x is a single value: it has no 'y'");
}

TEST_CASE("a parameter says by which act it is set, everything else why it can't be", "[engine][tree]") {
    Tree tree;
    const SetParameter act = tree.at("it.config").to_set("speed_x").value().set(0.75);
    CHECK(act.component == "it");
    CHECK(act.parameter == "speed_x");
    CHECK(act.value == Value{0.75});
    const auto refusal = [&](const std::string& path, std::string_view name) {
        return tree.at(path).to_set(name).error().message;
    };
    CHECK(refusal("it.config", "sped_x") == "it: unknown parameter 'sped_x' (did you mean 'speed_x'?)");
    CHECK(refusal("it", "speed_x") == "it.speed_x can't be set: its parameter is it.config.speed_x");
    CHECK(refusal("it", "speed") == "it.speed is a port: write a value with it.speed:write(value)");
    CHECK(refusal("it.speed", "value") == "it.speed: its members can't be set; write a value with :write(value)");
    CHECK(refusal("", "it") == "it can't be set");
}
