// An in-port looks at what its source latched, without copying it: it stays as it is for as long as it is shown.
#include "tests/unit/engine/port_pair.hpp"

#include <string>

using namespace nezumi;

TEST_CASE("a message is not copied on its way from port to port", "[engine][port]") {
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

TEST_CASE("the value of an in-port does not change until it is latched", "[engine][port]") {
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
        CHECK(in.value() == Value(first));
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

TEST_CASE("a source that publishes rarely is read each time", "[engine][port]") {
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
