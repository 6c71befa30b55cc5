// Checks anything as a text of Lua, as an editor has it done: a behaviour, a module, scenarios, whatever its words say.
// Each slip is one line with a place.
#include <cstdint>
#include <string>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "bindings/cli/files/lua_kind.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const LiveOptions options = [] {
        LiveOptions made;
        made.scripts = &lua_scripts();
        made.peer_words = cli::peer_words();
        made.installed = {"."};
        return made;
    }();
    const std::string text(reinterpret_cast<const char*>(data), size);
    // Systems and robots have fuzzers of their own.
    for (const char* const file : {"behaviors/any.lua", "tests/scenarios/any_test.lua"}) {
        const cli::LuaKind kind = cli::kind_of_file(file, text);
        if (kind == cli::LuaKind::system || kind == cli::LuaKind::robot) continue;
        for (const Error& error : cli::check_text(text, file, options)) check(error);
    }
    return 0;
}
