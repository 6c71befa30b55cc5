// A timer that does nothing, because a web page has no signals: a hook checks the time limits of calls after a number
// of instructions (watchdog.cpp).
#include "bindings/lua/sandbox/lua_text.hpp"
#include "bindings/lua/sandbox/thread_timer.hpp"

namespace nezumi {

struct ThreadTimer::Watched {};

bool ThreadTimer::restart(Handler /*handler*/) { return true; }
void ThreadTimer::stop() {}
void ThreadTimer::unblock() {}

void find_lua_text() {}
bool was_in_lua(const void* /*context*/) { return false; }

}  // namespace nezumi
