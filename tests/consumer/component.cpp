// A program of another project that needs only messages and ports.
#include <cstdio>

#include "engine/ports/port.hpp"

int main() {
    nezumi::OutPort<nezumi::Velocity2D> target{"out"};
    target.write({.vx = 0.2});
    target.latch({});
    std::printf("%s is a %s\n", target.name().c_str(), std::string(target.type_name()).c_str());
    return target.read().vx == 0.2 ? 0 : 1;
}
