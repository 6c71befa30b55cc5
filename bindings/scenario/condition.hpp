// A condition of a scenario: a Lua function that says true or false, and the numbers that it compared.
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

/// What one call of a condition may take.
inline constexpr Budget condition_budget{2.0};

class Condition {
public:
    /// Takes the function at `index`. `text` is the source of the file that it is in, or null. A function of the form
    /// `function() return EXPRESSION end` is replaced by one that does the same and notes what it compares.
    static tl::expected<std::unique_ptr<Condition>, CallError> take(lua_State* lua, int index, const std::string* text);
    Condition(const Condition&) = delete;
    Condition& operator=(const Condition&) = delete;

    /// Calls it.
    tl::expected<bool, CallError> sample(lua_State* lua);

    /// In the order of the text; empty when the function has another form.
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

/// After a sample that gave `held`: the comparison nearest to its limit, among those that alone could have changed the
/// outcome. Equality has no margin.
std::optional<Margin> margin_of(const std::vector<Comparison>& comparisons, bool held);

/// After a sample that gave `held`: what the comparisons that made it so compared, and by how much; "" when that is not
/// known.
std::string reason_of(const std::vector<Comparison>& comparisons, bool held);

/// "0.004 m", "12".
std::string text_of_number(double number, std::string_view unit);
/// "mouse.truth.pose.position.x < 0.7".
std::string text_of(const Comparison& comparison);

}  // namespace nezumi
