// What comes from RTCs: decoded, bounded, and answered in time.
#include <catch2/catch.hpp>
#include <chrono>
#include <limits>
#include <thread>

#include "bindings/openrtm/inbox.hpp"
#include "engine/ports/payload.hpp"
#include "engine/values/cdr.hpp"
#include "tests/unit/openrtm/samples.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;

namespace {

using namespace std::chrono_literals;

std::vector<std::uint8_t> bytes_of(const Value& value, std::endian order = std::endian::little) {
    std::vector<std::uint8_t> bytes;
    write_cdr_message(bytes, value, 1.5, {.order = order});
    return bytes;
}

struct InboxRig {
    explicit InboxRig(const MessageType* type) { open_to(type); }
    void open_to(const MessageType* type) {
        auto other = make_in_port(type, "in", "", 0);
        inbox.open_to({{"c.in", other.get()}});
        port = std::move(other);
    }
    std::unique_ptr<InPortBase> port;
    PutAnswer put(const std::vector<std::uint8_t>& bytes, std::endian order = std::endian::little) {
        return inbox.put("c.in", "peer", bytes, order, problem);
    }
    Inbox inbox;
    std::string problem;
};

}  // namespace

TEST_CASE("a message of every type arrives as it was sent, in both byte orders", "[openrtm][inbox]") {
    for (const Value& sample : samples()) {
        for (const std::endian order : {std::endian::little, std::endian::big}) {
            CAPTURE(message_name(sample.type()), order == std::endian::little);
            InboxRig rig(message_of(sample.type()));
            CHECK(rig.put(bytes_of(sample, order), order) == PutAnswer::taken);
            const auto arrivals = rig.inbox.take();
            REQUIRE(arrivals.size() == 1);
            CHECK(arrivals[0].path == "c.in");
            CHECK(arrivals[0].from == "peer");
            CHECK(arrivals[0].value == sample);
            CHECK(rig.inbox.take().empty());
        }
    }
}

TEST_CASE("a malformed message is refused and counted", "[openrtm][inbox]") {
    for (const Value& sample : samples()) {
        CAPTURE(message_name(sample.type()));
        InboxRig rig(message_of(sample.type()));
        auto bytes = bytes_of(sample);
        bytes.pop_back();
        CHECK(rig.put(bytes) == PutAnswer::malformed);
        CHECK(rig.put({}) == PutAnswer::malformed);
        CHECK_FALSE(rig.problem.empty());
        CHECK(rig.inbox.malformed() == 2);
        CHECK(rig.inbox.take().empty());
    }
    InboxRig rig(message_of<Velocity2D>());
    CHECK(rig.put(bytes_of(Velocity2D{.vx = std::numeric_limits<double>::quiet_NaN()})) == PutAnswer::malformed);
    CHECK(rig.problem == "expected finite numbers");
}

TEST_CASE("messages of a port that is not read wait, and the oldest are dropped", "[openrtm][inbox]") {
    InboxRig rig(message_of<std::int32_t>());
    const int sent = static_cast<int>(Inbox::most_waiting) + 10;
    for (int i = 0; i < sent; ++i) CHECK(rig.put(bytes_of(std::int32_t{i})) == PutAnswer::taken);
    const auto arrivals = rig.inbox.take();
    REQUIRE(arrivals.size() == Inbox::most_waiting);
    CHECK(arrivals.front().value == Value(std::int32_t{10}));
    CHECK(arrivals.back().value == Value(std::int32_t{sent - 1}));
    CHECK(rig.inbox.dropped() == 10);
}

TEST_CASE("the size of waiting pictures is limited", "[openrtm][inbox]") {
    InboxRig rig(message_of<CameraImage>());
    const CameraImage picture{.width = 1000, .height = 1000, .bpp = 24, .format = "rgb8", .pixels = Octets(3'000'000)};
    const auto bytes = bytes_of(picture);
    for (int i = 0; i < 20; ++i) CHECK(rig.put(bytes) == PutAnswer::taken);
    const auto arrivals = rig.inbox.take();
    CHECK(arrivals.size() == Inbox::most_bytes / 3'000'000);
    CHECK(rig.inbox.dropped() == 20 - arrivals.size());
}

TEST_CASE("names of connections count as waiting bytes", "[openrtm][inbox]") {
    InboxRig rig(message_of<std::int32_t>());
    const std::string name(Inbox::most_bytes / 4, 'x');
    for (int i = 0; i < 8; ++i)
        CHECK(rig.inbox.put("c.in", name, bytes_of(std::int32_t{i}), std::endian::little, rig.problem) ==
              PutAnswer::taken);
    CHECK(rig.inbox.take().size() == 3);
}

TEST_CASE("a port that is not open accepts nothing and loses waiting messages", "[openrtm][inbox]") {
    InboxRig rig(message_of<bool>());
    CHECK(rig.inbox.put("c.other", "peer", bytes_of(true), std::endian::little, rig.problem) == PutAnswer::unknown);
    CHECK(rig.put(bytes_of(true)) == PutAnswer::taken);
    rig.open_to(message_of<bool>());
    CHECK(rig.inbox.take().size() == 1);
    CHECK(rig.put(bytes_of(true)) == PutAnswer::taken);
    rig.open_to(message_of<double>());
    CHECK(rig.inbox.take().empty());
}

TEST_CASE("a sender of velocities that disconnects leaves a zero", "[openrtm][inbox]") {
    InboxRig velocity(message_of<Velocity2D>());
    CHECK(velocity.put(bytes_of(Velocity2D{.vx = 0.2})) == PutAnswer::taken);
    velocity.inbox.put_zero("c.in", "peer");
    const auto arrivals = velocity.inbox.take();
    REQUIRE(arrivals.size() == 1);
    CHECK(arrivals[0].value == Value(Velocity2D{}));
    InboxRig other(message_of<double>());
    other.inbox.put_zero("c.in", "peer");
    CHECK(other.inbox.take().empty());
}

TEST_CASE("of waiting velocities the latest moves the robot, unless it is old", "[openrtm][inbox]") {
    InboxRig rig(message_of<Velocity2D>());
    const auto put_two = [&] {
        for (const double speed : {0.1, 0.2}) CHECK(rig.put(bytes_of(Velocity2D{.vx = speed})) == PutAnswer::taken);
    };
    put_two();
    const auto fresh = rig.inbox.take();
    REQUIRE(fresh.size() == 1);
    CHECK(fresh[0].value == Value(Velocity2D{.vx = 0.2}));
    put_two();
    const auto later = Inbox::Clock::now() + Inbox::longest_wait + 1ms;
    CHECK(rig.inbox.take(later).empty());
    CHECK(rig.inbox.take().empty());
    put_two();
    rig.inbox.put_zero("c.in", "peer");
    CHECK(rig.inbox.take(later + 1s).size() == 1);  // a stop holds
    InboxRig other(message_of<std::int32_t>());
    CHECK(other.put(bytes_of(std::int32_t{7})) == PutAnswer::taken);
    CHECK(other.inbox.take(later + 1s).size() == 1);
}

TEST_CASE("a request gets its answer from the thread that ticks", "[openrtm][inbox]") {
    Inbox inbox;
    RtcAnswer answer = RtcAnswer::busy;
    std::thread asks([&] { answer = inbox.ask({.component = "c"}, 10s); });
    while (!inbox.has_requests()) std::this_thread::yield();
    std::string asked;
    inbox.answer([&](const RtcRequest& request) {
        asked = request.component;
        return RtcAnswer::refused;
    });
    asks.join();
    CHECK(asked == "c");
    CHECK(answer == RtcAnswer::refused);
}

TEST_CASE("a request whose time is over is not executed", "[openrtm][inbox]") {
    Inbox inbox;
    CHECK(inbox.ask({.component = "c"}, 1ms) == RtcAnswer::busy);
    bool done = false;
    inbox.answer([&](const RtcRequest&) {
        done = true;
        return RtcAnswer::done;
    });
    CHECK_FALSE(done);
}
