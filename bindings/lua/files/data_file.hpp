// Runs Lua files that describe data (systems, robots), each in its own sandbox, with `require` for modules of the
// project.
#pragma once

#include <cstdint>
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
#include "bindings/lua/sandbox/coverage.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "engine/base/error.hpp"
#include "engine/project/project.hpp"

namespace nezumi {

struct DataFileOptions {
    Budget budget{2.0};                           ///< of CPU time, for the file and all modules that it requires
    std::uint64_t seed = 0;                       ///< of `math.random`
    std::function<void(std::string_view)> print;  ///< gets the output of `print`, a line at a time; may be empty
    Coverage* coverage = nullptr;                 ///< of required modules; may be null, must outlive the file
};

/// Makes one short line without control characters of a message that may contain text from a file.
std::string one_line(std::string text);

/// The location in Lua code from which the running C function was called; without a file if there is none. Raises no
/// Lua error.
Place calling_place(lua_State* lua);

class DataFile {
public:
    /// A global function for a file. Its first upvalue is a light userdata that points to `self`, the second its index
    /// among the globals.
    struct Global {
        std::string_view name;
        lua_CFunction function;
        void* self;
    };

    ~DataFile();
    DataFile(const DataFile&) = delete;
    DataFile& operator=(const DataFile&) = delete;

    /// `project` must outlive this object.
    static Expected<std::unique_ptr<DataFile>> create(const Project& project, DataFileOptions options);

    /// Runs the text of a file, which can use the sandbox's library, these globals and `require`. `shown` is the file's
    /// name in messages. Afterwards the first result of the file is on top of the Lua stack. If `fail` was called, its
    /// error is returned and no other one.
    Expected<void> run(std::string_view text, const std::string& shown, const std::vector<Global>& globals);

    /// All mistakes of a run that failed: one error for each unknown global, otherwise the first error.
    const std::vector<Error>& errors() const { return errors_; }

    /// For an error in one of the global functions: stores the first such error, and returns `error` for raising it in
    /// Lua. The run fails even if the file catches the Lua error.
    Error fail(Error error);

    /// The text of a file that was run or required; null for other files.
    const FileSource* source(const std::string& shown) const;
    /// The files that were run or required, as the project shows them.
    const std::vector<std::string>& files() const { return files_; }
    lua_State* lua() const { return state_->lua(); }
    const Budget& budget() const { return options_.budget; }
    /// The error for a Lua error, with the name of the file if Lua knows no location.
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
    std::optional<Error> error_;  // an error in a function, or in a file that can't be compiled
    std::vector<Error> errors_;
    std::map<std::string, FileSource> sources_;
    std::vector<std::string> files_;
    std::set<std::string> loading_;        // modules that are being loaded
    std::set<std::string> loaded_;         // modules whose results are in a table in the registry
    std::string module_;                   // the module that `find_module` found, as it is shown
    Chunk chunk_;                          // the code of `module_`
    Coverage::Source* covered_ = nullptr;  // gets the coverage marks of `chunk_`
    std::unique_ptr<LuaState> state_;
};

}  // namespace nezumi
