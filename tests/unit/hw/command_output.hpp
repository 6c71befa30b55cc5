// The output of another program, for tests that use fake devices with foreign programs.
#pragma once

#include <catch2/catch.hpp>
#include <cstdio>
#include <string>

/// Runs `command` in a shell and returns its standard output.
inline std::string output_of(const std::string& command) {
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string text;
    char buffer[4096];
    while (const std::size_t length = fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, length);
    pclose(pipe);
    return text;
}
