// The comparisons of numbers that decide a condition, found in its source text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// One comparison of a condition, as in `function() return math.abs(mouse.truth.velocity.vx) < 0.01 end`.
struct Comparison {
    enum class Operator : unsigned char { less, less_equal, greater, greater_equal, equal, unequal };
    std::string left;   ///< as the text says it
    std::string right;  ///< likewise
    Operator op = Operator::less;
    std::string_view unit;   ///< of what is compared, "" when the text does not tell
    bool for_true = false;   ///< it alone decides when the condition holds: the condition is `this and ...`
    bool for_false = false;  ///< it alone decides when the condition does not hold: the condition is `this or ...`
    bool negated = false;    ///< the condition says `not` of it

    // The last sample.
    bool sampled = false;  ///< it was reached, and both sides were numbers
    double left_value = 0;
    double right_value = 0;
    bool result = false;
};

/// "<", ">=", "==", ...
std::string_view to_text(Comparison::Operator op);

/// A condition's text, made to call `hook(number, left, right)` in place of each comparison.
struct ObservedSource {
    std::string text;  ///< "function() return hook(0, x,(0.7)) end", with the line breaks of the original
    std::vector<Comparison> comparisons;
};

/// Finds the function without parameters that begins in one line of a source text, ends in another and only returns an
/// expression. Empty when there is none such, or more than one, or when it compares nothing.
ObservedSource observe_comparisons(std::string_view source, int first_line, int last_line, std::string_view hook);

/// The unit of what an expression like "mouse.truth.velocity.vx" means; "" when its text does not tell.
std::string_view unit_of(std::string_view expression);

}  // namespace nezumi
