// Follows a scenario through the variables of a file: from the function that gets it, to other variables, and into the
// functions that are called with it.
#include "bindings/scenario/method_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

class Scan {
public:
    Scan(std::string_view text, const std::string& shown, const std::vector<std::string_view>& methods)
        : tree_(without_preamble(text)), shown_(shown), methods_(methods) {}

    std::vector<Error> run() {
        for (const SyntaxNode& node : tree_.nodes()) note(node);
        for (const SyntaxNode& node : tree_.nodes()) {
            if (node.is(Kind::call) && node.child->is_global("scenario")) follow(node.last->last, 0);
        }
        while (!scenarios_.empty()) {
            const LocalName* const scenario = scenarios_.back();
            scenarios_.pop_back();
            for (const SyntaxNode* const use : uses_[scenario]) {
                if (is_assigned(*use)) break;  // after this it has another value
                look_at(*use);                 // finds further variables
            }
        }
        std::sort(errors_.begin(), errors_.end(), [](const Error& a, const Error& b) {
            return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
        });
        return std::move(errors_);
    }

private:
    // A variable: a local one, or a global by its name.
    using Variable = std::pair<const LocalName*, std::string_view>;

    static Variable variable(const SyntaxNode& name) { return {name.variable, name.word->text}; }

    // Records the location of each local variable, and the function of each variable. If a variable is assigned several
    // functions, it counts as unknown.
    void note(const SyntaxNode& node) {
        if (node.is(Kind::name) && node.variable != nullptr) uses_[node.variable].push_back(&node);
        if (node.is(Kind::local_function) || node.is(Kind::function_statement)) {
            note_value(*node.child, *node.last);
        } else if ((node.is(Kind::local) || node.is(Kind::assignment)) && node.count() == 2) {
            const SyntaxNode* value = node.last->child;
            for (const SyntaxNode& target : *node.child) {
                if (value != nullptr) note_value(target, *value);
                if (value != nullptr) value = value->next;
            }
        }
    }
    void note_value(const SyntaxNode& target, const SyntaxNode& value) {
        const bool is_variable = target.is(Kind::name) || target.is(Kind::declaration);
        if (!is_variable || target.word == nullptr) return;
        const bool is_function = value.is(Kind::function);
        if (!is_function && !target.is(Kind::name)) return;
        const auto [known, is_new] = functions_.emplace(variable(target), is_function ? &value : nullptr);
        if (!is_new) known->second = nullptr;
    }

    // `given` is a function, or a variable with one: its argument of this number, from 0, is the scenario.
    void follow(const SyntaxNode* given, std::size_t argument) {
        if (given != nullptr && given->is(Kind::name)) {
            const auto found = functions_.find(variable(*given));
            given = found != functions_.end() ? found->second : nullptr;
        }
        if (given == nullptr || !given->is(Kind::function)) return;
        if (const SyntaxNode* const parameter = given->child->at(argument)) add(parameter->variable);
    }
    void add(const LocalName* scenario) {
        if (seen_.insert(scenario).second) scenarios_.push_back(scenario);
    }

    void look_at(const SyntaxNode& use) {
        const SyntaxNode& parent = *use.parent;
        if (parent.is(Kind::method_call) && parent.child == &use) {  // `s:name()`
            check(use, parent.word);
        } else if (parent.is(Kind::expressions) && parent.parent->is(Kind::call)) {  // `help(1, s)`
            std::size_t argument = 0;
            for (const SyntaxNode* each = parent.child; each != &use; each = each->next) ++argument;
            follow(parent.parent->child, argument);
        } else if (parent.is(Kind::expressions) && parent.parent->is(Kind::local) && parent.count() == 1) {
            add(parent.parent->child->child->variable);  // `local w = s`
        }
    }

    void check(const SyntaxNode& object, const Token* method) {
        if (method == nullptr || std::binary_search(methods_.begin(), methods_.end(), method->text)) return;
        errors_.push_back(
            {unknown_method(object.word->text, method->text, methods_), {shown_, method->line, method->column}});
    }

    const SyntaxTree tree_;
    const std::string& shown_;
    const std::vector<std::string_view>& methods_;
    std::map<const LocalName*, std::vector<const SyntaxNode*>> uses_;
    std::map<Variable, const SyntaxNode*> functions_;  // null: not known
    std::vector<const LocalName*> scenarios_;          // that are still to be searched
    std::set<const LocalName*> seen_;
    std::vector<Error> errors_;
};

}  // namespace

std::string unknown_method(std::string_view object, std::string_view name,
                           const std::vector<std::string_view>& methods) {
    const std::string text = fmt::format("{} has no '{}'", object, shown(name));
    if (name == "seed") return text + ": the option seed = N of the scenario gives its runs one, and s.seed reads it";
    return text + did_you_mean(name, methods);
}

DrawingScenarios find_drawing_scenarios(std::string_view text) {
    DrawingScenarios found;
    const SyntaxTree tree(without_preamble(text));
    for (const SyntaxNode& node : tree.nodes()) {
        if (!node.is(Kind::method_call) || node.word_text() != "any") continue;
        const SyntaxNode* call = node.parent;
        while (call != nullptr && !(call->is(Kind::call) && call->child->is_global("scenario"))) call = call->parent;
        // A function outside of all scenarios may be called by any of them.
        if (call == nullptr) {
            found.all = true;
        } else {
            found.lines.insert(call->first->line);
        }
    }
    return found;
}

std::vector<Error> unknown_methods(std::string_view text, const std::string& shown,
                                   const std::vector<std::string_view>& methods) {
    return Scan(text, shown, methods).run();
}

}  // namespace nezumi
