// The visible local variables and labels, by the rules of Lua's compiler (lparser.c of 5.4).
#pragma once

#include <cstddef>
#include <deque>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bindings/lua/syntax/syntax_tree.hpp"

namespace nezumi {

class Scopes {
public:
    explicit Scopes(std::deque<LocalName>& locals) : locals_(locals) {}

    void open_function(bool takes_more);
    void close_function(const Token* at);
    void open_block(bool is_loop);
    void close_block(const Token* at);

    /// Declares a local variable, which is visible from the token `from` on.
    LocalName* declare(std::string_view name, const Token* place, const Token* from, bool constant);
    /// The visible local variable with this name; null: the name is a global.
    const LocalName* find(std::string_view name) const;
    /// Whether `...` is allowed here.
    bool takes_more() const { return functions_.back().takes_more; }

    void add_goto(const Token* name);
    void add_break(const Token* keyword);
    /// `is_last`: only labels and semicolons follow in the block of the label.
    void add_label(const Token* name, bool is_last);

    /// The first jump or label that Lua refuses; null if there is none.
    const Token* error() const { return error_; }

private:
    struct Function {
        bool takes_more;
        std::size_t first_label;
    };
    struct Block {
        bool is_loop;
        bool is_function;
        std::size_t locals;  // number of variables that are visible at its start
        std::size_t labels;
        std::size_t jumps;
    };
    struct Label {
        std::string_view name;
        std::size_t locals;
    };
    struct Jump {
        const Token* name;  // the name after `goto`, or the keyword `break`
        std::size_t locals;
    };

    void refuse(const Token* token);
    void resolve_jumps(std::string_view name, std::size_t locals);

    std::deque<LocalName>& locals_;
    std::vector<LocalName*> visible_;
    std::unordered_map<std::string_view, std::vector<LocalName*>> by_name_;
    std::vector<Function> functions_;
    std::vector<Block> blocks_;
    std::vector<Label> labels_;
    std::vector<Jump> jumps_;  // jumps that wait for their labels
    const Token* error_ = nullptr;
};

}  // namespace nezumi
