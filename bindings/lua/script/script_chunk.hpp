// Compiles the text of a script or module, once for all its components, and finds mistakes in it.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/coverage.hpp"
#include "bindings/lua/syntax/field_writes.hpp"
#include "engine/base/error.hpp"
#include "engine/base/mutex.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// The purpose of a text: modules can't define callbacks.
enum class ScriptKind { component, module };

/// A use of `config.NAME` in a text. It is checked after the text has declared its parameters.
struct ParameterUse {
    std::string name;
    int line = 0;
    int column = 0;
};

/// A compiled script or module.
struct ScriptCode {
    Chunk chunk;
    std::vector<ParameterUse> parameters;  ///< in order of location
    std::vector<std::string> in_place;     ///< the ports that `ports_read_in_place` finds
    std::vector<FieldWrite> writes;        ///< the calls that write fields without a table
    std::vector<int> doubled_lines;        ///< of loops, for `LuaState::set_doubled_lines`
    Coverage::Source* covered = nullptr;   ///< gets the marks that the main function sets; null: the code has none
};

/// Compiles a text, or returns all its mistakes in order of location.
tl::expected<ScriptCode, std::vector<Error>> compile_script(const SourceText& source, ScriptKind kind);

/// Stores the newest code of every file. Several threads may use it.
class ChunkCache {
public:
    /// With `coverage`, which must outlive this, all code gets marks of executed lines.
    explicit ChunkCache(Coverage* coverage = nullptr) : coverage_(coverage) {}
    Coverage* coverage() const { return coverage_; }

    /// The code of this text, or its first mistake.
    Expected<std::shared_ptr<const ScriptCode>> compile(const SourceText& source, ScriptKind kind);
    /// Takes over all code of another cache.
    void take(ChunkCache& other);
    /// The text of this version of a file; "" if the cache has only another version, or none.
    std::string text_of(const ScriptFile& file) const;

private:
    struct Entry {
        std::string text;
        std::shared_ptr<const ScriptCode> code;
    };

    Coverage* const coverage_;
    mutable Mutex mutex_;
    std::map<std::string, Entry> entries_;  // by path, shown name and kind
};

}  // namespace nezumi
