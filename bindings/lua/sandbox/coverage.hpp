// Notes which lines and branches of behaviours and modules run.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <lua.hpp>
#include <string>
#include <vector>

#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/syntax/line_marks.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// A line with a statement, and whether it has run.
struct CoveredLine {
    std::int32_t line = 0;
    bool ran = false;

    bool operator==(const CoveredLine&) const = default;
};

/// One way out of a branch, and whether it was taken: way 0 enters the block of an `if` or of a loop, way 1 does not.
struct CoveredBranch {
    std::int32_t line = 0;
    std::int32_t number = 0;  ///< of the branch in its line, from 0
    std::int32_t way = 0;
    bool ran = false;

    bool operator==(const CoveredBranch&) const = default;
};

struct FileCoverage {
    std::string file;                       ///< its path in its project: "behaviors/explorer.lua"
    std::uint64_t hash = 0;                 ///< of its text
    std::vector<CoveredLine> lines{};       ///< in order, each once
    std::vector<CoveredBranch> branches{};  ///< in order of line

    bool operator==(const FileCoverage&) const = default;
};

/// The coverage of one run. Its scripts are loaded and run by one thread.
class Coverage {
public:
    /// A text with its marks.
    struct Source {
        std::string file;
        std::uint64_t hash = 0;
        MarkedText marked;
        std::vector<bool> ran;  ///< by mark
    };

    /// Only files below the root of this project are measured.
    explicit Coverage(const std::filesystem::path& root);
    Coverage(const Coverage&) = delete;
    Coverage& operator=(const Coverage&) = delete;

    /// Replaces the code of a text by the same code with marks. Returns null, and leaves the code as it is, if the text
    /// is not measured: it belongs to another project, differs from its file, or can't be marked.
    Source* mark(const SourceText& source, Chunk& chunk);

    /// Makes the table of the marks of a source and pushes it. May raise a Lua error.
    static void push_marks(lua_State* lua, Source& source);

    /// The owner of a Lua state calls `add` for it, and `remove` before the state is closed.
    void add(const LuaState& state) { states_.push_back(&state); }
    void remove(const LuaState& state);

    /// What has run so far, in the order in which files were loaded.
    std::vector<FileCoverage> take();

private:
    Source* find(const SourceText& source);
    void collect(const LuaState& state);

    std::filesystem::path root_;
    std::deque<Source> sources_;  // addresses are keys of registries
    std::vector<const LuaState*> states_;
};

}  // namespace nezumi
