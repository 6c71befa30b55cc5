// Values that take the place of what ports carry: injected, held, dropped, frozen.
#include "tests/unit/engine/port_pair.hpp"

#include <string>

using namespace nezumi;

TEST_CASE("an injected or held value replaces the published one", "[engine][port]") {
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

TEST_CASE("an injected value arrives once, after the messages of the connections", "[engine][port]") {
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

TEST_CASE("a dropped in-port gets nothing, and the messages of that time are lost", "[engine][port]") {
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
