// What a trace follows: every message in order, by name, over restarts, in bounded memory.
#include "engine/trace/trace.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "engine/trace/text_plot.hpp"
#include "engine/trace/trace_table.hpp"
#include "tests/unit/engine/fake_world.hpp"
#include "tests/unit/engine/try_component.hpp"
#include "tests/unit/leaf_text.hpp"

using namespace nezumi;

namespace {

using Rows = std::vector<std::string>;

// A system of components, and its trace.
struct Traced {
    Traced() { trace.start(system); }

    TryComponent& add(const std::string& name, TryComponent::Hooked executed = {}) {
        auto made = std::make_unique<TryComponent>(name);
        made->executed = std::move(executed);
        auto& added = static_cast<TryComponent&>(*system.add(std::move(made)).value());
        REQUIRE(added.activate(system.now()));
        return added;
    }
    const Channel& follow(const std::string& name) { return *trace.follow(name).value(); }
    std::string why_not(const std::string& name) {
        const auto followed = trace.follow(name);
        return followed ? "it is there" : followed.error().message;
    }
    void tick(int count = 1) {
        for (; count > 0; --count) system.tick();
    }

    System system{{}, nullptr};
    Trace trace;
};

Expected<void> says_three_things(TryComponent& self) {
    const auto first = static_cast<std::int32_t>(self.executions() * 10);
    for (const std::int32_t value : {first, first + 1, first + 2}) self.out.write(value);
    return {};
}

// The messages of the latest tick.
Rows fresh(const Channel& channel) {
    Rows texts;
    for (std::size_t i = 0; i < channel.fresh(); ++i) {
        texts.emplace_back();
        channel.visit(i, [&](const LeafPath& path, const ValueView& leaf) {
            texts.back() += fmt::format("{}={} ", channel.name_of(path), text_of(leaf));
        });
    }
    return texts;
}

// Rows of a table after a tick, its columns in order.
Rows read(TraceTable& table) {
    Rows rows;
    table.read([&](const std::vector<std::string>& cells) {
        std::string row;
        for (const std::size_t id : table.order()) row += "," + cells[id];
        rows.push_back(row.substr(1));
    });
    return rows;
}

}  // namespace

TEST_CASE("a followed port gives every message of a tick, in order, at both ends", "[engine][trace]") {
    Traced it;
    it.add("a", says_three_things);
    it.add("b");
    REQUIRE(it.system.connect("a.out", "b.in"));
    const Channel &out = it.follow("a.out"), &in = it.follow("b.in");
    it.tick();
    CHECK(fresh(out) == Rows{"a.out=10 ", "a.out=11 ", "a.out=12 "});
    CHECK(in.fresh() == 0);
    it.tick();
    CHECK(fresh(in) == Rows{"b.in=10 ", "b.in=11 ", "b.in=12 "});
    it.system.find("a")->find_out_port("out")->drop();
    (*it.system.port("b.in"))->drop();
    it.tick();
    CHECK(out.fresh() == 0);
    CHECK(in.fresh() == 0);
}

TEST_CASE("the trace of an in-port has injected and held values", "[engine][trace]") {
    Traced it;
    auto& b = it.add("b");
    const Channel& in = it.follow("b.in");
    b.in.inject(std::int32_t{7});
    b.in.inject(std::int32_t{8});
    it.tick();
    CHECK(fresh(in) == Rows{"b.in=7 ", "b.in=8 "});
    b.in.hold(std::int32_t{9});
    it.tick();
    CHECK(fresh(in) == Rows{"b.in=9 "});
}

TEST_CASE("a port that is not followed stores no messages", "[engine][trace]") {
    Traced it;
    auto& b = it.add("b");
    b.in.inject(std::int32_t{7});
    it.tick();
    CHECK(b.in.latest().data == 7);
    CHECK(b.in.messages().empty());
}

TEST_CASE("a name that can't be followed is refused, and the error suggests the nearest name", "[engine][trace]") {
    Traced it;
    REQUIRE(it.add("it").parameters().declare({.name = "speed_x", .initial = 0.5}));
    CHECK(it.why_not("out") == "'out' is not a port: expected \"name.port\"");
    CHECK(it.why_not("itt.out") == "'itt.out': there is no component 'itt' (did you mean 'it'?)");
    CHECK(it.why_not("it.speeed") == "it has no port 'speeed' (did you mean 'speed'?)");
    CHECK(it.why_not("it.confg") == "it has no port 'confg' (did you mean 'config'?)");
    CHECK(it.why_not("it.truth") == "it has no truth: it is not a robot");
    CHECK(it.why_not("it.state") == "it has no port 'state'");
    CHECK(it.why_not("it.speed.vz") == "it.speed has no 'vz' (did you mean 'vx'?)");
    CHECK(it.why_not("it.speed.vx.low") == "it.speed.vx is a single value: it has no 'low'");
    CHECK(it.why_not("it.out[1]") == "it.out is a single value: it has no '[1]'");
    CHECK(it.why_not("it.config.speed") == "it: unknown parameter 'speed' (did you mean 'speed_x'?)");
    CHECK(it.why_not("it.speed.vx") == "it is there");
    CHECK(it.why_not("it.config.speed_x") == "it is there");
}

TEST_CASE("every value that is shown can be followed", "[engine][trace]") {
    Traced it;
    it.add("it", says_three_things);
    const Channel& status = it.follow("it.status");
    const Channel& count = it.follow("it.ports.out.count");
    it.tick();
    CHECK(fresh(status) == Rows{"it.status=ACTIVE "});
    CHECK(fresh(count) == Rows{"it.out.count=3 "});
    CHECK(it.follow("it.out.value").name() == "it.out");
    CHECK(it.why_not("it.activate") == "it has no port 'activate'");
}

TEST_CASE("a part of a port is followed alone", "[engine][trace]") {
    Traced it;
    it.add("it", [](TryComponent& self) -> Expected<void> {
        self.speed.write({.vx = 0.5, .va = 2});
        return {};
    });
    const Channel& part = it.follow("it.speed.va");
    CHECK(part.name() == "it.speed.va");
    it.tick();
    CHECK(fresh(part) == Rows{"it.speed.va=2 "});
}

TEST_CASE("the parameters are in the trace of each tick in which one has changed", "[engine][trace]") {
    Traced it;
    auto& component = it.add("it");
    REQUIRE(component.parameters().declare({.name = "speed_x", .initial = 0.5}));
    REQUIRE(component.parameters().declare({.name = "name", .initial = std::string("tom")}));
    REQUIRE(component.parameters().declare({.name = "gains", .initial = std::vector<double>{1, 2}}));
    const Channel& config = it.follow("it.config");
    it.tick();
    CHECK(fresh(config) == Rows{"it.config.speed_x=0.5 it.config.name=tom it.config.gains[1]=1 it.config.gains[2]=2 "});
    it.tick();
    CHECK(config.fresh() == 0);
    REQUIRE(component.parameters().set("speed_x", 0.75));
    it.tick();
    CHECK(fresh(config).front().starts_with("it.config.speed_x=0.75 "));
}

TEST_CASE("a name means the present component, also after a component was replaced, or the system", "[engine][trace]") {
    Traced it;
    it.add("a", says_three_things);
    const Channel& out = it.follow("a.out");
    it.tick();
    CHECK(out.has_value());
    REQUIRE(it.system.remove("a"));
    it.tick();
    CHECK_FALSE(out.has_value());
    CHECK(out.fresh() == 0);
    it.add("a", says_three_things);
    it.tick();
    CHECK(fresh(out) == Rows{"a.out=10 ", "a.out=11 ", "a.out=12 "});

    System other({}, nullptr);
    auto made = std::make_unique<TryComponent>("a");
    made->executed = [](TryComponent& self) -> Expected<void> { return self.out.write(5), Expected<void>(); };
    REQUIRE(other.add(std::move(made)).value()->activate(other.now()));
    it.trace.start(other);
    CHECK_FALSE(out.has_value());
    other.tick();
    CHECK(fresh(out) == Rows{"a.out=5 "});
}

TEST_CASE("the numbers of every port are remembered, also of one that comes later, but no pictures",
          "[engine][trace]") {
    struct Camera : Component {
        Camera() : Component("camera", "Camera") { add_out_port<CameraImage>("image"); }
    };
    Traced it;
    REQUIRE(it.system.add(std::make_unique<Camera>()));
    it.trace.remember_ports();
    it.add("late", says_three_things);
    it.tick(2);
    const Series& series = **it.trace.remember("late.out");
    REQUIRE(series.size() == 6);
    CHECK(series.value(0, 0) == 10);
    CHECK(series.value(5, 0) == 22);
    CHECK(series.seconds(5) == 0.01);
    CHECK((*it.trace.remember("camera.image"))->size() == 0);

    // What is gone is forgotten, and begins again when it comes again.
    REQUIRE(it.system.remove("late"));
    it.tick();
    it.add("late", says_three_things);
    it.tick();
    CHECK((*it.trace.remember("late.out"))->size() == 3);

    System other({}, nullptr);
    it.add("other", says_three_things);
    REQUIRE(other.add(std::make_unique<TryComponent>("other")));
    it.tick();
    const Series& of_both = **it.trace.remember("other.out");
    CHECK(of_both.size() == 3);
    it.trace.start(other);
    CHECK(of_both.size() == 0);
}

TEST_CASE("in a system with more ports, only requested ports are remembered", "[engine][trace]") {
    Traced it;
    it.trace.remember_ports();
    const std::size_t each = 5;  // ports of one
    for (std::size_t i = 0; i <= Trace::most_ports / each; ++i) it.add("n" + std::to_string(i), says_three_things);
    it.tick(2);
    // It begins with what the port holds now.
    const Series& series = **it.trace.remember("n3.out");
    CHECK(series.size() == 3);
    CHECK(series.seconds(0) == 0.01);
    it.tick();
    CHECK(series.size() == 6);
}

TEST_CASE("a series keeps the latest samples, and its rows when values are added", "[engine][trace]") {
    Series series;
    series.set_labels({"a"});
    for (std::size_t i = 0; i < Series::usual_samples + 2; ++i) {
        const double value = static_cast<double>(i);
        series.add(value, std::span(&value, 1));
    }
    CHECK(series.size() == Series::usual_samples);
    CHECK(series.seconds(0) == 2);
    CHECK(series.value(series.size() - 1, 0) == Series::usual_samples + 1);
    series.set_labels({"a", "b"});
    const double both[] = {1, 2};
    series.add(9000, both);
    CHECK(series.size() == Series::usual_samples);
    CHECK(series.seconds(0) == 3);
    CHECK(series.value(0, 0) == 3);
    CHECK(std::isnan(series.value(0, 1)));
    CHECK(series.value(series.size() - 1, 1) == 2);
    series.clear();
    series.add(1, std::span(both, 1));
    CHECK(series.size() == 1);
    CHECK(std::isnan(series.value(0, 1)));
}

TEST_CASE("a series can keep more samples, and fewer", "[engine][trace]") {
    Series series;
    series.set_labels({"a"});
    series.keep(4);
    for (int i = 0; i < 6; ++i) {
        const double value = i;
        series.add(value, std::span(&value, 1));
    }
    CHECK(series.size() == 4);
    series.keep(5);
    const double more = 6;
    series.add(more, std::span(&more, 1));
    REQUIRE(series.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) CHECK(series.seconds(i) == static_cast<double>(i + 2));
    series.keep(2);
    REQUIRE(series.size() == 2);
    CHECK(series.seconds(0) == 5);
    CHECK(series.value(1, 0) == 6);
}

TEST_CASE("when the remembered values exceed their memory, the oldest are dropped", "[engine][trace]") {
    Traced it;
    it.add("a", says_three_things);
    it.trace.keep(1'000'000, 40'000);
    const Series& series = **it.trace.remember("a.out");
    it.tick(3000);
    CHECK(series.bytes() <= 40'000 + 100 * 3 * 2 * sizeof(double));
    CHECK(series.size() > 1000);
    CHECK(series.seconds(series.size() - 1) > 29.9);
    CHECK(series.seconds(0) > 1);
}

TEST_CASE("a table has a row for each message of a tick, the last one with the latest of all", "[engine][trace]") {
    Traced it;
    it.add("a", says_three_things);
    auto& b = it.add("b", [](TryComponent& self) -> Expected<void> {
        if (self.executions() == 2) self.speed.write({.vx = 0.25});
        return {};
    });
    REQUIRE(b.parameters().declare({.name = "word", .initial = std::string("a, \"b\"")}));
    TraceTable table({&it.follow("b.speed"), &it.follow("a.out"), &it.follow("b.config")});
    CHECK(table.header() == "time,b.speed.vx,b.speed.vy,b.speed.va,a.out,b.config.word");
    it.tick();
    const std::string word = R"("a, ""b""")";
    CHECK(read(table) == Rows{",,,10," + word, ",,,11," + word, ",,,12," + word});
    it.tick();
    CHECK(read(table) == Rows{"0.25,0,0,20," + word, "0.25,0,0,21," + word, "0.25,0,0,22," + word});
    CHECK(read(table) == Rows{"0.25,0,0,22," + word});
    REQUIRE(it.system.remove("a"));
    it.tick();
    CHECK(read(table) == Rows{"0.25,0,0,," + word});
    CHECK(TraceTable::row("0.01", {2, 0, 3}, {"a", "b", "c"}) == "0.01,c,a,");
}

TEST_CASE("a series keeps texts by their places, each once, and not without end", "[engine][trace]") {
    Series series;
    CHECK(series.place_of("slow") == 0);
    CHECK(series.place_of("fast") == 1);
    CHECK(series.place_of("slow") == 0);
    for (int i = 0; i < 1000; ++i) series.place_of(std::to_string(i));
    CHECK(series.texts().size() == Series::most_texts);
    CHECK(series.texts().back() == "...");
    CHECK(series.place_of("another") == Series::most_texts - 1);
    CHECK(series.texts()[series.place_of(std::string(100, 'x'))].size() <= Series::longest_text);
}

TEST_CASE("curves are the labels within a part; a held value is drawn over the whole time", "[engine][trace]") {
    Series series;
    series.set_labels({"pose.x", "pose.y", "mode"}, {false, false, true});
    for (const double at : {1.0, 2.0}) {
        const double values[] = {at, -at, static_cast<double>(series.place_of(at < 1.5 ? "slow" : "fast"))};
        series.add(at, values);
    }
    CHECK(curves_of(series, "", 0, 3).size() == 3);
    const auto pose = curves_of(series, "pose", 0, 3);
    REQUIRE(pose.size() == 2);
    CHECK(pose[1].points == std::vector<std::pair<double, double>>{{1, -1}, {2, -2}});
    CHECK(curves_of(series, "pose.x", 1.5, 3)[0].points == std::vector<std::pair<double, double>>{{2, 2}});
    CHECK(curves_of(series, "pose.x", 1.5, 3, true)[0].points ==
          std::vector<std::pair<double, double>>{{1.5, 1}, {2, 2}, {3, 2}});
    CHECK(curves_of(series, "pose.x", 2.5, 3).empty());
    CHECK(text_line(curves_of(series, "mode", 0, 3)[0]) == "mode: \"slow\" from 1 s, \"fast\" from 2 s");
}
