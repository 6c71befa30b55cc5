// The one main function of all unit tests; Catch2's own code, compiled once where it is a header.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

int main(int argc, char** argv) { return Catch::Session().run(argc, argv); }
