// Which movers are solved together, and when an island is too large.
#include "sim/islands.hpp"

#include <catch2/catch.hpp>

using nezumi::sim::Islands;

namespace {

// A chain of movers, each linked to the next.
Islands chain(unsigned length, unsigned beside = 0) {
    Islands islands;
    for (unsigned i = 0; i < length + beside; ++i) islands.add_mover();
    for (unsigned i = 0; i + 1 < length; ++i) islands.link(i, i + 1);
    return islands;
}

}  // namespace

TEST_CASE("an island is large if it has more than 45 equations, 8 of them for each mover on the floor",
          "[sim][islands]") {
    Islands islands = chain(5);  // 40
    islands.add_equations(4, 5);
    CHECK_FALSE(islands.find_large());
    islands.add_equations(0, 1);
    CHECK(islands.find_large());
    for (const unsigned i : {0u, 1u, 2u, 3u, 4u}) CHECK(islands.is_large(i));
}

TEST_CASE("islands are separate, and a mover without contact is in no island", "[sim][islands]") {
    Islands islands = chain(6, 4);  // 48 equations, and beside them:
    islands.link(8, 6);
    islands.add_equations(9, 300);
    REQUIRE(islands.find_large());
    for (const unsigned i : {0u, 3u, 5u}) CHECK(islands.is_large(i));
    for (const unsigned i : {6u, 7u, 8u, 9u}) CHECK_FALSE(islands.is_large(i));
}

TEST_CASE("one mover with very many contacts is a large island", "[sim][islands]") {
    Islands islands = chain(2, 2);
    islands.add_equations(3, 300);
    CHECK_FALSE(islands.find_large());
    islands.add_equations(3, 1);
    REQUIRE(islands.find_large());
    CHECK(islands.is_large(3));
    for (const unsigned i : {0u, 1u, 2u}) CHECK_FALSE(islands.is_large(i));
    islands.clear();
    CHECK_FALSE(islands.find_large());
}

TEST_CASE("two islands become one when their movers touch, in any order", "[sim][islands]") {
    Islands islands = chain(3, 3);
    islands.link(5, 4);
    islands.link(4, 3);
    CHECK_FALSE(islands.find_large());
    islands.link(5, 0);
    CHECK(islands.find_large());
    CHECK(islands.is_large(4));
}

TEST_CASE("a new step begins without contacts", "[sim][islands]") {
    Islands islands = chain(3);
    islands.add_equations(1, 100);
    REQUIRE(islands.find_large());
    islands.clear();
    CHECK_FALSE(islands.find_large());
    islands.link(1, 2);
    CHECK_FALSE(islands.find_large());
}
