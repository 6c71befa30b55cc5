// Goes through the tree. Leaves out the tables of declarations, because their units and texts affect no behaviour.
#include "bindings/lua/syntax/mutations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "engine/base/list.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

constexpr std::array<std::pair<std::string_view, std::string_view>, 12> operators{{{"<", ">="},
                                                                                   {"<=", ">"},
                                                                                   {">", "<="},
                                                                                   {">=", "<"},
                                                                                   {"==", "~="},
                                                                                   {"~=", "=="},
                                                                                   {"and", "or"},
                                                                                   {"or", "and"},
                                                                                   {"+", "-"},
                                                                                   {"-", "+"},
                                                                                   {"*", "/"},
                                                                                   {"/", "*"}}};

// Calls whose arguments do not change, except the default of `param` and the function of `command`.
bool is_declaration(std::string_view name) {
    constexpr std::array<std::string_view, 6> names{"param", "input", "output", "about", "command", "require"};
    return contains(names, name);
}

bool only_tells(const SyntaxNode& callee) {
    const SyntaxNode* const name = callee.is(Kind::member) ? callee.child : &callee;
    return name->is_global("log") || callee.is_global("print") || callee.is_global("probe");
}

class Mutator {
public:
    explicit Mutator(const SyntaxTree& tree) : tree_(tree) {}

    std::vector<Mutation> all() {
        if (tree_.error() == nullptr) visit(tree_.root(), 1);
        std::stable_sort(found_.begin(), found_.end(),
                         [](const Mutation& a, const Mutation& b) { return a.at < b.at; });
        return std::move(found_);
    }

private:
    void add(const Token& token, int statement, std::string text, std::string change) {
        found_.push_back(
            {token.line, statement, tree_.offset(token), token.text.size(), std::move(text), std::move(change)});
    }

    void visit(const SyntaxNode& node, int statement) {
        const SyntaxNode* const parent = node.parent;
        if (parent != nullptr && parent->is(Kind::block)) statement = node.first->line;
        if (parent != nullptr && parent->is(Kind::branches) && !node.is(Kind::block)) statement = node.first->line;
        if (node.is(Kind::call) && only_tells(*node.child)) return;
        if (node.is(Kind::call_statement)) leave_out(node, statement);
        if (node.is(Kind::call) && node.child->is(Kind::name) && is_declaration(node.child->word_text()))
            return visit_declaration(node, statement);
        if (node.is(Kind::binary)) change_operator(node, statement);
        if (node.is(Kind::unary)) leave_out_operator(node, statement);
        if (node.is(Kind::literal)) change_literal(node, statement);
        for (const SyntaxNode& child : node) visit(child, statement);
    }

    // The default of `param`, and the function of `command`.
    void visit_declaration(const SyntaxNode& call, int statement) {
        const SyntaxNode* const value = call.last->at(1);
        const std::string_view name = call.child->word_text();
        if (value != nullptr && (name == "param" || name == "command")) visit(*value, statement);
    }

    void change_operator(const SyntaxNode& node, int statement) {
        const auto is_its = [&](const auto& pair) { return pair.first == node.word->text; };
        const auto found = std::find_if(operators.begin(), operators.end(), is_its);
        if (found == operators.end()) return;
        // `..` and names may follow without a blank: `a<b` stays two tokens.
        add(*node.word, statement, fmt::format(" {} ", found->second),
            fmt::format("`{}` instead of `{}`", found->second, found->first));
    }

    void leave_out_operator(const SyntaxNode& node, int statement) {
        if (!node.word->is("-") && !node.word->is("not")) return;
        add(*node.word, statement, " ",
            fmt::format("without the `{}` before `{}`", node.word->text, shortened(*node.child)));
    }

    void change_literal(const SyntaxNode& node, int statement) {
        const Token& token = *node.first;
        if (token.is("true") || token.is("false")) {
            const std::string_view other = token.is("true") ? "false" : "true";
            return add(token, statement, std::string(other), fmt::format("`{}` instead of `{}`", other, token.text));
        }
        if (token.kind != Token::Kind::number) return;
        const bool is_whole = token.text.find_first_of(".eExX") == token.text.npos;
        const bool is_zero = token.text.find_first_not_of("0.") == token.text.npos;
        const std::string text = fmt::format("({} {})", token.text, is_whole || is_zero ? "+ 1" : "* 2");
        add(token, statement, text, fmt::format("`{}` instead of `{}`", text.substr(1, text.size() - 2), token.text));
    }

    void leave_out(const SyntaxNode& node, int statement) {
        const SyntaxNode& call = *node.child;
        if (call.is(Kind::call) && (only_tells(*call.child) || is_declaration(call.child->word_text()))) return;
        const std::string_view text = node.text();
        const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
        found_.push_back({node.first->line, statement, tree_.offset(*node.first), text.size(),
                          ";" + std::string(lines, '\n'), fmt::format("without the call `{}`", shortened(node))});
    }

    static std::string shortened(const SyntaxNode& node) {
        constexpr std::size_t longest = 40;
        const std::string_view line = node.text().substr(0, node.text().find('\n'));
        if (line.size() == node.text().size() && line.size() <= longest) return std::string(line);
        return std::string(line.substr(0, longest)) + "...";
    }

    const SyntaxTree& tree_;
    std::vector<Mutation> found_;
};

}  // namespace

std::string Mutation::of(std::string_view source) const {
    return std::string(source.substr(0, at)).append(text).append(source.substr(at + length));
}

std::vector<Mutation> mutations_of(std::string_view source) {
    const SyntaxTree tree(source);
    return Mutator(tree).all();
}

}  // namespace nezumi
