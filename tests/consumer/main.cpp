// Somebody else's program: finds the installed headers and links the installed engine.
#include <cstdio>

#include "engine/error.hpp"

int main() {
    const nezumi::Error error{"unknown port 'ir_sensor'" + nezumi::did_you_mean("ir_sensor", {"ir_sensors", "led"})};
    std::puts(nezumi::describe(error).c_str());
    return nezumi::describe(error) == "unknown port 'ir_sensor' (did you mean 'ir_sensors'?)" ? 0 : 1;
}
