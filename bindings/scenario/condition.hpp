// A condition of a scenario: a Lua function that returns true or false, and the numbers that it compares.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <lua.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/syntax/syntax_tree.hpp"
#include "bindings/scenario/formula.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

/// Time limit for one call of a condition.
inline constexpr Budget condition_budget{2.0};

/// What conditions need to know: the source texts of functions, each parsed once, clearances and numbers.
class FunctionTexts {
public:
    /// The text of a file, which outlives this; null if it is unknown.
    using Find = std::function<const std::string*(const std::string& file)>;

    explicit FunctionTexts(Find find) : find_(std::move(find)) {}
    const SyntaxTree* tree(const std::string& file);

    /// The distance [m] from the robot at this stack index to the nearest thing that it could touch, at most `most`.
    /// Nothing if the distance is unknown, or if the value is not a robot.
    std::function<std::optional<double>(lua_State* lua, int index, double most)> clearance{};
    /// The number or boolean that the object at this stack index has at a path, the same as its fields would give;
    /// nothing for any other value.
    std::function<std::optional<Value>(lua_State* lua, int index, std::string_view path)> scalar{};

private:
    Find find_;
    std::map<std::string, std::unique_ptr<SyntaxTree>> trees_;
};

/// What a caller needs of a sample: the robustness (with the sign changed if `opposite`) if it is below `least`. A
/// greater robustness need not be exact.
struct LeastAsked {
    double least = std::numeric_limits<double>::infinity();
    bool opposite = false;
};

class Condition {
public:
    /// Takes the function at `index`. If its text is known, it is replaced by a function that does the same and records
    /// the compared numbers; so is each Lua function whose result is a part of the condition, when it is called.
    static tl::expected<std::unique_ptr<Condition>, CallError> take(lua_State* lua, int index, FunctionTexts& texts);
    ~Condition();
    Condition(const Condition&) = delete;
    Condition& operator=(const Condition&) = delete;

    /// Calls the condition. `asked` may save time; null: the robustness is exact.
    tl::expected<bool, CallError> sample(lua_State* lua, const LeastAsked* asked = nullptr);

    /// The comparisons in the condition itself, not in functions that it calls, in the order of the text.
    const std::vector<Comparison>& comparisons() const;
    /// The robustness of the last sample.
    const Robustness& robustness() const { return robustness_; }
    /// The reason why the numbers of the condition are unknown; "" if they are known.
    const std::string& why() const { return why_; }
    /// The compared values that caused the last result, and their differences; "" if unknown.
    std::string reason() const;

private:
    struct Function;

    explicit Condition(FunctionTexts& texts);
    static int hook(lua_State* lua);
    static int compare(lua_State* lua, Comparison& comparison);
    int called(lua_State* lua, const Comparison& comparison);
    void take_value(lua_State* lua, Comparison& value);
    int read_path(lua_State* lua, std::string_view path) const;
    int take_contact(lua_State* lua, Comparison& value, const Function& function);
    bool observe(lua_State* lua, int index, Function& function);
    Function* helper(lua_State* lua, int index);

    FunctionTexts& texts_;
    std::unique_ptr<Function> own_;  // null: the condition is not observed
    std::map<const void*, std::unique_ptr<Function>> helpers_;
    static constexpr std::size_t deepest = 16;
    std::array<Function*, deepest> calls_{};  // the call stack; null: a function that is not observed
    std::size_t depth_ = 0;                   // may be more than `deepest`
    Robustness robustness_;
    bool held_ = false;
    const LeastAsked* asked_ = nullptr;  // the argument of the present `sample`
    std::string why_;
};

/// Why a robustness is infinite: "mouse.collided is true or false".
std::string why_without_numbers(const Robustness& robustness);

/// "0.004 m", "12".
std::string text_of_number(double number, std::string_view unit);

}  // namespace nezumi
