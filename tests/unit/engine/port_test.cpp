// Ports: what is visible when, of which sources, with which stamp.
#include "engine/ports/port.hpp"

#include "tests/unit/engine/port_pair.hpp"

using namespace nezumi;

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

TEST_CASE("an in-port receives published values only when it is latched", "[engine][port]") {
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

TEST_CASE("looking at an in-port consumes nothing", "[engine][port]") {
    for (const std::size_t queue : {0u, 2u}) {
        Pair p(queue);
        p.pass(1, {1, 2});
        CHECK(p.in.value() == Value(std::int32_t{2}));
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

TEST_CASE("a message may carry a stamp of its own", "[engine][port]") {
    Pair p(3);
    p.out.write(1);
    p.out.stamp(-0.5);  // measured before the start
    p.out.write(2);
    p.out.latch(at(7));
    p.in.latch(at(7));
    CHECK(p.in.take().tm == -0.5);
    CHECK(p.in.take().tm == 0.07);
    p.out.write(3);
    p.out.stamp(0.075);
    p.out.latch(at(8));
    CHECK(p.out.tm() == 0.075);
    CHECK(p.out.latched_tick() == 8);
    for (std::int64_t tick = 9; tick < 13; ++tick) {  // in whatever slot it is written
        p.out.write(4);
        p.out.latch(at(tick));
        CHECK(p.out.tm() == Approx(0.01 * static_cast<double>(tick)));
    }
}

TEST_CASE("a port is stale after three periods of its sender, at least 0.1 s, and else after 0.5 s", "[engine][port]") {
    for (const auto& [rate, limit] : {std::pair{0.0, 0.5}, {10.0, 0.3}, {100.0, 0.1}, {1.0, 3.0}}) {
        INFO(rate << " Hz");
        Pair p;
        p.out.set_rate(rate);
        CHECK(p.in.is_stale(0));  // nothing has come
        CHECK(p.out.is_stale(0));
        p.pass(100, {1});
        for (const bool in : {false, true}) {
            const auto stale = [&](double now) { return in ? p.in.is_stale(now) : p.out.is_stale(now); };
            CHECK_FALSE(stale(1.0 + limit));
            CHECK(stale(1.0 + limit + 0.001));
        }
        p.in.disconnect(p.out);
        CHECK(p.in.is_stale(1));
    }
    // What is held or injected keeps a port fresh that nobody is connected to.
    InPort<std::int32_t> alone{"alone"};
    alone.hold(std::int32_t{3});
    alone.latch({.tick = 100, .seconds = 1});
    CHECK_FALSE(alone.is_stale(1.5));
    CHECK(alone.is_stale(1.501));
    alone.release();
    alone.inject(std::int32_t{4});
    alone.latch({.tick = 200, .seconds = 2});
    CHECK_FALSE(alone.is_stale(2.5));
    // Of several senders the slowest counts.
    OutPort<std::int32_t> fast{"fast"}, slow{"slow"};
    fast.set_rate(100);
    slow.set_rate(5);
    InPort<std::int32_t> in{"in"};
    in.connect(fast);
    in.connect(slow);
    CHECK(in.stale_after() == Approx(0.6));
}

TEST_CASE("an in-port receives only messages that a source publishes after it was connected", "[engine][port]") {
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

TEST_CASE("values that were written and discarded are never published", "[engine][port]") {
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
    tone.set_safe(std::nullopt);
    CHECK_FALSE(tone.has_safe());
    const Value slow = Velocity2D{.vx = 0.1};
    velocity.set_safe(slow);
    velocity.write_safe();
    velocity.latch(at(3));
    CHECK(velocity.read() == Velocity2D{.vx = 0.1});
    velocity.set_safe(default_safe(*velocity.type()));
    velocity.write_safe();
    velocity.latch(at(4));
    CHECK(velocity.read() == Velocity2D{});
}

TEST_CASE("a cleared in-port is as before the first message", "[engine][port]") {
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
