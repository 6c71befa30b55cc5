// Compiles the function that records comparisons from the condition's own text, with the same upvalues.
#include "bindings/scenario/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/syntax/globals.hpp"

namespace nezumi {
namespace {

constexpr const char* hook_name = "nezumi_compare";

// The names of a function's upvalues, in order.
std::vector<std::string> upvalues_of(lua_State* lua, int function) {
    std::vector<std::string> names;
    for (int i = 1;; ++i) {
        const char* name = lua_getupvalue(lua, function, i);
        if (name == nullptr) return names;
        lua_pop(lua, 1);
        names.emplace_back(name);
    }
}

// Whether all globals of the text are of the library: then all other names are upvalues of the function. (A local that
// is a compile-time constant is not an upvalue, and would become a global.)
bool knows_all_names(const std::string& text) {
    const auto& library = sandbox_names();
    const SyntaxTree tree(text);
    for (const GlobalUse& use : global_uses(tree)) {
        if (use.name() != "_ENV" && std::find(library.begin(), library.end(), use.name()) == library.end())
            return false;
    }
    return true;
}

}  // namespace

tl::expected<std::unique_ptr<Condition>, CallError> Condition::take(lua_State* lua, int index,
                                                                    const std::string* text) {
    std::unique_ptr<Condition> condition(new Condition);
    index = lua_absindex(lua, index);
    const int top = lua_gettop(lua);
    if (text == nullptr || !condition->observe(lua, index, *text)) {
        condition->comparisons_.clear();
        lua_settop(lua, top);
        lua_pushvalue(lua, index);
    }
    // The function is on top; the registry keeps it under the address of its condition.
    const int function = lua_gettop(lua);
    lua_pushvalue(lua, function);
    lua_pushlightuserdata(lua, condition.get());
    lua_pushcfunction(lua, [](lua_State* inside) {
        lua_pushvalue(inside, 1);
        lua_rawsetp(inside, LUA_REGISTRYINDEX, lua_touserdata(inside, 2));
        return 0;
    });
    lua_insert(lua, -3);
    auto kept = protected_call(lua, 2, 0, condition_budget);
    lua_settop(lua, top);
    if (!kept) return tl::unexpected(kept.error());
    return condition;
}

// Pushes the function that records comparisons. Returns false, with anything on the stack, if it can't be made.
bool Condition::observe(lua_State* lua, int function, const std::string& text) {
    if (lua_checkstack(lua, 10) == 0 || lua_iscfunction(lua, function) != 0) return false;
    lua_Debug info;
    lua_pushvalue(lua, function);
    if (lua_getinfo(lua, ">Su", &info) == 0 || info.nparams != 0) return false;
    ObservedSource observed = observe_comparisons(text, info.linedefined, info.lastlinedefined, hook_name);
    if (observed.comparisons.empty()) return false;
    const std::vector<std::string> names = upvalues_of(lua, function);
    std::string locals = fmt::format("local {}", hook_name);
    for (const std::string& name : names) {
        if (name.empty() || name == hook_name) return false;
        if (name != "_ENV") locals += ", " + name;
    }
    if (!knows_all_names(locals + " return " + observed.text)) return false;
    if (std::find(names.begin(), names.end(), "_ENV") != names.end()) locals += ", _ENV";
    const std::string lines(static_cast<std::size_t>(std::max(0, info.linedefined - 1)), '\n');
    const auto chunk = compile(lines + locals + " return " + observed.text, info.source + 1);
    if (!chunk || !load_chunk(lua, *chunk) || !protected_call(lua, 0, 1, condition_budget)) return false;

    const int copy = lua_gettop(lua);
    const std::vector<std::string> copied = upvalues_of(lua, copy);
    for (std::size_t i = 0; i < copied.size(); ++i) {
        const auto at = static_cast<int>(i + 1);
        if (copied[i] == hook_name) {
            const auto pushed = protect(lua, condition_budget, [this](lua_State* inside) {
                lua_pushlightuserdata(inside, this);
                lua_pushcclosure(inside, compare, 1);
                return 1;
            });
            if (!pushed || lua_setupvalue(lua, copy, at) == nullptr) return false;
            continue;
        }
        const auto original = std::find(names.begin(), names.end(), copied[i]);
        if (original == names.end()) return false;
        lua_upvaluejoin(lua, copy, at, function, static_cast<int>(original - names.begin()) + 1);
    }
    comparisons_ = std::move(observed.comparisons);
    return true;
}

int Condition::compare(lua_State* lua) {
    auto& condition = *static_cast<Condition*>(lua_touserdata(lua, lua_upvalueindex(1)));
    Comparison& comparison = condition.comparisons_[static_cast<std::size_t>(lua_tointeger(lua, 1))];
    using enum Comparison::Operator;
    bool result = false;
    switch (comparison.op) {
        case less: result = lua_compare(lua, 2, 3, LUA_OPLT) != 0; break;
        case less_equal: result = lua_compare(lua, 2, 3, LUA_OPLE) != 0; break;
        case greater: result = lua_compare(lua, 3, 2, LUA_OPLT) != 0; break;
        case greater_equal: result = lua_compare(lua, 3, 2, LUA_OPLE) != 0; break;
        case equal: result = lua_compare(lua, 2, 3, LUA_OPEQ) != 0; break;
        case unequal: result = lua_compare(lua, 2, 3, LUA_OPEQ) == 0; break;
    }
    if (lua_type(lua, 2) == LUA_TNUMBER && lua_type(lua, 3) == LUA_TNUMBER) {
        comparison.left_value = lua_tonumber(lua, 2);
        comparison.right_value = lua_tonumber(lua, 3);
        comparison.result = result;
        comparison.sampled = true;
    }
    lua_pushboolean(lua, result ? 1 : 0);
    return 1;
}

tl::expected<bool, CallError> Condition::sample(lua_State* lua) {
    for (Comparison& comparison : comparisons_) comparison.sampled = false;
    if (lua_checkstack(lua, 4) == 0) return tl::unexpected(CallError{{"stack overflow"}, false});
    const int top = lua_gettop(lua);
    lua_rawgetp(lua, LUA_REGISTRYINDEX, this);
    if (auto called = protected_call(lua, 0, LUA_MULTRET, condition_budget); !called)
        return tl::unexpected(called.error());
    const bool nothing = lua_gettop(lua) == top;
    const bool held = !nothing && lua_toboolean(lua, top + 1) != 0;
    lua_settop(lua, top);
    if (nothing) return tl::unexpected(CallError{{"the condition returned nothing: expected true or false"}, false});
    return held;
}

std::string text_of_number(double number, std::string_view unit) {
    // Shows six digits; further digits are rounding errors.
    std::string text = fmt::format("{:.6g}", number);
    if (!unit.empty()) text.append(" ").append(unit);
    return text;
}

namespace {

bool has_margin(const Comparison& comparison) {
    using enum Comparison::Operator;
    return comparison.sampled && comparison.op != equal && comparison.op != unequal &&
           std::isfinite(comparison.left_value) && std::isfinite(comparison.right_value);
}

// "mouse.truth.pose.position.x was 0.704 m".
std::string values_of(const Comparison& comparison) {
    std::string text =
        fmt::format("{} was {}", comparison.left, text_of_number(comparison.left_value, comparison.unit));
    // A literal is shown without its value.
    const bool literal = comparison.right.find_first_not_of("-.0123456789eExX") == std::string::npos;
    if (literal) return text;
    return text + fmt::format(", {} was {}", comparison.right, text_of_number(comparison.right_value, comparison.unit));
}

}  // namespace

std::string text_of(const Comparison& comparison) {
    return fmt::format("{} {} {}", comparison.left, to_text(comparison.op), comparison.right);
}

std::optional<Margin> margin_of(const std::vector<Comparison>& comparisons, bool held) {
    std::optional<Margin> nearest;
    for (const Comparison& comparison : comparisons) {
        // Only a comparison that alone could have changed the result has a margin.
        if (!has_margin(comparison) || !(held ? comparison.for_true : comparison.for_false)) continue;
        const double distance = std::abs(comparison.left_value - comparison.right_value);
        if (nearest && nearest->distance <= distance) continue;
        nearest = Margin{distance, &comparison};
    }
    return nearest;
}

std::string reason_of(const std::vector<Comparison>& comparisons, bool held) {
    std::string reason;
    for (const Comparison& comparison : comparisons) {
        // If `a and b` is false, show the part that is false.
        if (!comparison.sampled || (comparison.result != comparison.negated) != held) continue;
        if (!reason.empty()) reason += "; ";
        reason += text_of(comparison) + ": " + values_of(comparison);
        if (has_margin(comparison) && comparison.left_value != comparison.right_value) {
            reason +=
                fmt::format(", off the limit by {}",
                            text_of_number(std::abs(comparison.left_value - comparison.right_value), comparison.unit));
        }
    }
    return reason;
}

}  // namespace nezumi
