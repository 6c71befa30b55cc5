// Hosts of the same domain that neither hear this one nor are heard, as they have another secret.
#pragma once

#include <string>

#include "bindings/dds/transport.hpp"

namespace nezumi::dds {

class Strangers {
public:
    /// `sealed`: messages of this host are. The transport must outlive it.
    Strangers(DdsTransport& transport, bool sealed) : transport_(transport), sealed_(sealed) {}

    /// What is to be said of them, once; "" else. `now` [s]: of a clock that never goes backwards.
    std::string look(double now);

private:
    DdsTransport& transport_;
    const bool sealed_;
    double next_ = 0;  // [s] by the clock: when to look again
    bool told_ = false;
};

}  // namespace nezumi::dds
