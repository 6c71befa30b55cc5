// What Tab offers: names, ports, fields, parameters and commands of the system that runs.
#include <catch2/catch.hpp>

#include "bindings/console/command_offers.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

TEST_CASE("the record of every command's table is described", "[console][completion]") {
    for (const ConsoleCommand& command : console_commands()) {
        if (command.table.record.empty()) continue;
        TextAtCursor call;
        call.word = command.name;
        call.argument = command.table.from;
        INFO(command.name);
        CHECK_FALSE(fields_of_table(call).empty());
    }
}
