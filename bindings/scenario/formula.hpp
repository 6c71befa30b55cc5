// Robustness of a condition: how far its numbers were from the other result, as in signal temporal logic.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// A part of a condition that is not `and`, `or` or `not`: a comparison such as `math.abs(mouse.truth.velocity.vx) <
/// 0.01`, or a value that counts as true or false, with the values of its last evaluation.
struct Comparison {
    enum class Operator : unsigned char { less, less_equal, greater, greater_equal, equal, unequal, truth };
    std::string left;   ///< as written in the text
    std::string right;  ///< as written in the text; "" for a boolean
    Operator op = Operator::less;
    std::string_view unit{};  ///< unit of the compared values, "" if the text does not show it
    bool negated = false;     ///< the condition has `not` before it
    std::string called{};     ///< what is called for the value, as in Lua's messages: "upvalue 'near'"; of a contact,
                              ///< what is indexed: " (field 'mouse')"

    bool evaluated = false;
    bool has_numbers = false;  ///< both sides were numbers
    double left_value = 0;
    double right_value = 0;
    bool result = false;
    double robustness = 0;                ///< positive when true, negative when false; 0: at the limit
    const Comparison* decided = nullptr;  ///< the comparison that gave the robustness; for a call, one in its function
};

/// "<", ">=", "==", ...
std::string_view to_text(Comparison::Operator op);
/// "mouse.truth.pose.position.x < 0.7".
std::string text_of(const Comparison& comparison);

/// The robustness of two numbers: `right - left` for `left < right`, the negative distance for `==`. Infinite if the
/// difference is not a number: only the result counts.
double robustness_of(Comparison::Operator op, double left, double right, bool result);

/// The robustness of a result that compares no numbers.
double of_result(bool result);

struct Robustness {
    double value = 0;  ///< in the unit of the comparison that decided; infinite: it has no numbers
    const Comparison* decided = nullptr;

    Robustness operator-() const { return {0.0 - value, decided}; }
};

/// An expression of comparisons.
struct Formula {
    enum class Kind : unsigned char { comparison, conjunction, disjunction, negation, constant, local };
    Kind kind = Kind::constant;
    std::size_t index = 0;  ///< of the comparison; of the decision that gave a local its value
    bool value = false;     ///< of the constant
    std::vector<Formula> parts{};
};

/// A place where a function returns a value, chooses a branch or sets a local, and so decides its result.
struct Decision {
    enum class Kind : unsigned char { result, branch, local };
    Kind kind = Kind::result;
    Formula formula{};
    std::optional<bool> literal{};              ///< a branch that only returns `true` or `false`
    std::size_t first = 0, last = 0;            ///< its comparisons: from `first` to before `last`
    std::optional<Robustness> last_robustness;  ///< of its last evaluation
};

/// A function of a condition, and what its call has evaluated.
struct Observed {
    std::vector<Comparison> comparisons;
    std::vector<Decision> decisions;
    std::vector<std::string> paths;  ///< what comparisons read from locals or upvalues: "truth.pose.position.x"
    bool returns_only = false;       ///< `return EXPRESSION` is its only statement: it does not call `decide`

    /// Forgets what was evaluated.
    void begin();
    /// Decision number `index` has this value.
    void decide(std::size_t index, bool is_true);
    /// The robustness of the result, after the call.
    Robustness finish(bool result);

private:
    // For each result of the function: the least robustness of a branch that, if taken otherwise, might change the
    // result.
    Robustness nearest_[2]{};
    std::optional<Robustness> result_;
};

/// The robustness of what has been evaluated; nothing if no part has.
std::optional<Robustness> robustness_of(const Formula& formula, const Observed& observed);

}  // namespace nezumi
