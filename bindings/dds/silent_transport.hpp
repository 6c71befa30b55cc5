// A participant without others: for systems that are checked, tested in scenarios or replayed.
#pragma once

#include <memory>

#include "bindings/dds/transport.hpp"

namespace nezumi::dds {

/// Nothing is sent, and nothing is received.
std::unique_ptr<DdsTransport> make_silent_transport();

}  // namespace nezumi::dds
