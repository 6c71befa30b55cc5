// Translates an input to Lua, then compiles it as an expression, and if this fails as statements.
#include "bindings/console/input_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "engine/base/names.hpp"

namespace nezumi {
namespace {

constexpr std::size_t longest_input = std::size_t{64} << 10;  // [bytes]

using Kind = SyntaxNode::Kind;

// Replaces parts of a text.
class Changes {
public:
    explicit Changes(std::string_view text) : text_(text) {}
    /// Call this in the order of the text.
    void replace(std::size_t from, std::size_t to, std::string_view by) {
        changed_.append(text_.substr(copied_, from - copied_)).append(by);
        copied_ = to;
    }
    std::string done() { return std::move(changed_.append(text_.substr(copied_))); }

private:
    std::string_view text_;
    std::string changed_;
    std::size_t copied_ = 0;
};

}  // namespace

std::string with_keyword_names(std::string_view text) {
    const SyntaxTree tree(text, SyntaxTree::Dialect::console);
    Changes changes(text);
    for (const SyntaxNode& node : tree.nodes()) {
        if (!node.is(Kind::member) || node.word == nullptr || node.word->kind != Token::Kind::keyword) continue;
        const std::size_t dot = tree.offset(*node.child->end);
        const std::size_t word = tree.offset(*node.word);
        const std::string_view between = text.substr(dot + 1, word - dot - 1);  // blanks and ends of lines
        changes.replace(dot, word + node.word->text.size(), fmt::format("[\"{}\"]{}", node.word->text, between));
    }
    return changes.done();
}

namespace {

// Whether values of this member can be plotted, although it is not a port.
bool is_followed_member(std::string_view member) {
    return member == ".collided" || member == ".config" || member == ".probes" || member == ".state" ||
           member == ".tasks" || member == ".truth";
}

// ".out.vx[1]" of `controller.out.vx[1]`, if the expression is one name followed by names and indices.
std::optional<std::string> path_of(const SyntaxNode& expression) {
    std::string path;
    const SyntaxNode* node = &expression;
    for (; node->is(Kind::member) || node->is(Kind::subscript); node = node->child) {
        if (node->is(Kind::member)) {
            if (node->word == nullptr) return std::nullopt;
            path.insert(0, "." + std::string(node->word_text()));
        } else if (const auto name = node->last->string()) {
            if (!is_identifier(*name) && !is_keyword(*name)) return std::nullopt;
            path.insert(0, "." + std::string(*name));
        } else {
            const std::string_view index = node->last->text();
            const bool is_index = index.find_first_not_of("0123456789") == std::string_view::npos;
            if (!is_index || index.empty()) return std::nullopt;
            path.insert(0, "[" + std::string(index) + "]");
        }
    }
    return node->is(Kind::name) ? std::optional(path) : std::nullopt;
}

}  // namespace

bool takes_values(std::string_view command) {
    return command == "plot" || command == "watch_changes" || command == "unwatch";
}

std::string with_plotted_names(std::string_view text) {
    const SyntaxTree tree(text, SyntaxTree::Dialect::console);
    Changes changes(text);
    for (const SyntaxNode& node : tree.nodes()) {
        const bool is_plot = node.is(Kind::call) && node.child->is(Kind::name) && takes_values(node.child->word->text);
        if (!is_plot || !node.end[-1].is(")")) continue;
        for (const SyntaxNode& argument : *node.last) {
            const auto path = path_of(argument);
            if (!path) continue;
            const std::size_t second = path->find_first_of(".[", 1);
            const bool is_part = second != std::string::npos || path->starts_with('[') || is_followed_member(*path);
            if (path->empty() || !is_part) continue;
            const std::string_view whole = argument.text();
            const std::string lines(static_cast<std::size_t>(std::count(whole.begin(), whole.end(), '\n')), '\n');
            const std::size_t from = tree.offset(*argument.first);
            changes.replace(from, from + whole.size(),
                            fmt::format("{{ {}, \"{}\" }}{}", argument.first->text, *path, lines));
        }
    }
    return changes.done();
}

Expected<Chunk> compile_input(std::string_view text) {
    if (text.size() > longest_input) return failure("the input is too long: at most 64 KB");
    const std::string lua = with_keyword_names(with_plotted_names(text));
    if (auto expression = compile("return " + lua, input_name)) return expression;
    return compile(lua, input_name);
}

bool is_complete_input(std::string_view text) {
    // A string in quotes can't continue on a new line. With the added end of line, an open string is an error, and not
    // an incomplete input.
    const std::string lines = std::string(text) + "\n";
    const std::string expression = "return " + lines;
    const SyntaxTree as_expression(expression, SyntaxTree::Dialect::console);
    const SyntaxTree as_statements(lines, SyntaxTree::Dialect::console);
    return as_expression.error() == nullptr || !(as_expression.ends_early() || as_statements.ends_early());
}

}  // namespace nezumi
