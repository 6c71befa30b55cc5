// Queues of in-ports: what waits in them, and what they drop.
#include "tests/unit/engine/port_pair.hpp"

#include <string>

using namespace nezumi;

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

TEST_CASE("a queue that gets another length keeps the newest of what is unread", "[engine][port]") {
    Pair p(4);
    p.pass(1, {1, 2, 3});
    const auto dropped = p.in.set_queue(2);
    REQUIRE(dropped.size() == 1);
    CHECK(dropped[0].data.get<std::int32_t>() == 1);
    CHECK(dropped[0].tm == Approx(p.in.tm()));
    CHECK(p.in.dropped() == 1);
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

TEST_CASE("messages that a shorter queue dropped are put back before the unread ones, as far as there is room",
          "[engine][port]") {
    const int later = GENERATE(0, 1);
    Pair p(4);
    p.pass(1, {1, 2, 3, 4});
    auto dropped = p.in.set_queue(1);
    CHECK(p.in.dropped() == 3);
    p.in.set_queue(4);
    if (later > 0) p.pass(2, {5});
    p.in.put_back(std::move(dropped));
    CHECK(p.in.dropped() == static_cast<std::uint64_t>(later));
    CHECK(p.read_all() == (later > 0 ? Values{2, 3, 4, 5} : Values{1, 2, 3, 4}));
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
