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

TEST_CASE("a message is not copied on its way", "[engine][port]") {
    for (const std::size_t queue : {0u, 2u}) {
        OutPort<std::string> out{"out"};
        InPort<std::string> one{"one"}, other{"other", "", queue};
        one.connect(out);
        other.connect(out);
        for (std::int64_t tick = 1; tick < 5; ++tick) {
            out.write("a text that is too long to be kept in the string itself");
            out.latch(at(tick));
            one.latch(at(tick));
            other.latch(at(tick));
            CHECK(one.latest().data.data() == out.read().data());
            CHECK(other.latest().data.data() == out.read().data());
            CHECK(&one.read() == &out.read());
        }
    }
}

TEST_CASE("what an in-port shows stays until it is latched, whatever its sources do meanwhile", "[engine][port]") {
    const std::string first(100, '1');
    const auto shows = [&](const auto& meanwhile) {
        auto out = std::make_unique<OutPort<std::string>>("out");
        OutPort<std::string> other{"other"};
        InPort<std::string> in{"in"};
        in.connect(*out);
        in.connect(other);
        out->write(first);
        out->latch(at(1));
        in.latch(at(1));
        meanwhile(out, other, in);
        CHECK(in.value() == AnyPayload(first));
        CHECK(in.tm() == 0.01);
        CHECK(in.is_new());
        CHECK(in.read() == first);
    };
    const auto publish = [](OutPort<std::string>& port, std::int64_t tick) {
        port.write(std::string(100, 'x'));
        port.latch(at(tick));
    };
    for (int times = 0; times < 5; ++times) {
        INFO(times << " publications");
        shows([&](auto& out, auto& other, auto&) {
            for (int i = 0; i < times; ++i) {
                publish(*out, 2 + i);
                publish(other, 2 + i);
            }
        });
        shows([&](auto& out, auto&, auto& in) {
            for (int i = 0; i < times; ++i) publish(*out, 2 + i);
            in.disconnect(*out);
            out.reset();
        });
        shows([&](auto& out, auto&, auto& in) {
            in.drop();
            for (int i = 0; i < times; ++i) {
                publish(*out, 2 + i);
                in.latch(at(2 + i));
            }
        });
        shows([&](auto& out, auto&, auto& in) {
            in.set_queue(3);
            for (int i = 0; i < times; ++i) publish(*out, 2 + i);
            in.set_queue(0);
        });
    }
}

TEST_CASE("a source that publishes now and then is looked at for as long", "[engine][port]") {
    OutPort<std::int32_t> often{"often"}, seldom{"seldom"};
    InPort<std::int32_t> in{"in"};
    in.connect(often);
    in.connect(seldom);
    for (std::int32_t tick = 1; tick < 50; ++tick) {
        if (tick % 10 == 0) {
            seldom.write(-tick);
            seldom.latch(at(tick));
        } else if (tick % 10 < 5) {
            often.write(tick);
            often.latch(at(tick));
        }
        in.latch(at(tick));
        const std::int32_t decade = tick - tick % 10;
        CHECK(in.read() == (tick % 10 == 0 ? -tick : tick % 10 < 5 ? tick : decade + 4));
    }
}

TEST_CASE("an injected or held value takes the place of what a source published", "[engine][port]") {
    OutPort<std::string> out{"out"};
    InPort<std::string> in{"in"};
    in.connect(out);
    out.write("from out");
    out.latch(at(1));
    in.inject(std::string("injected"));
    in.latch(at(1));
    CHECK(in.read() == "injected");
    CHECK(out.read() == "from out");
    in.hold(std::string("held"));
    in.latch(at(2));
    CHECK(in.read() == "held");
    in.release();
    out.write("again");
    out.latch(at(3));
    in.latch(at(3));
    CHECK(in.read() == "again");
    in.clear();
    CHECK(in.latest().data.empty());
    CHECK(out.read() == "again");
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
    // Of several senders the slowest counts.
    OutPort<std::int32_t> fast{"fast"}, slow{"slow"};
    fast.set_rate(100);
    slow.set_rate(5);
    InPort<std::int32_t> in{"in"};
    in.connect(fast);
    in.connect(slow);
    CHECK(in.stale_after() == Approx(0.6));
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
