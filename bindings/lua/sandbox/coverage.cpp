// The registry of each Lua state maps the address of a source to its table of coverage marks.
#include "bindings/lua/sandbox/coverage.hpp"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "engine/base/whole_file.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

FileCoverage result_of(const Coverage::Source& source) {
    FileCoverage file{.file = source.file, .hash = source.hash};
    std::map<int, bool> lines;
    const auto note = [&lines](int line, bool has_run) {
        bool& ran = lines[line];
        ran = ran || has_run;
    };
    for (std::size_t i = 0; i < source.marked.lines.size(); ++i) {
        if (source.marked.lines[i] != 0) note(source.marked.lines[i], source.ran[i]);
    }
    const auto has_run = [&](std::size_t mark) { return source.ran[mark - 1]; };
    std::map<int, std::int32_t> numbers;
    for (const MarkedText::Branch& branch : source.marked.branches) {
        const std::int32_t number = numbers[branch.line]++;
        const bool taken = has_run(branch.taken);
        const bool passed = std::any_of(branch.passed.begin(), branch.passed.end(), has_run);
        file.branches.push_back({branch.line, number, 0, taken});
        if (!branch.passed.empty()) file.branches.push_back({branch.line, number, 1, passed});
        note(branch.line, taken || passed);  // the line of an `elseif` has no mark of its own
    }
    for (const auto& [line, ran] : lines) file.lines.push_back({line, ran});
    std::stable_sort(file.branches.begin(), file.branches.end(),
                     [](const CoveredBranch& a, const CoveredBranch& b) { return a.line < b.line; });
    return file;
}

}  // namespace

Coverage::Coverage(const fs::path& root) {
    std::error_code none;
    root_ = fs::weakly_canonical(root, none);
}

Coverage::Source* Coverage::mark(const SourceText& source, Chunk& chunk) {
    Source* const found = find(source);
    if (found == nullptr || found->marked.text.empty()) return nullptr;
    // Marks may exceed a limit of Lua, such as 200 local variables. Then the text is not measured.
    auto marked = compile(found->marked.text, chunk.file);
    if (!marked) {
        found->marked = {};
        found->ran.clear();
        return nullptr;
    }
    chunk = std::move(*marked);
    return found;
}

Coverage::Source* Coverage::find(const SourceText& source) {
    std::error_code none;
    const fs::path file = fs::weakly_canonical(source.path, none).lexically_relative(root_);
    if (root_.empty() || file.empty() || *file.begin() == "..") return nullptr;
    const std::uint64_t hash = ScriptFile(source).hash;
    const auto same = [&](const Source& each) { return each.hash == hash && each.file == file; };
    if (const auto known = std::find_if(sources_.begin(), sources_.end(), same); known != sources_.end())
        return &*known;
    // A scenario may reload a behaviour from a string instead of its file. Such a text is not measured.
    if (read_whole(source.path, source.path).value_or("") != source.text) return nullptr;
    MarkedText marked = mark_lines(without_preamble(source.text));
    if (marked.text.empty()) return nullptr;
    std::vector<bool> ran(marked.lines.size());
    return &sources_.emplace_back(Source{file.string(), hash, std::move(marked), std::move(ran)});
}

void Coverage::push_marks(lua_State* lua, Source& source) {
    luaL_checkstack(lua, 3, nullptr);
    lua_createtable(lua, static_cast<int>(source.marked.lines.size()), 0);
    lua_pushvalue(lua, -1);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, &source);
}

void Coverage::remove(const LuaState& state) {
    collect(state);
    std::erase(states_, &state);
}

// Collects the marks of a state. Allocates nothing in the state, so raises no Lua error.
void Coverage::collect(const LuaState& state) {
    lua_State* const lua = state.lua();
    if (lua_checkstack(lua, 2) == 0) return;
    for (Source& source : sources_) {
        if (lua_rawgetp(lua, LUA_REGISTRYINDEX, &source) == LUA_TTABLE) {
            for (std::size_t i = 0; i < source.ran.size(); ++i) {
                if (lua_rawgeti(lua, -1, static_cast<lua_Integer>(i + 1)) != LUA_TNIL) source.ran[i] = true;
                lua_pop(lua, 1);
            }
        }
        lua_pop(lua, 1);
    }
}

std::vector<FileCoverage> Coverage::take() {
    for (const LuaState* const state : states_) collect(*state);
    std::vector<FileCoverage> files;
    for (const Source& source : sources_) {
        if (!source.ran.empty()) files.push_back(result_of(source));
    }
    return files;
}

}  // namespace nezumi
