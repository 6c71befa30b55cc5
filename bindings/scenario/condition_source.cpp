// Goes through `or`, `and`, `not` and parentheses of an expression to its comparisons.
#include "bindings/scenario/condition_source.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

std::optional<Comparison::Operator> to_operator(const SyntaxNode& node) {
    if (!node.is(Kind::binary)) return std::nullopt;
    using enum Comparison::Operator;
    for (const auto& [text, op] : {std::pair<std::string_view, Comparison::Operator>{"<", less},
                                   {"<=", less_equal},
                                   {">", greater},
                                   {">=", greater_equal},
                                   {"==", equal},
                                   {"~=", unequal}}) {
        if (node.word->text == text) return op;
    }
    return std::nullopt;
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

// Collects comparisons, and the texts that replace parts of the source.
class Rewriter {
public:
    Rewriter(const SyntaxTree& tree, std::string_view hook) : tree_(tree), hook_(hook) {}

    // `for_true`: the whole is false unless this part has the required result; `for_false`: the same for true.
    void visit(const SyntaxNode& node, bool for_true, bool for_false, bool negated = false) {
        if (const auto parts = operands(node, "or"); parts.size() > 1) {
            for (const auto* part : parts) visit(*part, negated && for_true, !negated && for_false, negated);
        } else if (const auto both = operands(node, "and"); both.size() > 1) {
            for (const auto* part : both) visit(*part, !negated && for_true, negated && for_false, negated);
        } else if (to_operator(node)) {
            compare(node, for_true, for_false, negated);
        } else if (node.is(Kind::unary) && node.word->is("not")) {
            visit(*node.child, for_true, for_false, !negated);
        } else if (node.is(Kind::parenthesis)) {
            visit(*node.child, for_true, for_false, negated);
        }
    }

    // The source of a node, with the replacements.
    std::string text(const SyntaxNode& node) {
        std::sort(edits_.begin(), edits_.end(), [](const Edit& a, const Edit& b) { return a.at < b.at; });
        std::string out;
        std::size_t begin = tree_.offset(*node.first);
        const std::size_t end = begin + node.text().size();
        for (const Edit& edit : edits_) {
            out.append(tree_.source().substr(begin, edit.at - begin)).append(edit.text);
            begin = edit.at + edit.replaced;
        }
        return out.append(tree_.source().substr(begin, end - begin));
    }

    std::vector<Comparison> comparisons;

private:
    struct Edit {
        std::size_t at;
        std::size_t replaced;
        std::string text;
    };

    void compare(const SyntaxNode& node, bool for_true, bool for_false, bool negated) {
        if (to_operator(*node.child)) return;  // `a < b == c`
        Comparison comparison;
        comparison.left = words(*node.child);
        comparison.right = words(*node.last);
        comparison.op = *to_operator(node);
        comparison.unit = unit_of(comparison.left);
        if (comparison.unit.empty()) comparison.unit = unit_of(comparison.right);
        comparison.for_true = for_true;
        comparison.for_false = for_false;
        comparison.negated = negated;
        // The right side is in parentheses, so that it gives one value.
        const std::string number = std::to_string(comparisons.size());
        const std::size_t begin = tree_.offset(*node.first);
        edits_.push_back({begin, 0, std::string(hook_) + "(" + number + ","});
        edits_.push_back({tree_.offset(*node.word), node.word->text.size(), ",("});
        edits_.push_back({begin + node.text().size(), 0, "))"});
        comparisons.push_back(std::move(comparison));
    }

    const SyntaxTree& tree_;
    std::string_view hook_;
    std::vector<Edit> edits_;
};

// The expression of `function() return EXPRESSION end` with its `end` in this line, without a function inside.
const SyntaxNode* returned_by(const SyntaxNode& function, int last_line) {
    const bool has_name = !function.first->is("function");
    const SyntaxNode* const statement = function.last->child;
    if (has_name || function.end[-1].line != last_line || statement == nullptr || statement->next != nullptr ||
        !statement->is(Kind::return_statement) || statement->count() != 1 || statement->child->count() != 1)
        return nullptr;
    for (const Token* token = statement->first; token != statement->end; ++token) {
        if (token->is("function")) return nullptr;
    }
    return statement->child->child;
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

std::string_view to_text(Comparison::Operator op) {
    constexpr std::string_view texts[] = {"<", "<=", ">", ">=", "==", "~="};
    return texts[static_cast<std::size_t>(op)];
}

ObservedSource observe_comparisons(std::string_view source, int first_line, int last_line, std::string_view hook) {
    const SyntaxTree tree(without_preamble(source));
    const SyntaxNode* found = nullptr;
    for (const SyntaxNode& node : tree.nodes()) {
        const bool takes_nothing = node.is(Kind::function) && node.child->end - node.child->first == 2;
        if (!takes_nothing || node.first->line != first_line) continue;
        if (found != nullptr) return {};
        found = &node;
    }
    const SyntaxNode* const expression = found != nullptr ? returned_by(*found, last_line) : nullptr;
    if (expression == nullptr) return {};
    Rewriter rewriter(tree, hook);
    rewriter.visit(*expression, true, true);
    if (rewriter.comparisons.empty()) return {};
    return {rewriter.text(*found), std::move(rewriter.comparisons)};
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
