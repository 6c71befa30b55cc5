// A condition of a scenario: a Lua function that returns true or false, and the numbers that it compares.
#pragma once

#include <lua.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/scenario/condition_source.hpp"

namespace nezumi {

/// Time limit for one call of a condition.
inline constexpr Budget condition_budget{2.0};

class Condition {
public:
    /// Takes the function at `index`. `text` is the source of its file, or null. If the function has the form
    /// `function() return EXPRESSION end`, it is replaced by a function that does the same and records the compared
    /// numbers.
    static tl::expected<std::unique_ptr<Condition>, CallError> take(lua_State* lua, int index, const std::string* text);
    Condition(const Condition&) = delete;
    Condition& operator=(const Condition&) = delete;

    /// Calls it.
    tl::expected<bool, CallError> sample(lua_State* lua);

    /// In the order of the text; empty if the function has another form.
    const std::vector<Comparison>& comparisons() const { return comparisons_; }

private:
    Condition() = default;
    static int compare(lua_State* lua);
    bool observe(lua_State* lua, int function, const std::string& text);

    std::vector<Comparison> comparisons_;
};

/// How far the numbers that decided were from the limit.
struct Margin {
    double distance = 0;  ///< never negative
    const Comparison* comparison = nullptr;
};

/// After a sample with the result `held`: the comparison that was nearest to its limit, among those that alone could
/// have changed the result. A comparison for equality has no margin.
std::optional<Margin> margin_of(const std::vector<Comparison>& comparisons, bool held);

/// After a sample with the result `held`: the compared values that caused the result, and their differences; "" if
/// unknown.
std::string reason_of(const std::vector<Comparison>& comparisons, bool held);

/// "0.004 m", "12".
std::string text_of_number(double number, std::string_view unit);
/// "mouse.truth.pose.position.x < 0.7".
std::string text_of(const Comparison& comparison);

}  // namespace nezumi
