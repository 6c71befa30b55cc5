// Each episode runs the environment's file again and calls the functions of this copy, so that it keeps nothing of an
// earlier episode.
#include "bindings/learning/episode.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/records/file_table.hpp"
#include "engine/system/system.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {
namespace {

// Time limit for one call of a Lua function [s].
constexpr Budget call_budget{2.0};

constexpr int deepest = 4;  // nesting of lists in an observation, at most

// Writes the numbers of nested lists one after the other into an array.
class Flattening {
public:
    Flattening(lua_State* lua, std::span<float> out) : lua_(lua), out_(out) {}

    std::size_t count() const { return count_; }

    // Adds the value at `index`. Returns "", or what is wrong. Raises no Lua error.
    std::string add(int index, int depth = 0) {
        switch (lua_type(lua_, index)) {
            case LUA_TNUMBER: return put(lua_tonumber(lua_, index));
            case LUA_TBOOLEAN: return put(lua_toboolean(lua_, index));
            case LUA_TTABLE: break;
            default: return fmt::format("expected numbers, got a {}", lua_typename(lua_, lua_type(lua_, index)));
        }
        if (depth == deepest || lua_checkstack(lua_, 4) == 0) return "lists are nested too deeply";
        index = lua_absindex(lua_, index);
        if (push_behind_lock(lua_, index)) {
            std::string problem = add(-1, depth);
            lua_pop(lua_, 1);
            return problem;
        }
        for (lua_Integer i = 1;; ++i) {
            if (lua_rawgeti(lua_, index, i) == LUA_TNIL) {
                lua_pop(lua_, 1);
                return "";
            }
            std::string problem = add(-1, depth + 1);
            lua_pop(lua_, 1);
            if (!problem.empty()) return problem;
        }
    }

private:
    std::string put(double number) {
        if (std::isnan(number)) return fmt::format("number {} is NaN", count_ + 1);
        if (count_ < out_.size()) out_[count_] = static_cast<float>(number);
        ++count_;
        return "";
    }

    lua_State* lua_;
    std::span<float> out_;
    std::size_t count_ = 0;
};

}  // namespace

Episode::~Episode() = default;

Expected<std::unique_ptr<Episode>> Episode::begin(const EpisodePlan& plan, std::uint64_t seed,
                                                  const std::function<void(RunningSystem&)>& loaded) {
    std::unique_ptr<Episode> episode(new Episode);
    if (auto ok = episode->load(plan, seed); !ok) return Unexpected(ok.error());
    if (loaded) loaded(*episode->live_);
    episode->live_->activate();
    if (episode->file_->has(EnvironmentFunction::reset)) {
        if (auto ok = episode->call(EnvironmentFunction::reset); !ok) return Unexpected(ok.error());
        lua_settop(episode->file_->state().lua(), 0);
    }
    if (auto ok = episode->tick(); !ok) return Unexpected(ok.error());  // so that the sensors have measured once
    return episode;
}

Expected<void> Episode::load(const EpisodePlan& plan, std::uint64_t seed) {
    auto file = EnvironmentFile::read(plan.source, plan.project, mix(seed, "environment"), plan.print);
    if (!file) return Unexpected(file.error());
    file_ = std::move(*file);
    const auto path = file_->find_system(plan.project);
    if (!path) return Unexpected(path.error());
    LiveOptions options = plan.systems();
    options.build.seed = seed;
    options.build.seed_wins = true;
    options.build.out_of_time_is_fatal = true;
    options.budget = headless_budget;
    options.watch = false;
    options.print = plan.print;
    if (file_->has(EnvironmentFunction::start)) {
        auto values = start_values();
        if (!values) return Unexpected(values.error());
        options.values = std::move(*values);
    }
    auto live = RunningSystem::load(*path, std::move(options));
    if (!live) return Unexpected(live.error());
    live_ = std::move(*live);
    auto objects = Objects::open(
        file_->state(), [this]() -> RunningSystem& { return *live_; }, Actor{Actor::Kind::run});
    if (!objects) return Unexpected(objects.error());
    objects_ = std::move(*objects);
    return {};
}

Expected<StartValues> Episode::start_values() {
    constexpr auto start = EnvironmentFunction::start;
    lua_State* lua = file_->state().lua();
    EnvironmentFile::push(lua, start);
    if (const auto called = protected_call(lua, 0, 1, call_budget); !called)
        return Unexpected(file_->to_error(start, called.error()));
    const auto value = read_file_value(lua, -1);
    lua_settop(lua, 0);
    if (!value) return Unexpected(file_->to_error(start, value.error()));
    const auto* table = value->get_if<FileTable>();
    if (table == nullptr || !table->elements.empty()) {
        const Error error{fmt::format("expected a table as {{ [\"controller.speed_x\"] = 0.3 }}, got {}",
                                      table == nullptr ? "a " + kind_of(*value) : "a list")};
        return Unexpected(file_->to_error(start, error));
    }
    StartValues values;
    for (const FileField& field : table->fields) values.set.push_back(field.name + "=" + to_lua(field.value));
    return values;
}

Expected<void> Episode::tick() {
    live_->tick();
    const System& system = std::as_const(*live_).system();
    if (const auto& error = system.fatal_error()) return Unexpected(*error);
    for (const auto& component : system.components()) {
        if (component->state() != LifeState::error) continue;
        const Error& error = component->last_error();
        return failure(fmt::format("{} went to ERROR: {}", component->name(), one_line(error.message)), error.place);
    }
    return {};
}

Expected<void> Episode::call(EnvironmentFunction function, std::span<const float> action) {
    lua_State* lua = file_->state().lua();
    // Pushing may run out of memory.
    auto called = protect(lua, call_budget, [&](lua_State* inside) {
        EnvironmentFile::push(inside, function);
        objects_->push_system(inside, *live_);
        if (environment_functions[static_cast<std::size_t>(function)].arguments < 2) return 2;
        lua_createtable(inside, static_cast<int>(action.size()), 0);
        for (std::size_t i = 0; i < action.size(); ++i) {
            lua_pushnumber(inside, static_cast<double>(action[i]));
            lua_rawseti(inside, -2, static_cast<lua_Integer>(i) + 1);
        }
        return 3;
    });
    if (called) called = protected_call(lua, lua_gettop(lua) - 1, 1, call_budget);
    if (!called) return Unexpected(file_->to_error(function, called.error()));
    return {};
}

Expected<double> Episode::number(EnvironmentFunction function, std::span<const float> action) {
    if (auto ok = call(function, action); !ok) return Unexpected(ok.error());
    lua_State* lua = file_->state().lua();
    double number = 0;
    const bool is_number = detail::read_number(lua, -1, std::numeric_limits<double>::max(), number, nullptr);
    const std::string got = lua_type(lua, -1) == LUA_TNUMBER
                                ? fmt::format("{}", number_at(lua, -1))
                                : fmt::format("a {}", lua_typename(lua, lua_type(lua, -1)));
    lua_settop(lua, 0);
    if (!is_number)
        return Unexpected(file_->to_error(function, Error{fmt::format("expected a finite number, got {}", got)}));
    return number;
}

Expected<void> Episode::observe(std::span<float> observation) {
    constexpr auto function = EnvironmentFunction::observe;
    if (auto ok = call(function); !ok) return ok;
    lua_State* lua = file_->state().lua();
    Flattening numbers(lua, observation);
    std::string problem = numbers.add(-1);
    lua_settop(lua, 0);
    if (problem.empty() && numbers.count() != observation.size())
        problem =
            fmt::format("expected {} numbers, as 'observation' declares, got {}", observation.size(), numbers.count());
    if (!problem.empty()) return Unexpected(file_->to_error(function, Error{std::move(problem)}));
    return {};
}

Expected<StepResult> Episode::step(std::span<const float> action, std::span<float> observation) {
    if (auto ok = call(EnvironmentFunction::act, action); !ok) return Unexpected(ok.error());
    lua_settop(file_->state().lua(), 0);
    for (std::int64_t i = 0; i < spec().ticks; ++i) {
        if (auto ok = tick(); !ok) return Unexpected(ok.error());
    }
    if (auto ok = observe(observation); !ok) return Unexpected(ok.error());
    const auto reward = number(EnvironmentFunction::reward, action);
    if (!reward) return Unexpected(reward.error());
    StepResult result{*reward};
    if (file_->has(EnvironmentFunction::terminated)) {
        if (auto ok = call(EnvironmentFunction::terminated); !ok) return Unexpected(ok.error());
        lua_State* lua = file_->state().lua();
        const bool is_boolean = lua_type(lua, -1) == LUA_TBOOLEAN;
        const std::string_view kind = lua_typename(lua, lua_type(lua, -1));
        result.terminated = is_boolean && lua_toboolean(lua, -1) != 0;
        lua_settop(lua, 0);
        if (!is_boolean) {
            const Error error{fmt::format("expected true or false, got {}", kind)};
            return Unexpected(file_->to_error(EnvironmentFunction::terminated, error));
        }
    }
    return result;
}

}  // namespace nezumi
