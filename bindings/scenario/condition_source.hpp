// Finds the comparisons of numbers in the source text of a condition.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// One comparison of a condition, as in `function() return math.abs(mouse.truth.velocity.vx) < 0.01 end`.
struct Comparison {
    enum class Operator : unsigned char { less, less_equal, greater, greater_equal, equal, unequal };
    std::string left;   ///< as written in the text
    std::string right;  ///< the same
    Operator op = Operator::less;
    std::string_view unit;   ///< of what is compared, "" when the text does not tell
    bool for_true = false;   ///< if it is false, the condition is false: the condition is `this and ...`
    bool for_false = false;  ///< if it is true, the condition is true: the condition is `this or ...`
    bool negated = false;    ///< the condition has `not` before it

    // Of the last sample.
    bool sampled = false;  ///< it was evaluated, and both sides were numbers
    double left_value = 0;
    double right_value = 0;
    bool result = false;
};

/// "<", ">=", "==", ...
std::string_view to_text(Comparison::Operator op);

/// The text of a condition that calls `hook(number, left, right)` instead of each comparison.
struct ObservedSource {
    std::string text;  ///< "function() return hook(0, x,(0.7)) end", with the line breaks of the original
    std::vector<Comparison> comparisons;
};

/// Finds the function without parameters that begins in one line of a source text, ends in another, and only returns an
/// expression. Empty if there is none or more than one, or if it compares nothing.
ObservedSource observe_comparisons(std::string_view source, int first_line, int last_line, std::string_view hook);

/// The unit of an expression such as "mouse.truth.velocity.vx"; "" if the text does not tell it.
std::string_view unit_of(std::string_view expression);

}  // namespace nezumi
