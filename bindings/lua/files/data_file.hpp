// Runs Lua files that say data (systems, robots) in a sandbox of their own, with `require` for the project's modules.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <lua.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/file_source.hpp"
#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "engine/base/error.hpp"
#include "engine/project/project.hpp"

namespace nezumi {

struct DataFileOptions {
    Budget budget{2.0};                           ///< of CPU time, for the file and all that it requires
    std::uint64_t seed = 0;                       ///< of `math.random`
    std::function<void(std::string_view)> print;  ///< takes what `print` was given, a line at a time; may be empty
};

/// A message that quotes what a file says, as one short line that a terminal can show.
std::string one_line(std::string text);

/// The line of Lua code that called the C function which runs now; no file when there is none. Raises no Lua error.
Place calling_place(lua_State* lua);

class DataFile {
public:
    /// A function of such a file, and what its first upvalue, a light userdata, points to. Further upvalues: its place
    /// among the globals.
    struct Global {
        const char* name;
        lua_CFunction function;
        void* self;
    };

    /// `project` must outlive it.
    static Expected<std::unique_ptr<DataFile>> create(const Project& project, DataFileOptions options);

    /// Runs a text with these globals, and `require`, beside the sandbox's library. `shown` names it in messages. Its
    /// first result is then on top of the stack. An error of `fail` comes before any other.
    Expected<void> run(std::string_view text, const std::string& shown, const std::vector<Global>& globals);

    /// All that is wrong after a run that failed; a file that names unknown globals has one error for each.
    const std::vector<Error>& errors() const { return errors_; }

    /// Keeps an error of one of our functions, the first one, with its place, and returns it with the text for Lua. The
    /// run has failed, even if the file catches the Lua error that the function then raises.
    Error fail(Error error);

    /// The text of a file that was run or required; null when it was not.
    const FileSource* source(const std::string& shown) const;
    /// The files that were run or required, as the project shows them.
    const std::vector<std::string>& files() const { return files_; }
    lua_State* lua() const { return state_->lua(); }
    const Budget& budget() const { return options_.budget; }
    /// An error of Lua, with the file's name when Lua knows no place.
    Error to_error(const CallError& error) const;

private:
    enum class Module { known, compiled };

    DataFile(const Project& project, DataFileOptions options);
    Expected<void> try_to_run(std::string_view text, const std::string& shown, const std::vector<Global>& globals);
    Expected<Chunk> compile_file(std::string_view text, const std::string& shown);
    Expected<Module> find_module(lua_State* lua);
    static int require(lua_State* lua);

    const Project& project_;
    DataFileOptions options_;
    KnownGlobals known_;
    std::string shown_;
    std::optional<Error> error_;  // of a function, or of a file that does not compile
    std::vector<Error> errors_;
    std::map<std::string, FileSource> sources_;
    std::vector<std::string> files_;
    std::set<std::string> loading_;  // modules that run now
    std::set<std::string> loaded_;   // modules whose results are in the registry's table
    std::string module_;             // the module that `find_module` found, as it is shown
    Chunk chunk_;                    // and its code
    std::unique_ptr<LuaState> state_;
};

}  // namespace nezumi
