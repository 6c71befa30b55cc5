// Reads whatever a script could write as a message of every type: what is taken comes back the same, or an error says
// why not.
#include <cstdint>
#include <string>
#include <string_view>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/ports/payload.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

namespace {

constexpr Budget budget{0.02};

// Reads the value on top of the stack as a message of this type, and writes what was read.
void check(lua_State* lua, const MessageType* type) {
    const int top = lua_gettop(lua);
    const auto read = read_payload(lua, top, type);
    require(lua_gettop(lua) == top);
    if (!read) {
        require_line(read.error().message);
        return;
    }
    require(message_of(read->type()) == type && is_finite(*read));
    const auto pushed = protect(lua, budget, [&](lua_State* inside) {
        push_payload(inside, *read);
        return 1;
    });
    if (!pushed) return;  // out of memory
    const auto again = read_payload(lua, lua_gettop(lua), type);
    require(again.has_value() && *again == *read);
    lua_settop(lua, top);
}

}  // namespace

// The input is a Lua chunk; what it returns is the message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto chunk = compile(text, "message.lua");
    if (!chunk) return 0;
    const auto state = create_sandbox({.memory_limit = std::size_t{4} << 20});
    require(state.has_value());
    lua_State* lua = (*state)->lua();
    if (!load_chunk(lua, *chunk) || !protected_call(lua, 0, 1, budget)) return 0;
    for (const MessageType& type : compiled_message_types()) check(lua, &type);
    return 0;
}
