// The browser's end of a connection to the console server. In a page both ends are in memory (bindings/wasm).
#pragma once

#include <string>

#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"

namespace nezumi::web {

/// Sends a whole line, without waiting. False: nothing was sent, because too many bytes wait. An error: only a part was
/// sent, or the other end is gone; then close the connection.
Expected<bool> send_line(const Descriptor& socket, const std::string& line);
/// Returns the bytes that have arrived, up to a limit; "" if there are none.
std::string take_some(const Descriptor& socket);

}  // namespace nezumi::web
