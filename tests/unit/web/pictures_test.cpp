// Memory for cameras' pictures that are copied in ticks and encoded outside them.
#include <catch2/catch.hpp>

#include <chrono>
#include <memory>
#include <semaphore>

#include "bindings/web/pictures.hpp"
#include "engine/vision/checked_image.hpp"
#include "tests/unit/large_allocations.hpp"

using namespace nezumi;

namespace {

// A picture every tick.
class Eye final : public Component {
public:
    Eye() : Component("eye", "Eye"), out_(add_out_port<CameraImage>("out")), seen_(add_in_port<CameraImage>("seen")) {}

private:
    Expected<void> on_execute() override {
        out_.write({.width = 320, .height = 240, .bpp = 24, .format = "rgb8", .pixels = Octets(320 * 240 * 3, 100)});
        return {};
    }
    OutPort<CameraImage>& out_;
    InPort<CameraImage>& seen_;
};

}  // namespace

TEST_CASE("pictures for browsers use the memory of earlier ones", "[web]") {
    System system({.rate = 100}, {});
    REQUIRE(system.add(std::make_unique<Eye>()));
    REQUIRE(system.connect("eye.out", "eye.seen"));
    REQUIRE(system.find("eye")->activate(system.now()));
    for (const std::string port : {"eye.out", "eye.seen"}) {
        INFO(port);
        std::counting_semaphore encoded{0};
        web::Pictures pictures(
            to_jpeg, [&](const std::string&, const std::string&) { encoded.release(); }, [](const std::string&) {});
        std::size_t count = 0;
        auto now = web::Pictures::Clock::now();
        for (int shown = 0; shown < 6; ++shown) {
            system.tick();
            now += std::chrono::seconds(1);
            const std::size_t before = large_allocations();
            pictures.look(system, {port}, now);
            if (shown >= 2) count += large_allocations() - before;  // one is taken while one is encoded
            REQUIRE(encoded.try_acquire_for(std::chrono::seconds(60)));
        }
        CHECK(count == 0);
    }
}
