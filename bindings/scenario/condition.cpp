// Compiles the text of a function again: the new function has the same upvalues and also records its comparisons.
#include "bindings/scenario/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/syntax/globals.hpp"
#include "bindings/lua/values/codec.hpp"
#include "bindings/scenario/condition_source.hpp"
#include "engine/base/list.hpp"

namespace nezumi {
namespace {

constexpr const char* hook_name = "nezumi_observe";
// A limit, because a condition that makes functions makes new ones in each call.
constexpr std::size_t most_helpers = 32;

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
        if (use.name() != "_ENV" && !contains(library, use.name())) return false;
    }
    return true;
}

// Keeps the value on top of the stack in the registry, and pops it.
bool keep(lua_State* lua, const void* key) {
    lua_pushlightuserdata(lua, const_cast<void*>(key));
    lua_pushcfunction(lua, [](lua_State* inside) {
        lua_pushvalue(inside, 1);
        lua_rawsetp(inside, LUA_REGISTRYINDEX, lua_touserdata(inside, 2));
        return 0;
    });
    lua_insert(lua, -3);
    return protected_call(lua, 2, 0, condition_budget).has_value();
}

}  // namespace

// A function that records what it compares. The registry keeps it under the address of this object. It also keeps the
// original function, under the address of `original`, so that no other function gets the original's address.
struct Condition::Function {
    Condition* owner = nullptr;
    Observed observed{};
    bool is_called = false;
    char original = 0;
};

const SyntaxTree* FunctionTexts::tree(const std::string& file) {
    auto& tree = trees_[file];
    if (tree == nullptr) {
        const std::string* const text = find_(file);
        if (text != nullptr) tree = std::make_unique<SyntaxTree>(without_preamble(*text));
    }
    return tree.get();
}

Condition::Condition(FunctionTexts& texts) : texts_(texts) {}

Condition::~Condition() = default;

const std::vector<Comparison>& Condition::comparisons() const {
    static const std::vector<Comparison> none;
    return own_ != nullptr ? own_->observed.comparisons : none;
}

tl::expected<std::unique_ptr<Condition>, CallError> Condition::take(lua_State* lua, int index, FunctionTexts& texts) {
    std::unique_ptr<Condition> condition(new Condition(texts));
    index = lua_absindex(lua, index);
    const int top = lua_gettop(lua);
    condition->own_ = std::make_unique<Function>();
    condition->own_->owner = condition.get();
    if (!condition->observe(lua, index, *condition->own_)) {
        condition->own_.reset();
        lua_settop(lua, top);
        lua_pushvalue(lua, index);
    }
    // The function is on top; the registry keeps it under the address of its condition.
    const bool kept = keep(lua, condition.get());
    lua_settop(lua, top);
    if (!kept) return tl::unexpected(CallError{{"not enough memory"}, false});
    return condition;
}

// Pushes the function that records comparisons. Returns false, with anything on the stack, if it can't be made.
bool Condition::observe(lua_State* lua, int index, Function& function) {
    const auto refuse = [this](std::string why) {
        if (why_.empty()) why_ = std::move(why);
        return false;
    };
    if (lua_checkstack(lua, 10) == 0 || lua_iscfunction(lua, index) != 0)
        return refuse("the condition is not written in Lua");
    lua_Debug info;
    lua_pushvalue(lua, index);
    if (lua_getinfo(lua, ">Su", &info) == 0 || info.source == nullptr || *info.source == '\0') return false;
    const SyntaxTree* const tree = texts_.tree(info.source + 1);
    if (tree == nullptr)
        return refuse(fmt::format("the text of {}, which defines the condition, is unknown", info.source + 1));
    ObservedSource source = observe_function(*tree,
                                             {.first_line = info.linedefined,
                                              .last_line = info.lastlinedefined,
                                              .parameters = info.nparams,
                                              .takes_more = info.isvararg != 0},
                                             hook_name);
    if (source.text.empty()) return refuse(source.why);
    if (source.observed.decisions.empty()) return refuse("the condition returns nothing");
    const std::vector<std::string> names = upvalues_of(lua, index);
    std::string locals = fmt::format("local {}", hook_name);
    for (const std::string& name : names) {
        if (name.empty() || name == hook_name) return false;
        if (name != "_ENV") locals += ", " + name;
    }
    const std::string text = " " + source.constants + "return " + source.text;
    if (!knows_all_names(locals + text)) return refuse("the condition uses a <const> whose value is not a literal");
    if (contains(names, "_ENV")) locals += ", _ENV";
    const std::string lines(static_cast<std::size_t>(std::max(0, info.linedefined - 1)), '\n');
    const auto chunk = compile(lines + locals + text, info.source + 1);
    if (!chunk || !load_chunk(lua, *chunk) || !protected_call(lua, 0, 1, condition_budget))
        return refuse("the condition can't be compiled again");

    const int copy = lua_gettop(lua);
    const std::vector<std::string> copied = upvalues_of(lua, copy);
    for (std::size_t i = 0; i < copied.size(); ++i) {
        const auto at = static_cast<int>(i + 1);
        if (copied[i] == hook_name) {
            const auto pushed = protect(lua, condition_budget, [&function](lua_State* inside) {
                lua_pushlightuserdata(inside, &function);
                lua_pushcclosure(inside, hook, 1);
                return 1;
            });
            if (!pushed || lua_setupvalue(lua, copy, at) == nullptr) return false;
            continue;
        }
        const auto original = std::find(names.begin(), names.end(), copied[i]);
        if (original == names.end()) return false;
        lua_upvaluejoin(lua, copy, at, index, static_cast<int>(original - names.begin()) + 1);
    }
    function.observed = std::move(source.observed);
    return true;
}

// The observed function in place of the one at `index`; null if it can't be observed.
Condition::Function* Condition::helper(lua_State* lua, int index) {
    const void* const address = lua_topointer(lua, index);
    const auto known = helpers_.find(address);
    if (known != helpers_.end()) return known->second.get();
    if (helpers_.size() == most_helpers) return nullptr;
    const int top = lua_gettop(lua);
    auto function = std::make_unique<Function>();
    function->owner = this;
    std::string own_why = std::move(why_);
    const bool made = observe(lua, index, *function) && keep(lua, function.get());
    why_ = std::move(own_why);
    lua_settop(lua, top);
    if (!made) function.reset();
    lua_pushvalue(lua, index);
    const bool kept = keep(lua, function != nullptr ? static_cast<const void*>(&function->original) : address);
    lua_settop(lua, top);
    if (!kept) return nullptr;
    return helpers_.emplace(address, std::move(function)).first->second.get();
}

// Upvalue: the `Function` whose code calls the hook.
int Condition::hook(lua_State* lua) {
    auto& function = *static_cast<Function*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const auto code = static_cast<std::size_t>(lua_tointeger(lua, 1));
    const std::size_t index = code / hook_calls;
    switch (static_cast<HookCall>(code % hook_calls)) {
        case HookCall::compare: return compare(lua, function.observed.comparisons[index]);
        case HookCall::call: return function.owner->called(lua, function.observed.comparisons[index]);
        case HookCall::contact:
            return function.owner->take_contact(lua, function.observed.comparisons[index], function);
        case HookCall::value: function.owner->take_value(lua, function.observed.comparisons[index]); break;
        case HookCall::path: return function.owner->read_path(lua, function.observed.paths[index]);
        case HookCall::decide: function.observed.decide(index, lua_toboolean(lua, 2) != 0); break;
    }
    return lua_gettop(lua) - 1;
}

int Condition::compare(lua_State* lua, Comparison& comparison) {
    using enum Comparison::Operator;
    bool result = false;
    switch (comparison.op) {
        case less: result = lua_compare(lua, 2, 3, LUA_OPLT) != 0; break;
        case less_equal: result = lua_compare(lua, 2, 3, LUA_OPLE) != 0; break;
        case greater: result = lua_compare(lua, 3, 2, LUA_OPLT) != 0; break;
        case greater_equal: result = lua_compare(lua, 3, 2, LUA_OPLE) != 0; break;
        case equal: result = lua_compare(lua, 2, 3, LUA_OPEQ) != 0; break;
        case unequal: result = lua_compare(lua, 2, 3, LUA_OPEQ) == 0; break;
        case truth: break;
    }
    comparison.evaluated = true;
    comparison.result = result;
    comparison.decided = &comparison;
    comparison.has_numbers = lua_type(lua, 2) == LUA_TNUMBER && lua_type(lua, 3) == LUA_TNUMBER;
    comparison.robustness = of_result(result);
    if (comparison.has_numbers) {
        comparison.left_value = number_at(lua, 2);
        comparison.right_value = number_at(lua, 3);
        comparison.robustness = robustness_of(comparison.op, comparison.left_value, comparison.right_value, result);
    }
    lua_pushboolean(lua, result ? 1 : 0);
    return 1;
}

// Pushes the function to call instead of the one at index 2.
int Condition::called(lua_State* lua, const Comparison& comparison) {
    const int type = lua_type(lua, 2);
    if (type != LUA_TFUNCTION && luaL_getmetafield(lua, 2, "__call") == LUA_TNIL) {
        if (comparison.called == "?") return luaL_error(lua, "attempt to call a %s value", luaL_typename(lua, 2));
        return luaL_error(lua, "attempt to call a %s value (%s)", luaL_typename(lua, 2), comparison.called.c_str());
    }
    lua_settop(lua, 2);
    Function* found = nullptr;
    if (type == LUA_TFUNCTION && lua_iscfunction(lua, 2) == 0 && depth_ < deepest) found = helper(lua, 2);
    // A function that calls itself is observed once.
    if (found != nullptr && found->is_called) found = nullptr;
    if (depth_ < deepest) calls_[depth_] = found;
    ++depth_;
    if (found == nullptr) return 1;
    found->is_called = true;
    found->observed.begin();
    lua_rawgetp(lua, LUA_REGISTRYINDEX, found);
    return 1;
}

void Condition::take_value(lua_State* lua, Comparison& value) {
    value.evaluated = true;
    value.result = lua_toboolean(lua, 2) != 0;
    value.robustness = of_result(value.result);
    value.decided = &value;
    if (value.called.empty() || depth_ == 0) return;
    --depth_;
    Function* const function = depth_ < deepest ? calls_[depth_] : nullptr;
    if (function == nullptr) return;
    function->is_called = false;
    const Robustness within = function->observed.finish(value.result);
    value.robustness = within.value;
    if (within.decided != nullptr) value.decided = within.decided;
}

// Pushes X.collided of the X at index 2.
int Condition::take_contact(lua_State* lua, Comparison& value, const Function& function) {
    const int type = lua_type(lua, 2);
    const bool is_indexed = type == LUA_TUSERDATA || type == LUA_TTABLE;
    if (!is_indexed && luaL_getmetafield(lua, 2, "__index") == LUA_TNIL)
        return luaL_error(lua, "attempt to index a %s value%s", luaL_typename(lua, 2), value.called.c_str());
    lua_settop(lua, 2);
    if (read_path(lua, "collided") == 0) lua_getfield(lua, 2, "collided");
    value.evaluated = true;
    value.result = lua_toboolean(lua, 3) != 0;
    value.robustness = of_result(value.result);
    value.decided = &value;
    // If the caller needs only robustnesses below `least`, the parts of `and`, `or` and `not` need no greater ones
    // either: the clearance is measured only up to there.
    const bool is_part = &function == own_.get() && function.observed.returns_only;
    const bool may_be_less = is_part && asked_ != nullptr && value.negated != asked_->opposite;
    const double most = may_be_less ? asked_->least : std::numeric_limits<double>::infinity();
    const auto clearance = texts_.clearance ? texts_.clearance(lua, 2, most) : std::nullopt;
    if (clearance) value.robustness = value.result ? 0.0 : 0.0 - *clearance;
    return 1;
}

// Pushes the number or boolean at a path of the object at index 2; returns 0 if there is none.
int Condition::read_path(lua_State* lua, std::string_view path) const {
    const auto scalar = texts_.scalar ? texts_.scalar(lua, 2, path) : std::nullopt;
    if (!scalar) return 0;
    push_payload(lua, *scalar);  // raises no error
    return 1;
}

tl::expected<bool, CallError> Condition::sample(lua_State* lua, const LeastAsked* asked) {
    asked_ = asked;
    depth_ = 0;
    if (own_ != nullptr) own_->observed.begin();
    for (const auto& [address, function] : helpers_) {
        if (function != nullptr) function->is_called = false;
    }
    if (lua_checkstack(lua, 4) == 0) return tl::unexpected(CallError{{"stack overflow"}, false});
    const int top = lua_gettop(lua);
    lua_rawgetp(lua, LUA_REGISTRYINDEX, this);
    if (auto called = protected_call(lua, 0, LUA_MULTRET, condition_budget); !called)
        return tl::unexpected(called.error());
    const bool nothing = lua_gettop(lua) == top;
    held_ = !nothing && lua_toboolean(lua, top + 1) != 0;
    lua_settop(lua, top);
    if (nothing) return tl::unexpected(CallError{{"the condition returned nothing: expected true or false"}, false});
    robustness_ = {of_result(held_), nullptr};
    if (own_ != nullptr) robustness_ = own_->observed.finish(held_);
    return held_;
}

std::string text_of_number(double number, std::string_view unit) {
    // Shows six digits; further digits are rounding errors.
    std::string text = fmt::format("{:.6g}", number);
    if (!unit.empty()) text.append(" ").append(unit);
    return text;
}

std::string why_without_numbers(const Robustness& robustness) {
    if (robustness.decided == nullptr) return "the condition returns a constant";
    const Comparison& decided = *robustness.decided;
    if (decided.op == Comparison::Operator::truth) return fmt::format("{} is true or false", decided.left);
    if (!decided.has_numbers) return fmt::format("{}: does not compare numbers", text_of(decided));
    return fmt::format("{}: the difference of its two sides is not finite", text_of(decided));
}

namespace {

// "mouse.truth.pose.position.x was 0.704 m".
std::string values_of(const Comparison& comparison) {
    std::string text =
        fmt::format("{} was {}", comparison.left, text_of_number(comparison.left_value, comparison.unit));
    // A literal is shown without its value.
    const bool literal = comparison.right.find_first_not_of("-.0123456789eExX") == std::string::npos;
    if (literal) return text;
    return text + fmt::format(", {} was {}", comparison.right, text_of_number(comparison.right_value, comparison.unit));
}

std::string reason_of(const Comparison& comparison) {
    using enum Comparison::Operator;
    std::string reason = text_of(comparison) + ": " + values_of(comparison);
    const double distance = std::abs(comparison.left_value - comparison.right_value);
    if (comparison.op != equal && comparison.op != unequal && std::isfinite(distance) && distance != 0)
        reason += fmt::format(", off the limit by {}", text_of_number(distance, comparison.unit));
    return reason;
}

}  // namespace

std::string Condition::reason() const {
    const Comparison* const decided = robustness_.decided;
    std::string reason;
    if (own_ != nullptr && own_->observed.returns_only) {
        for (const Comparison& comparison : comparisons()) {
            // If `a and b` is false, show the part that is false.
            if (!comparison.has_numbers || (comparison.result != comparison.negated) != held_) continue;
            reason += (reason.empty() ? "" : "; ") + reason_of(comparison);
        }
    }
    if (reason.empty() && decided != nullptr && decided->has_numbers) reason = reason_of(*decided);
    return reason;
}

}  // namespace nezumi
