// The reading side of a stream of bytes that is cut into messages.
#pragma once

#include <memory>

#include "engine/base/descriptor.hpp"
#include "hw/wire/framing.hpp"
#include "hw/wire/wire_driver.hpp"

namespace nezumi::hw {

/// `file`: open, and does not block.
std::unique_ptr<OpenWire> stream_wire(Descriptor file, const Framing& framing);

}  // namespace nezumi::hw
