// A place in a domain where nobody else is: for systems that are checked, tried in scenarios or replayed.
#pragma once

#include <memory>

#include "bindings/dds/transport.hpp"

namespace nezumi::dds {

/// Nothing is sent, and nothing comes.
std::unique_ptr<DdsTransport> make_silent_transport();

}  // namespace nezumi::dds
