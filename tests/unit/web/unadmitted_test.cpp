// Connections without a token: which one is closed when another one comes.
#include "bindings/web/unadmitted.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

using namespace nezumi;
using web::Unadmitted;

namespace {

// A connection is identified by its address.
std::vector<char> connections(2 * Unadmitted::most);

}  // namespace

TEST_CASE("the oldest connection of an address with too many is closed", "[web][bounds]") {
    Unadmitted unadmitted;
    std::size_t next = 0;
    CHECK(unadmitted.add(&connections[next++], "192.168.1.9") == nullptr);
    for (std::size_t i = 0; i < Unadmitted::most_of_source; ++i)
        CHECK(unadmitted.add(&connections[next++], "192.168.1.1") == nullptr);
    CHECK(unadmitted.add(&connections[next++], "192.168.1.1") == &connections[1]);
    CHECK(unadmitted.add(&connections[next++], "192.168.1.1") == &connections[2]);
    // A connection that shows its token makes room.
    unadmitted.remove(&connections[3]);
    CHECK(unadmitted.add(&connections[next++], "192.168.1.1") == nullptr);
    CHECK(unadmitted.add(&connections[next++], "192.168.1.1") == &connections[4]);
}

TEST_CASE("with too many connections in all, the oldest of the address with most is closed", "[web][bounds]") {
    Unadmitted unadmitted;
    std::size_t next = 0;
    for (int i = 0; i < 10; ++i) CHECK(unadmitted.add(&connections[next++], "192.168.1.1") == nullptr);
    const std::size_t first_of_most = next;
    for (int i = 0; i < 20; ++i) CHECK(unadmitted.add(&connections[next++], "192.168.1.2") == nullptr);
    for (; next < Unadmitted::most; ++next)
        CHECK(unadmitted.add(&connections[next], "10.0.0." + std::to_string(next)) == nullptr);
    CHECK(unadmitted.add(&connections[next++], "192.168.1.3") == &connections[first_of_most]);
    CHECK(unadmitted.add(&connections[next++], "192.168.1.4") == &connections[first_of_most + 1]);
    unadmitted.remove(&connections[first_of_most]);  // is already removed
    CHECK(unadmitted.add(&connections[next++], "192.168.1.5") == &connections[first_of_most + 2]);
}
