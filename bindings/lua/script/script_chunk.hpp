// The text of a script or a module as code: compiled once for all components that run it, and refused for its slips.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bindings/lua/sandbox/compile.hpp"
#include "engine/base/error.hpp"
#include "engine/base/mutex.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// What a text is for: modules can't define callbacks.
enum class ScriptKind { component, module };

/// `config.NAME` in a text. Whether there is such a parameter is known when the text has declared its own.
struct ParameterUse {
    std::string name;
    int line = 0;
    int column = 0;
};

/// A text as code.
struct ScriptCode {
    Chunk chunk;
    std::vector<ParameterUse> parameters;  ///< in order of place
};

/// Compiles a text; or all that is wrong with it, in order of place.
tl::expected<ScriptCode, std::vector<Error>> compile_script(const SourceText& source, ScriptKind kind);

/// Remembers the newest code of every file. May be used from several threads.
class ChunkCache {
public:
    /// The code of this text, or the first thing that is wrong with it.
    Expected<ScriptCode> compile(const SourceText& source, ScriptKind kind);
    /// Takes all that another one remembers.
    void take(ChunkCache& other);
    /// The text of this file, "" when it is another one by now.
    std::string text_of(const ScriptFile& file) const;

private:
    struct Entry {
        std::string text;
        ScriptCode code;
    };

    mutable Mutex mutex_;
    std::map<std::string, Entry> entries_;  // by path, name shown and kind
};

}  // namespace nezumi
