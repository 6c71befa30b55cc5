// Detects hosts in the same domain that can't communicate with this one because of another secret.
#pragma once

#include <string>

#include "bindings/dds/transport.hpp"

namespace nezumi::dds {

class Strangers {
public:
    /// `sealed`: this host encrypts its messages. The transport must outlive it.
    Strangers(DdsTransport& transport, bool sealed) : transport_(transport), sealed_(sealed) {}

    /// Returns a message about such hosts once, otherwise "". `now` [s]: of a monotonic clock.
    std::string look(double now);

private:
    DdsTransport& transport_;
    const bool sealed_;
    double next_ = 0;  // [s] by the clock: the next check
    bool told_ = false;
};

}  // namespace nezumi::dds
