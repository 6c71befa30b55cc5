// Goes through the statements of a function to its decisions, and through `or`, `and`, `not` and parentheses of their
// expressions to the comparisons.
#include "bindings/scenario/condition_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <utility>

#include "engine/base/list.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

std::optional<Comparison::Operator> to_operator(const SyntaxNode& node) {
    if (!node.is(Kind::binary)) return std::nullopt;
    using enum Comparison::Operator;
    for (const auto op : {less, less_equal, greater, greater_equal, equal, unequal}) {
        if (node.word->text == to_text(op)) return op;
    }
    return std::nullopt;
}

bool is_logical(const SyntaxNode& node) {
    return (node.is(Kind::binary) && (node.word->is("and") || node.word->is("or"))) ||
           (node.is(Kind::unary) && node.word->is("not"));
}

// The operands of `a or b or c`; one operand if the operator is another one.
std::vector<const SyntaxNode*> operands(const SyntaxNode& expression, std::string_view op) {
    std::vector<const SyntaxNode*> found;
    const SyntaxNode* node = &expression;
    for (; node->is(Kind::binary) && node->word->is(op); node = node->child) found.push_back(node->last);
    found.push_back(node);
    std::reverse(found.begin(), found.end());
    return found;
}

// The tokens of an expression, with one blank for all blanks, comments and line ends between them.
std::string words(const SyntaxNode& node) {
    std::string out;
    for (const Token* token = node.first; token != node.end; ++token) {
        if (token != node.first && token[-1].text.data() + token[-1].text.size() != token->text.data()) out += ' ';
        out.append(token->text);
    }
    return out;
}

// Whether a literal counts as true.
std::optional<bool> truth_of(const SyntaxNode& node) {
    if (!node.is(Kind::literal) || node.first->is("...")) return std::nullopt;
    return !node.first->is("false") && !node.first->is("nil");
}

// A value that Lua's compiler inserts at each use of a <const> local.
bool is_constant(const SyntaxNode& value) {
    return value.is(Kind::literal) || (value.is(Kind::unary) && value.word->is("-") && value.child->is(Kind::literal));
}

// The literal that a block returns, if `return LITERAL` is its only statement.
std::optional<bool> returned_literal(const SyntaxNode& block) {
    const SyntaxNode* const statement = block.child;
    if (statement == nullptr || statement->next != nullptr || !statement->is(Kind::return_statement))
        return std::nullopt;
    if (statement->child == nullptr || statement->child->count() == 0) return false;
    return statement->child->count() == 1 ? truth_of(*statement->child->child) : std::nullopt;
}

bool contains_return(const SyntaxNode& node) {
    if (node.is(Kind::function)) return false;
    if (node.is(Kind::return_statement)) return true;
    return std::any_of(begin(node), end(node), contains_return);
}

// Whether a function contains only `return EXPRESSION`.
bool only_returns(const SyntaxNode& body) {
    return body.child != nullptr && body.child->next == nullptr && body.child->is(Kind::return_statement) &&
           body.child->count() == 1 && body.child->child->count() == 1;
}

// Finds the comparisons and decisions in a condition. Collects the text replacements for the rewritten source.
class Rewriter {
public:
    Rewriter(const SyntaxTree& tree, const SyntaxNode& function, std::string_view hook)
        : tree_(tree), function_(function), hook_(hook) {
        for (const SyntaxNode& node : tree.nodes()) {
            if (node.is(Kind::name) && node.variable != nullptr && is_assigned(node))
                assigned_.push_back(node.variable);
        }
    }

    void observe() {
        const SyntaxNode& body = *function_.last;
        if (only_returns(body)) {
            const SyntaxNode& expression = *body.child->child->child;
            add(Decision::Kind::result).formula = visit(expression, false);
            observed.returns_only = true;
        } else {
            visit_statements(body);
        }
    }

    // The source of the function, with the replacements.
    std::string text() {
        std::stable_sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) { return a.at < b.at; });
        const std::string_view source = tree_.source();
        std::string out = function_.first->is("function") ? "" : "function";
        std::size_t begin = tree_.offset(*function_.first);
        const std::size_t end = begin + function_.text().size();
        for (const Edit& edit : edits_) {
            out.append(source.substr(begin, edit.at - begin));
            // A blank separates the name of the hook from a word before it.
            const bool joins = edit.text.starts_with(hook_) && !out.empty() &&
                               (std::isalnum(static_cast<unsigned char>(out.back())) != 0 || out.back() == '_');
            out.append(joins ? " " : "").append(edit.text);
            begin = edit.at + edit.replaced;
        }
        return out.append(source.substr(begin, end - begin));
    }

    // Declares the constants of outer functions that Lua does not keep as upvalues.
    std::string constants() const {
        std::string out;
        for (const SyntaxNode& node : tree_.nodes()) {
            if (!node.is(Kind::declaration) || node.variable == nullptr || !node.variable->constant) continue;
            const SyntaxNode* const value = initial_value(node);
            if (value == nullptr || !is_constant(*value) || !is_used(*node.variable)) continue;
            out += fmt::format("local {} <const> = {} ", node.word_text(), words(*value));
        }
        return out;
    }

    Observed observed;

private:
    struct Edit {
        std::size_t at;
        std::size_t replaced;
        std::string text;
    };

    bool is_inside(const Token* token) const { return token >= function_.first && token < function_.end; }

    bool is_used(const LocalName& variable) const {
        if (is_inside(variable.place)) return false;
        return std::any_of(tree_.nodes().begin(), tree_.nodes().end(), [&](const SyntaxNode& node) {
            return node.is(Kind::name) && node.variable == &variable && is_inside(node.first);
        });
    }

    // The expression of a declaration of `local a, b = 1, 2`.
    static const SyntaxNode* initial_value(const SyntaxNode& declaration) {
        const SyntaxNode& names = *declaration.parent;
        const SyntaxNode* const statement = names.parent;
        if (statement == nullptr || !statement->is(Kind::local) || statement->count() != 2) return nullptr;
        const SyntaxNode* name = names.child;
        const SyntaxNode* value = statement->last->child;
        for (; name != nullptr && value != nullptr; name = name->next, value = value->next) {
            if (name == &declaration) return value;
        }
        return nullptr;
    }

    std::size_t begin_of(const SyntaxNode& node) const { return tree_.offset(*node.first); }
    std::size_t end_of(const SyntaxNode& node) const { return begin_of(node) + node.text().size(); }

    void insert(std::size_t at, std::string text, std::size_t replaced = 0) {
        edits_.push_back({at, replaced, std::move(text)});
    }
    std::string call(HookCall kind, std::size_t index) const {
        return fmt::format("{}({},", hook_, index * hook_calls + static_cast<std::size_t>(kind));
    }

    Decision& add(Decision::Kind kind) {
        observed.decisions.push_back({.kind = kind});
        return observed.decisions.back();
    }

    std::size_t decide(Decision::Kind kind, const SyntaxNode& expression, std::optional<bool> literal = {}) {
        const std::size_t index = observed.decisions.size();
        Decision& decision = add(kind);
        decision.literal = literal;
        decision.first = observed.comparisons.size();
        insert(begin_of(expression), call(HookCall::decide, index));
        Formula formula = visit(expression, false);
        insert(end_of(expression), ")");
        observed.decisions[index].formula = std::move(formula);
        observed.decisions[index].last = observed.comparisons.size();
        return index;
    }

    void visit_statements(const SyntaxNode& node) {
        if (node.is(Kind::function)) return;
        if (node.is(Kind::return_statement)) {
            if (node.child != nullptr && node.child->child != nullptr)
                decide(Decision::Kind::result, *node.child->child);
            return;
        }
        if (node.is(Kind::local)) return visit_local(node);
        const bool decides = node.is(Kind::branches) && contains_return(node);
        for (const SyntaxNode& child : node) {
            if (decides && !child.is(Kind::block)) {
                decide(Decision::Kind::branch, child, returned_literal(*child.next));
            } else {
                visit_statements(child);
            }
        }
    }

    void visit_local(const SyntaxNode& local) {
        for (const SyntaxNode& name : *local.child) {
            const SyntaxNode* const value = initial_value(name);
            if (value == nullptr || !(is_logical(*value) || to_operator(*value))) continue;
            if (contains(assigned_, name.variable)) continue;
            locals_[name.variable] = decide(Decision::Kind::local, *value);
        }
    }

    Formula visit(const SyntaxNode& node, bool negated) {
        for (const auto& [op, kind] :
             {std::pair{"or", Formula::Kind::disjunction}, {"and", Formula::Kind::conjunction}}) {
            const auto parts = operands(node, op);
            if (parts.size() == 1) continue;
            Formula formula{.kind = kind};
            for (const SyntaxNode* part : parts) formula.parts.push_back(visit(*part, negated));
            return formula;
        }
        if (node.is(Kind::parenthesis)) return visit(*node.child, negated);
        if (is_logical(node)) {
            Formula formula{.kind = Formula::Kind::negation};
            formula.parts.push_back(visit(*node.child, !negated));
            return formula;
        }
        if (const auto truth = truth_of(node)) return {.kind = Formula::Kind::constant, .value = *truth};
        if (node.is(Kind::name) && node.variable != nullptr) {
            const auto local = locals_.find(node.variable);
            if (local != locals_.end()) return {.kind = Formula::Kind::local, .index = local->second};
        }
        const bool compares = to_operator(node) && !to_operator(*node.child);  // not `a < b == c`
        return {.kind = Formula::Kind::comparison,
                .index = compares ? compare(node, negated) : take_value(node, negated)};
    }

    std::size_t compare(const SyntaxNode& node, bool negated) {
        Comparison comparison{.left = words(*node.child), .right = words(*node.last), .op = *to_operator(node)};
        comparison.unit = unit_of(comparison.left);
        if (comparison.unit.empty()) comparison.unit = unit_of(comparison.right);
        comparison.negated = negated;
        // The right side is in parentheses, so that it gives one value.
        const std::size_t index = observed.comparisons.size();
        insert(begin_of(node), call(HookCall::compare, index));
        insert(tree_.offset(*node.word), ",(", node.word->text.size());
        shorten_paths(*node.child);
        shorten_paths(*node.last);
        insert(end_of(node), "))");
        observed.comparisons.push_back(std::move(comparison));
        return index;
    }

    // Each `a.b.c` in an expression becomes `(hook(a) or a.b.c)`: the hook finds most numbers without a table for each
    // step. If the hook finds nothing, `a.b.c` is evaluated as usual, with its usual errors.
    void shorten_paths(const SyntaxNode& node) {
        if (node.is(Kind::function)) return;
        const SyntaxNode* root = &node;
        std::string path;
        for (; root->is(Kind::member); root = root->child)
            path.insert(0, fmt::format("{}{}", root->word_text(), path.empty() ? "" : "."));
        if (path.empty() || !root->is(Kind::name)) {
            for (const SyntaxNode& child : *root) shorten_paths(child);
            return;
        }
        // A value that is called or indexed is not a number.
        const SyntaxNode& parent = *node.parent;
        const bool is_subject = parent.child == &node &&
                                (parent.is(Kind::call) || parent.is(Kind::method_call) || parent.is(Kind::subscript));
        if (is_subject || root->variable == nullptr) return;
        insert(begin_of(node),
               fmt::format("({}{})or ", call(HookCall::path, observed.paths.size()), root->word_text()));
        insert(end_of(node), ")");
        observed.paths.push_back(std::move(path));
    }

    std::size_t take_value(const SyntaxNode& node, bool negated) {
        const std::size_t index = observed.comparisons.size();
        Comparison value{.left = words(node), .right = "", .op = Comparison::Operator::truth};
        value.negated = negated;
        if (node.is(Kind::member) && node.word_text() == "collided") {
            value.unit = "m";
            const std::string what = in_message(*node.child);
            if (what != "?") value.called = fmt::format(" ({})", what);
            insert(begin_of(node), call(HookCall::contact, index));
            insert(end_of(*node.child), ")", end_of(node) - end_of(*node.child));
            observed.comparisons.push_back(std::move(value));
            return index;
        }
        insert(begin_of(node), call(HookCall::value, index));
        if (node.is(Kind::call)) {
            const SyntaxNode& callee = *node.child;
            value.called = in_message(callee);
            insert(begin_of(node), call(HookCall::call, index));
            insert(end_of(callee), ")");
        }
        insert(end_of(node), ")");
        observed.comparisons.push_back(std::move(value));
        return index;
    }

    // The name that Lua's error about a wrong call or index gives to a value.
    std::string in_message(const SyntaxNode& value) const {
        if (value.is(Kind::member)) return fmt::format("field '{}'", value.word_text());
        if (!value.is(Kind::name)) return "?";
        const LocalName* const variable = value.variable;
        return fmt::format("{} '{}'",
                           variable == nullptr          ? "global"
                           : is_inside(variable->place) ? "local"
                                                        : "upvalue",
                           value.word_text());
    }

    const SyntaxTree& tree_;
    const SyntaxNode& function_;
    std::string_view hook_;
    std::vector<Edit> edits_;
    std::vector<const LocalName*> assigned_;
    std::map<const LocalName*, std::size_t> locals_;  // indices of their decisions
};

bool fits(const SyntaxNode& function, const FunctionPlace& place) {
    const SyntaxNode& parameters = *function.child;
    const bool takes_more = (parameters.end - 2)->is("...");
    const Token* keyword = function.first;
    while (!keyword->is("function")) --keyword;
    return keyword->line == place.first_line && function.end[-1].line == place.last_line &&
           parameters.count() == place.parameters && takes_more == place.takes_more;
}

template <class T>
std::string_view unit_in(std::string_view field) {
    std::string_view unit;
    const T example{};
    for_each_field(example, [&](const auto& described, const auto&) {
        if (described.name == field) unit = described.unit;
    });
    return unit;
}

}  // namespace

ObservedSource observe_function(const SyntaxTree& tree, const FunctionPlace& place, std::string_view hook) {
    const SyntaxNode* found = nullptr;
    if (tree.error() != nullptr) return {.why = "the source text of the condition was not found"};
    for (const SyntaxNode& node : tree.nodes()) {
        if (!node.is(Kind::function) || !fits(node, place)) continue;
        if (found != nullptr) return {.why = "several functions begin on the line of the condition"};
        found = &node;
    }
    if (found == nullptr) return {.why = "the source text of the condition was not found"};
    Rewriter rewriter(tree, *found, hook);
    rewriter.observe();
    return {rewriter.text(), rewriter.constants(), std::move(rewriter.observed), ""};
}

std::string_view unit_of(std::string_view expression) {
    if (expression.find_first_of("*/^%") != std::string_view::npos) return "";
    while (!expression.empty() && expression.back() == ')') expression.remove_suffix(1);
    const std::size_t dot = expression.rfind('.');
    if (dot == std::string_view::npos) return "";
    const std::string_view field = expression.substr(dot + 1);
    if (field == "tm" || field == "age") return "s";
    if (field == "height") return "m";
    if (field == "tilt") return "rad";
    std::string_view unit = unit_in<Velocity2D>(field);
    if (unit.empty()) unit = unit_in<Pose2D>(field);
    if (unit.empty()) unit = unit_in<Point3D>(field);
    return unit;
}

}  // namespace nezumi
