// Ports that come along with a connection.
#include <catch2/catch.hpp>

#include "engine/ports/port.hpp"

using namespace nezumi;

namespace {

// A picture and what explains it, on both sides.
struct CompanionPair {
    CompanionPair() {
        picture.set_companion(intrinsics);
        image.set_companion(told);
    }
    void publish(double fx) {
        picture.write({.width = 1});
        intrinsics.write({.fx = fx});
        const Time now{.tick = ++tick, .seconds = 0.1 * static_cast<double>(tick)};
        for (OutPortBase* port : {static_cast<OutPortBase*>(&picture), static_cast<OutPortBase*>(&intrinsics)})
            port->latch(now);
        for (InPortBase* port : {static_cast<InPortBase*>(&image), static_cast<InPortBase*>(&told)}) port->latch(now);
    }

    OutPort<CameraImage> picture{"out"};
    OutPort<CameraIntrinsics> intrinsics{"intrinsics"};
    InPort<CameraImage> image{"image"};
    InPort<CameraIntrinsics> told{"intrinsics"};
    std::int64_t tick = 0;
};

}  // namespace

TEST_CASE("a connection also connects the companion port", "[engine][port][companion]") {
    CompanionPair p;
    p.image.connect(p.picture);
    CHECK(p.told.sources() == std::vector<const OutPortBase*>{&p.intrinsics});
    p.publish(500);
    CHECK(p.image.read().width == 1);
    CHECK(p.told.read().fx == 500);
}

TEST_CASE("a connection takes its companion along when it goes", "[engine][port][companion]") {
    CompanionPair p;
    p.image.connect(p.picture);
    p.publish(500);
    p.image.disconnect(p.picture);
    CHECK(p.told.sources().empty());
    p.publish(600);
    CHECK(p.told.latest().data.fx == 500);
}

TEST_CASE("a source that is connected twice counts once until both connections are removed",
          "[engine][port][companion]") {
    const bool companion_first = GENERATE(true, false);
    CompanionPair p;
    if (companion_first) p.image.connect(p.picture);
    p.told.connect(p.intrinsics);
    if (!companion_first) p.image.connect(p.picture);
    p.publish(500);
    CHECK(p.told.count() == 1);
    p.image.disconnect(p.picture);
    CHECK(p.told.connected());
    p.image.connect(p.picture);
    p.told.disconnect(p.intrinsics);
    p.publish(600);
    CHECK(p.told.read().fx == 600);
    p.image.disconnect(p.picture);
    CHECK_FALSE(p.told.connected());
}

TEST_CASE("where one side has no companion, or one of another type, only the port itself is connected",
          "[engine][port][companion]") {
    CompanionPair p;
    InPort<CameraImage> plain{"image"};
    plain.connect(p.picture);
    CHECK(plain.sources().size() == 1);
    CHECK(p.told.sources().empty());

    OutPort<CameraImage> bare{"out"};
    p.image.connect(bare);
    CHECK(p.told.sources().empty());

    InPort<double> other{"number"};
    InPort<CameraImage> strange{"image"};
    strange.set_companion(other);
    strange.connect(p.picture);
    CHECK(strange.sources().size() == 1);
    CHECK(other.sources().empty());
}
