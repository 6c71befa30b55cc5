// The names that scripts may use, and mistakes that Lua itself accepts.
#include "bindings/lua/script/script_chunk.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "bindings/lua/syntax/array_loops.hpp"
#include "bindings/lua/syntax/globals.hpp"
#include "bindings/lua/syntax/port_reads.hpp"
#include "engine/base/list.hpp"

namespace nezumi {
namespace {

// Globals that a person may expect in a behaviour, beside those of Lua, and their replacements.
constexpr std::string_view of_system_files = "it is for system files, and this is a behaviour";
constexpr std::array instead{
    Instead{"os", "the time is now(); there are no files and no processes"},
    Instead{"io", "`log` writes lines, and `nezumi run --record` records ports"},
    Instead{"debug", "`print` and the console show values"},
    Instead{"sleep", "`wait(seconds)` waits, in a task: task(\"name\", function() ... end)"},
    Instead{"self", "a behaviour has no object: parameters are in `config`, data in `state` and locals"},
    Instead{"arena", of_system_files},
    Instead{"robot", of_system_files},
    Instead{"behavior", of_system_files},
    Instead{"component", of_system_files},
    Instead{"connect", of_system_files},
};

const KnownGlobals& known_globals(ScriptKind kind) {
    static const KnownGlobals components = [] {
        KnownGlobals known = sandbox_globals();
        known.readable.insert(known.readable.end(), script_globals().begin(), script_globals().end());
        known.callbacks = hook_names();
        known.instead.insert(known.instead.end(), instead.begin(), instead.end());
        return known;
    }();
    static const KnownGlobals modules = [] {
        KnownGlobals known = components;
        known.is_module = true;
        return known;
    }();
    return kind == ScriptKind::component ? components : modules;
}

// Finds `local function on_execute` and `local on_execute =`, which are correct Lua but are never called.
void find_local_callbacks(const SyntaxTree& tree, const std::string& file, std::vector<Error>& errors) {
    using Kind = SyntaxNode::Kind;
    const auto& names = hook_names();
    for (const SyntaxNode& node : tree.nodes()) {
        const bool is_local = node.is(Kind::declaration) &&
                              (node.parent->is(Kind::local_function) || node.parent->parent->is(Kind::local));
        if (!is_local || !contains(names, node.word_text())) continue;
        errors.push_back(
            {"'" + std::string(node.word_text()) + "' is local, so it would never be called: leave out `local`",
             {file, node.word->line, node.word->column}});
    }
}

// Each `config.NAME` that the text reads or sets.
std::vector<ParameterUse> parameter_uses(const SyntaxTree& tree) {
    std::vector<ParameterUse> uses;
    for (const GlobalUse& use : global_uses(tree)) {
        const auto field = use.name() == "config" ? field_of(*use.node) : std::nullopt;
        if (field) uses.push_back({std::string(field->name), field->place->line, field->place->column});
    }
    return uses;
}

}  // namespace

tl::expected<ScriptCode, std::vector<Error>> compile_script(const SourceText& source, ScriptKind kind) {
    auto chunk = compile(source.text, source.shown);
    if (!chunk) return tl::unexpected(std::vector<Error>{chunk.error()});
    const SyntaxTree tree(without_preamble(source.text));
    std::vector<Error> errors = check_globals(tree, source.shown, known_globals(kind));
    if (kind == ScriptKind::component) {
        find_local_callbacks(tree, source.shown, errors);
        std::stable_sort(errors.begin(), errors.end(), [](const Error& a, const Error& b) {
            return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
        });
    }
    if (!errors.empty()) return tl::unexpected(std::move(errors));
    ScriptCode code{std::move(*chunk), parameter_uses(tree), {}, {}, {}};
    if (kind == ScriptKind::component) {
        code.in_place = ports_read_in_place(tree);
        TextEdits edits(tree);
        std::vector<FieldWrite> writes = edit_field_writes(tree, edits);
        std::vector<int> doubled_lines = edit_array_loops(tree, edits);
        if (!edits.empty()) {
            // An edited text may exceed a limit of Lua, such as 200 local variables. Then it stays as it is.
            if (auto faster = compile(edits.text(), source.shown)) {
                code.chunk = std::move(*faster);
                code.writes = std::move(writes);
                code.doubled_lines = std::move(doubled_lines);
            }
        }
    }
    return code;
}

Expected<std::shared_ptr<const ScriptCode>> ChunkCache::compile(const SourceText& source, ScriptKind kind) {
    const std::lock_guard lock(mutex_);
    Entry& entry = entries_[source.path + '\n' + source.shown + (kind == ScriptKind::module ? "\nmodule" : "\n")];
    if (entry.code != nullptr && entry.text == source.text) return entry.code;
    auto code = compile_script(source, kind);
    if (!code) return Unexpected(code.error().front());
    if (coverage_ != nullptr) code->covered = coverage_->mark(source, code->chunk);
    entry = {source.text, std::make_shared<const ScriptCode>(std::move(*code))};
    return entry.code;
}

void ChunkCache::take(ChunkCache& other) {
    std::map<std::string, Entry> taken;
    {
        const std::lock_guard lock(other.mutex_);
        taken.swap(other.entries_);
    }
    const std::lock_guard lock(mutex_);
    for (auto& [name, entry] : taken) entries_.insert_or_assign(name, std::move(entry));
}

std::string ChunkCache::text_of(const ScriptFile& file) const {
    const std::lock_guard lock(mutex_);
    for (const char* const kind : {"\n", "\nmodule"}) {
        const auto entry = entries_.find(file.path + '\n' + file.shown + kind);
        if (entry != entries_.end() && ScriptFile({file.path, file.shown, entry->second.text}) == file)
            return entry->second.text;
    }
    return "";
}

}  // namespace nezumi
