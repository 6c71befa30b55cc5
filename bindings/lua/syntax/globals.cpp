// Checks each name that is not a local variable.
#include "bindings/lua/syntax/globals.hpp"

#include <algorithm>
#include <optional>

#include "engine/base/list.hpp"

namespace nezumi {
namespace {

constexpr std::string_view environment = "_ENV";

template <class Named>
const Named* find(const std::vector<Named>& list, std::string_view name) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const Named& each) { return each.name == name; });
    return found != list.end() ? &*found : nullptr;
}

std::string in_quotes(std::string_view name) { return "'" + std::string(name) + "'"; }

// The local variables that are visible at a token, sorted, so that the hint is the same in every run.
std::vector<std::string_view> locals_at(const SyntaxTree& tree, const Token* token) {
    std::vector<std::string_view> names;
    for (const LocalName& local : tree.locals()) {
        if (local.from <= token && token < local.to) names.push_back(local.name);
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

// The error of a use, or nothing.
std::string complaint(const SyntaxTree& tree, const GlobalUse& use, const KnownGlobals& known) {
    const std::string_view name = use.name();
    if (name == environment) return "'_ENV' can't be used: write the names of globals directly";
    if (contains(known.callbacks, name)) {
        if (!known.is_module) return {};
        return in_quotes(name) + " can't be used in a module: callbacks belong in the component's own file";
    }
    if (contains(known.readable, name)) {
        if (!use.assigned) return {};
        return in_quotes(name) + " can't be assigned: it is predefined (write 'local " + std::string(name) +
               "' for a variable of that name)";
    }
    const bool has_callbacks = !known.callbacks.empty() && !known.is_module;
    if (name.starts_with("on_") && has_callbacks) {
        std::string hint = did_you_mean(name, known.callbacks);
        if (!hint.empty()) return "unknown callback " + in_quotes(name) + hint;
        for (const std::string_view callback : known.callbacks) {
            hint += (hint.empty() ? "" : ", ") + std::string(callback);
        }
        return "unknown callback " + in_quotes(name) + " (there are " + hint + ")";
    }
    if (const Instead* const instead = find(known.instead, name))
        return "unknown global " + in_quotes(name) + ": " + std::string(instead->hint);
    std::vector<std::string_view> candidates = locals_at(tree, use.node->first);
    candidates.insert(candidates.end(), known.readable.begin(), known.readable.end());
    if (has_callbacks) candidates.insert(candidates.end(), known.callbacks.begin(), known.callbacks.end());
    std::string hint = did_you_mean(name, candidates);
    if (hint.empty() && use.assigned) hint = " (declare it first: local " + std::string(name) + ")";
    return "unknown global " + in_quotes(name) + hint;
}

// The error for an unknown field of a library: `math.flor`. Assignments have another error.
std::optional<Error> field_complaint(const GlobalUse& use, const KnownGlobals& known) {
    const KnownLibrary* const library = find(known.libraries, use.name());
    const auto field = field_of(*use.node);
    if (library == nullptr || !field || is_assigned(*use.node->parent)) return std::nullopt;
    const std::vector<std::string_view> fields(library->fields.begin(), library->fields.end());
    if (contains(fields, field->name)) return std::nullopt;
    const std::string whole = library->name + "." + shown(field->name);
    Error error{"unknown field " + in_quotes(whole), {{}, field->place->line, field->place->column}};
    if (const Instead* const instead = find(known.instead, whole)) {
        error.message += ": " + std::string(instead->hint);
    } else if (const std::string_view near = nearest(field->name, fields); !near.empty()) {
        error.message += " (did you mean '" + library->name + "." + std::string(near) + "'?)";
    }
    return error;
}

}  // namespace

std::vector<GlobalUse> global_uses(const SyntaxTree& tree) {
    std::vector<GlobalUse> uses;
    for (const SyntaxNode& node : tree.nodes()) {
        const bool is_name = node.is(SyntaxNode::Kind::name);
        const bool is_environment =
            node.word_text() == environment && (is_name || node.is(SyntaxNode::Kind::declaration));
        if ((is_name && node.variable == nullptr) || is_environment) uses.push_back({&node, is_assigned(node)});
    }
    return uses;
}

std::vector<Error> check_globals(const SyntaxTree& tree, const std::string& file, const KnownGlobals& known) {
    constexpr std::size_t most = 1000;
    std::vector<Error> errors;
    for (const GlobalUse& use : global_uses(tree)) {
        if (errors.size() >= most) break;
        std::string text = complaint(tree, use, known);
        if (!text.empty()) {
            errors.push_back({std::move(text), {file, use.node->first->line, use.node->first->column}});
        } else if (auto error = field_complaint(use, known)) {
            error->place.file = file;
            errors.push_back(std::move(*error));
        }
    }
    return errors;
}

}  // namespace nezumi
