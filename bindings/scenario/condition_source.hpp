// Finds the comparisons and decisions in the source text of a condition, or of a function that it calls.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "bindings/lua/syntax/syntax_tree.hpp"
#include "bindings/scenario/formula.hpp"

namespace nezumi {

/// The purpose of a call of the hook. The first argument of the call is N * `hook_calls` + purpose, where N is the
/// number of the comparison, decision or path.
enum class HookCall : unsigned char {
    compare,  ///< (left, right): returns the result of the comparison
    value,    ///< (...): a value that counts as true or false; returns all its arguments
    contact,  ///< (X): returns X.collided
    call,     ///< (function): the function that is called for the next value; returns the one to call instead
    decide,   ///< (...): the value of a decision; returns all its arguments
    path,     ///< (X): returns the number X.a.b, found directly; nothing if it is not a number
};

inline constexpr std::size_t hook_calls = 6;

/// The text of a function that calls `hook` with each comparison and decision.
struct ObservedSource {
    std::string text;       ///< "function() return hook(0, x,(0.7)) end", with the line breaks of the original
    std::string constants;  ///< declares the constants that are not upvalues: "local limit <const> = 0.7 "
    Observed observed;
    std::string why;  ///< the reason if the text is empty
};

struct FunctionPlace {
    int first_line = 0, last_line = 0;
    std::size_t parameters = 0;
    bool takes_more = false;  ///< ends in `...`
};

/// Finds the function with these parameters that begins in one line of a source text and ends in another. A function
/// that only returns an expression decides nothing else; otherwise its decisions are its `return`s, the conditions of
/// each `if` that contains a `return`, and locals that are set once, to a comparison or to `and`, `or`, `not`.
ObservedSource observe_function(const SyntaxTree& tree, const FunctionPlace& place, std::string_view hook);

/// The unit of an expression such as "mouse.truth.velocity.vx"; "" if the text does not show it.
std::string_view unit_of(std::string_view expression);

}  // namespace nezumi
