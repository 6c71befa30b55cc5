// The texts of the mouse's driver, and invalid texts.
#include "hw/raspimouse/codec.hpp"

#include <catch2/catch.hpp>

using namespace nezumi::hw;

TEST_CASE("the light sensors' four numbers are read in their order, a little below zero as well", "[hw][mouse]") {
    CHECK(decode_lights("12 -2 0 4095\n") == LightValues{12, -2, 0, 4095});
    for (const char* wrong : {"", "\n", "1 2 3\n", "1 2 3 4", "1 2 3 4 5\n", "1,2,3,4\n", "1 2 3 x\n", "1 2 3 4\n\n",
                              " 1 2 3 4\n", "1 2 3 99999999999\n"}) {
        INFO(wrong);
        CHECK_FALSE(decode_lights(wrong));
    }
}

TEST_CASE("a switch with the value 0 is pressed", "[hw][mouse]") {
    CHECK(decode_switch("0\n") == true);
    CHECK(decode_switch("1\n") == false);
    for (const char* wrong : {"", "2\n", "0", "00 \n", "on\n"}) {
        INFO(wrong);
        CHECK_FALSE(decode_switch(wrong));
    }
}

TEST_CASE("a counter's number is taken modulo 65536, signed or not", "[hw][mouse]") {
    CHECK(decode_counter("0\n") == 0);
    CHECK(decode_counter("65535\n") == 65535);
    CHECK(decode_counter("-1\n") == 65535);
    for (const char* wrong : {"", "65536\n", "-32769\n", "12", "1 2\n", "1.0\n"}) {
        INFO(wrong);
        CHECK_FALSE(decode_counter(wrong));
    }
}

TEST_CASE("numbers go to the driver as digits and a sign, because it refuses everything else", "[hw][mouse]") {
    CHECK(encode_number(-400) == "-400");
    CHECK(encode_number(0) == "0");
    CHECK(encode_switch(true) == "1");
    CHECK(encode_switch(false) == "0");
}
