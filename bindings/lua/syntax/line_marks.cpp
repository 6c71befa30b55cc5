// Marks are assignments of a constant to a field of a local table, which cost less than a call or a hook.
#include "bindings/lua/syntax/line_marks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {
namespace {

using Kind = SyntaxNode::Kind;

// Whether a loop can end in another way than by its condition.
bool can_leave(const SyntaxNode& node, bool in_inner_loop = false) {
    if (node.is(Kind::function)) return false;
    if (node.is(Kind::goto_statement) || (node.is(Kind::break_statement) && !in_inner_loop)) return true;
    const bool is_loop = node.is(Kind::while_loop) || node.is(Kind::for_loop) || node.is(Kind::repeat_loop);
    return std::any_of(begin(node), end(node),
                       [&](const SyntaxNode& child) { return can_leave(child, in_inner_loop || is_loop); });
}

// Whether the main function uses its arguments.
bool uses_arguments(const SyntaxNode& node) {
    if (node.is(Kind::function)) return false;
    if (node.is(Kind::literal) && node.first->is("...")) return true;
    return std::any_of(begin(node), end(node), uses_arguments);
}

class Marker {
public:
    explicit Marker(const SyntaxTree& tree) : tree_(tree) {}

    MarkedText marked() {
        if (tree_.error() != nullptr || uses_arguments(tree_.root())) return {};
        visit(tree_.root());
        std::stable_sort(inserted_.begin(), inserted_.end(),
                         [](const Insert& a, const Insert& b) { return a.at < b.at; });
        marked_.text = fmt::format("local {} = ...;", marks_name);
        std::size_t begin = 0;
        for (const Insert& insert : inserted_) {
            marked_.text.append(tree_.source().substr(begin, insert.at - begin)).append(insert.text);
            begin = insert.at;
        }
        marked_.text.append(tree_.source().substr(begin));
        return std::move(marked_);
    }

private:
    struct Insert {
        std::size_t at;
        std::string text;
    };

    // A mark at this place; `line` is that of the statement which begins there.
    std::size_t mark(std::size_t at, int line, std::string_view before = "") {
        marked_.lines.push_back(line);
        const std::size_t number = marked_.lines.size();
        inserted_.push_back({at, fmt::format("{} {}[{}]=1;", before, marks_name, number)});
        return number;
    }

    // Marks the statements of a block; returns the mark that is passed when it begins.
    std::size_t mark_block(const SyntaxNode& block) {
        const SyntaxNode* const first = block.child;
        if (first == nullptr || first->is(Kind::label) || first->is(Kind::do_block)) {
            const std::size_t entry = mark(tree_.offset(*block.first), 0);
            visit(block);
            return entry;
        }
        const std::size_t entry = marked_.lines.size() + 1;
        visit(block);
        return entry;
    }

    void visit(const SyntaxNode& node) {
        const bool is_statement = node.parent != nullptr && node.parent->is(Kind::block);
        if (is_statement && !node.is(Kind::label) && !node.is(Kind::do_block))
            mark(tree_.offset(*node.first), node.first->line);
        if (node.is(Kind::branches)) return visit_branches(node);
        if (node.is(Kind::while_loop) || node.is(Kind::for_loop)) return visit_loop(node);
        for (const SyntaxNode& child : node) visit(child);
    }

    void visit_branches(const SyntaxNode& node) {
        std::vector<MarkedText::Branch> ways;
        std::vector<std::size_t> blocks;
        bool has_else = false;
        for (const SyntaxNode& child : node) {
            if (!child.is(Kind::block)) {
                visit(child);
                ways.push_back({.line = child.first->line});
                continue;
            }
            has_else = blocks.size() == ways.size();
            if (has_else) {
                blocks.push_back(mark_block(child));
            } else {
                ways.back().taken = mark_block(child);
                blocks.push_back(ways.back().taken);
            }
        }
        if (!has_else) blocks.push_back(mark(tree_.offset(node.end[-1]), 0, " else"));
        for (std::size_t i = 0; i < ways.size(); ++i)
            ways[i].passed.assign(blocks.begin() + static_cast<std::ptrdiff_t>(i) + 1, blocks.end());
        marked_.branches.insert(marked_.branches.end(), ways.begin(), ways.end());
    }

    void visit_loop(const SyntaxNode& node) {
        MarkedText::Branch branch{.line = node.first->line};
        for (const SyntaxNode& child : node) {
            if (&child != node.last) visit(child);
        }
        branch.taken = mark_block(*node.last);
        if (!can_leave(*node.last))
            branch.passed.push_back(mark(tree_.offset(node.end[-1]) + node.end[-1].text.size(), 0));
        marked_.branches.push_back(std::move(branch));
    }

    const SyntaxTree& tree_;
    MarkedText marked_;
    std::vector<Insert> inserted_;
};

}  // namespace

MarkedText mark_lines(std::string_view source) {
    const SyntaxTree tree(source);
    return Marker(tree).marked();
}

}  // namespace nezumi
