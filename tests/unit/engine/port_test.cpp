// Ports: what is visible when, what gets through, and what is kept.
#include "engine/ports/port.hpp"

#include <catch2/catch.hpp>

using namespace nezumi;

namespace {

Time at(std::int64_t tick) { return {tick, static_cast<double>(tick) / 100}; }

// An out-port and an in-port that listens to it.
struct Pair {
    explicit Pair(std::size_t queue = 0) : in("in", "", queue) { in.connect(out); }
    // One tick in which the out-port's owner wrote these.
    void pass(std::int64_t tick, const std::vector<std::int32_t>& values) {
        for (const std::int32_t value : values) out.write(value);
        out.latch(at(tick));
        in.latch(at(tick));
    }
    std::vector<std::int32_t> read_all() {
        std::vector<std::int32_t> all;
        while (in.is_new()) all.push_back(in.read());
        return all;
    }
    OutPort<std::int32_t> out{"out"};
    InPort<std::int32_t> in;
};

using Values = std::vector<std::int32_t>;

}  // namespace

TEST_CASE("a write is invisible until the port is latched", "[engine][port]") {
    OutPort<Velocity2D> target{"out"};
    CHECK(target.read() == Velocity2D{});
    target.write({.vx = 0.2});
    CHECK(target.read() == Velocity2D{});
    CHECK(target.written());
    CHECK(target.latch(at(7)));
    CHECK(target.read() == Velocity2D{.vx = 0.2});
    CHECK(target.tm() == 0.07);
    CHECK(target.latched_tick() == 7);
    CHECK(target.count() == 1);
    CHECK_FALSE(target.written());
}

TEST_CASE("a latch with nothing written publishes nothing and keeps the value", "[engine][port]") {
    Pair p;
    p.pass(1, {5});
    CHECK(p.read_all() == Values{5});
    CHECK_FALSE(p.out.latch(at(2)));
    p.in.latch(at(2));
    CHECK_FALSE(p.in.is_new());
    CHECK(p.out.read() == 5);
    CHECK(p.out.tm() == 0.01);
    CHECK(p.in.read() == 5);
}

TEST_CASE("an in-port takes what was published when it is latched, and not before", "[engine][port]") {
    Pair p;
    p.out.write(3);
    p.in.latch(at(0));
    CHECK_FALSE(p.in.is_new());
    p.out.latch(at(1));
    CHECK_FALSE(p.in.is_new());
    CHECK(p.in.read() == 0);
    p.in.latch(at(2));
    CHECK(p.in.is_new());
    CHECK(p.in.tm() == 0.01);  // the stamp of its publication
    CHECK(p.in.arrival_tick() == 2);
    CHECK(p.in.read() == 3);
    CHECK_FALSE(p.in.is_new());
    p.in.latch(at(3));
    CHECK_FALSE(p.in.is_new());  // once only
}

TEST_CASE("of several writes in one tick queues get each, the others the last", "[engine][port]") {
    Pair latest;
    latest.pass(1, {1, 2, 3});
    CHECK(latest.read_all() == Values{3});
    CHECK(latest.out.count() == 3);
    Pair queued(8);
    queued.pass(1, {1, 2, 3});
    CHECK(queued.read_all() == Values{1, 2, 3});
    queued.pass(2, {4});
    queued.pass(3, {5});
    CHECK(queued.read_all() == Values{4, 5});
    CHECK(queued.in.read() == 5);  // nothing waits: the last one again
}

TEST_CASE("a full queue drops the oldest and counts what it dropped", "[engine][port]") {
    Pair p(2);
    p.pass(1, {1, 2});
    CHECK(p.in.dropped() == 0);
    p.pass(2, {3, 4, 5});
    CHECK(p.in.dropped() == 3);
    CHECK(p.read_all() == Values{4, 5});
    p.pass(3, {6});
    CHECK(p.read_all() == Values{6});
    CHECK(p.in.dropped() == 3);
}

TEST_CASE("looking at an in-port consumes nothing", "[engine][port]") {
    for (const std::size_t queue : {0u, 2u}) {
        Pair p(queue);
        p.pass(1, {1, 2});
        CHECK(p.in.value() == AnyPayload(std::int32_t{2}));
        CHECK(p.in.latest().data == 2);
        CHECK(p.in.is_new());
        CHECK(p.read_all() == (queue > 0 ? Values{1, 2} : Values{2}));
    }
}

TEST_CASE("several connections arrive in tick order, then in the order of connecting", "[engine][port]") {
    OutPort<std::int32_t> a{"a"}, b{"b"}, c{"c"};
    InPort<std::int32_t> in{"in", "", 8};
    in.connect(a);
    in.connect(b);
    in.connect(c);
    const auto read_all = [&] {
        Values all;
        while (in.is_new()) all.push_back(in.read());
        return all;
    };
    c.write(3);
    b.write(2);
    a.write(1);
    for (OutPortBase* port :
         {static_cast<OutPortBase*>(&c), static_cast<OutPortBase*>(&b), static_cast<OutPortBase*>(&a)})
        port->latch(at(4));
    in.latch(at(4));
    CHECK(read_all() == Values{1, 2, 3});

    // What a behaviour published in the tick before comes before what a sensor published in this one.
    c.write(30);
    c.latch(at(5));
    a.write(10);
    a.latch(at(6));
    in.latch(at(6));
    CHECK(read_all() == Values{30, 10});
}

TEST_CASE("an in-port hears a new source from then on", "[engine][port]") {
    OutPort<std::int32_t> out{"out"};
    out.write(1);
    out.latch(at(1));
    InPort<std::int32_t> in{"in"};
    CHECK_FALSE(in.connected());
    in.connect(out);
    CHECK(in.connected());
    CHECK(in.sources() == std::vector<const OutPortBase*>{&out});
    in.latch(at(1));
    CHECK_FALSE(in.is_new());
    in.disconnect(out);
    CHECK_FALSE(in.connected());
    CHECK(in.disconnections() == 1);
    in.disconnect(out);
    CHECK(in.disconnections() == 1);
    out.write(2);
    out.latch(at(2));
    in.latch(at(2));
    CHECK_FALSE(in.is_new());
}

TEST_CASE("an injected value arrives once, after what the connections published", "[engine][port]") {
    Pair p(4);
    p.in.inject(std::int32_t{9});
    CHECK_FALSE(p.in.is_new());
    p.pass(5, {1});
    CHECK(p.in.latest().tm == 0.05);
    CHECK(p.read_all() == Values{1, 9});
    p.pass(6, {2});
    CHECK(p.read_all() == Values{2});
    Pair latest;
    latest.in.inject(std::int32_t{9});
    latest.pass(5, {1});
    CHECK(latest.read_all() == Values{9});
}

TEST_CASE("a held in-port gives its value every tick and nothing else, until it is released", "[engine][port]") {
    Pair p(8);
    p.in.hold(std::int32_t{7});
    CHECK(p.in.override() == Override::held);
    p.in.inject(std::int32_t{9});
    p.pass(1, {1});
    p.pass(2, {});
    CHECK(p.in.tm() == 0.02);
    CHECK(p.read_all() == Values{7, 7});
    p.in.release();
    CHECK(p.in.override() == Override::none);
    p.pass(3, {});
    CHECK(p.read_all().empty());  // what came meanwhile is gone
    p.pass(4, {4});
    CHECK(p.read_all() == Values{4});
}

TEST_CASE("a dropped in-port gets nothing, and what came meanwhile is gone", "[engine][port]") {
    Pair p;
    p.pass(1, {1});
    p.read_all();
    p.in.drop();
    p.in.inject(std::int32_t{9});
    p.pass(2, {2});
    CHECK_FALSE(p.in.is_new());
    CHECK(p.in.tm() == 0.01);
    p.in.release();
    p.pass(3, {});
    CHECK_FALSE(p.in.is_new());
    CHECK(p.in.read() == 1);
}

TEST_CASE("a frozen in-port repeats the value it had", "[engine][port]") {
    Pair p(8);
    p.pass(1, {1});
    p.read_all();
    p.in.freeze();
    CHECK(p.in.override() == Override::frozen);
    p.pass(2, {2});
    p.pass(3, {3});
    CHECK(p.read_all() == Values{1, 1});
    CHECK(p.in.tm() == 0.03);
}

TEST_CASE("an out-port can be held, dropped and frozen for all who listen", "[engine][port]") {
    Pair p;
    p.pass(1, {1});
    p.read_all();
    p.out.freeze();
    p.pass(2, {2});
    CHECK(p.read_all() == Values{1});
    p.out.hold(std::int32_t{7});
    p.pass(3, {3});
    CHECK(p.read_all() == Values{7});
    p.pass(4, {});
    CHECK(p.read_all() == Values{7});
    p.out.drop();
    p.pass(5, {5});
    CHECK(p.read_all().empty());
    p.out.release();
    p.pass(6, {});
    CHECK(p.read_all().empty());
    p.pass(7, {6});
    CHECK(p.read_all() == Values{6});
}

TEST_CASE("what was written and discarded is never published", "[engine][port]") {
    OutPort<std::int32_t> out{"out"};
    out.write(1);
    out.write(2);
    CHECK(out.pending() == 2);
    out.discard_after(1);
    CHECK(out.latch(at(1)));
    CHECK(out.read() == 1);
    out.write(3);
    out.discard();
    CHECK_FALSE(out.latch(at(2)));
    CHECK(out.read() == 1);
}

TEST_CASE("a velocity is safe at zero, and another value can be declared safe", "[engine][port]") {
    OutPort<Velocity2D> velocity{"v"};
    velocity.write_safe();
    CHECK(velocity.latch(at(1)));
    CHECK(velocity.read() == Velocity2D{});
    OutPort<std::int16_t> tone{"hz"};
    tone.write_safe();
    CHECK_FALSE(tone.latch(at(1)));
    tone.set_safe(std::int16_t{5});
    tone.write_safe();
    CHECK(tone.latch(at(2)));
    CHECK(tone.read() == 5);
    tone.set_safe_any(nullptr);
    CHECK_FALSE(tone.has_safe());
    const AnyPayload slow = Velocity2D{.vx = 0.1};
    velocity.set_safe_any(&slow);
    velocity.write_safe();
    velocity.latch(at(3));
    CHECK(velocity.read() == Velocity2D{.vx = 0.1});
    velocity.set_safe_any(nullptr);
    velocity.write_safe();
    velocity.latch(at(4));
    CHECK(velocity.read() == Velocity2D{});
}

TEST_CASE("a cleared in-port is as before anything came", "[engine][port]") {
    for (const std::size_t queue : {0u, 4u}) {
        Pair p(queue);
        p.pass(1, {1, 2});
        p.in.inject(std::int32_t{9});
        p.out.write(3);
        p.out.latch(at(2));
        p.in.clear();
        CHECK_FALSE(p.in.is_new());
        CHECK(p.in.read() == 0);
        CHECK(p.in.tm() == 0);
        CHECK(p.in.arrival_tick() == -1);
        p.in.latch(at(3));
        CHECK_FALSE(p.in.is_new());
    }
}

TEST_CASE("a queue that gets another length keeps the newest of what is unread", "[engine][port]") {
    Pair p(4);
    p.pass(1, {1, 2, 3});
    p.in.set_queue(2);
    CHECK(p.in.queue() == 2);
    CHECK(p.read_all() == Values{2, 3});
    p.pass(2, {4, 5});
    p.in.set_queue(0);
    CHECK(p.in.read() == 5);
    p.pass(3, {6});
    p.in.set_queue(3);
    p.pass(4, {7});
    CHECK(p.read_all() == Values{6, 7});
}

TEST_CASE("a queue of large messages drops the oldest before it fills the memory", "[engine][port]") {
    OutPort<std::string> out{"out"};
    InPort<std::string> in{"in", "", 100'000};
    in.connect(out);
    const std::string large(10'000'000, 'x');
    for (int i = 0; i < 10; ++i) {
        out.write(large + std::to_string(i));
        out.latch(at(i));
        in.latch(at(i));
    }
    CHECK(in.dropped() == 4);  // 6 of them are less than 64 MB
    CHECK(in.read().back() == '4');
    CHECK(in.read().back() == '5');
    in.set_queue(50);
    int left = 0;
    for (; in.is_new(); ++left) in.read();
    CHECK(left == 4);
    CHECK(in.read().back() == '9');
}

TEST_CASE("a publication is hashed message by message", "[engine][port]") {
    OutPort<std::int32_t> one{"out"}, two{"out"};
    one.write(1);
    one.write(2);
    two.write(2);
    one.latch(at(1));
    two.latch(at(1));
    CHECK(one.hash_latched(5) != two.hash_latched(5));
    Values told;
    for (const auto& message : one.messages()) told.push_back(message.data);
    CHECK(told == Values{1, 2});
}
