// The browser's end of a connection to the console server. In a page both ends are in memory (bindings/wasm).
#pragma once

#include <string>

#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"

namespace nezumi::web {

/// Sends all of a line, without waiting. False: nothing was sent, because too much waits. An error: only a part was
/// sent, or the other end is gone, so the connection is of no more use.
Expected<bool> send_line(const Descriptor& socket, const std::string& line);
/// What has come, a limited amount of it.
std::string take_some(const Descriptor& socket);

}  // namespace nezumi::web
