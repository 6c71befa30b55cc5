// Runs the function of a scenario and gives the result.
#include "bindings/scenario/scenario_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "bindings/scenario/scenario_methods.hpp"
#include "engine/ports/payload.hpp"
#include "engine/system/perform.hpp"

namespace nezumi {
namespace {

// Time limit of the scenario's own code, without its conditions and without waiting.
constexpr Budget scenario_budget{2.0};
constexpr std::size_t most_printed = std::size_t{64} << 10;  // [bytes]

}  // namespace

std::uint64_t seed_of(std::uint64_t seed, std::string_view scenario) { return mix(seed, scenario); }

ScenarioRun::ScenarioRun(ScenarioFile& file, std::size_t scenario, RunSettings settings)
    : file_(file),
      scenario_(file.scenarios()[scenario]),
      index_(scenario),
      settings_(std::move(settings)),
      function_texts_([&file](const std::string& shown) { return file.text(shown); }) {
    worlds_.show_to(settings_.spectator);
}

ScenarioRun::~ScenarioRun() = default;

void ScenarioRun::print(std::string_view line) {
    if (printed_bytes_ > most_printed) return;
    printed_bytes_ += line.size() + 1;
    if (printed_bytes_ > most_printed) line = "... (the rest is omitted)";
    std::string_view rest = line;  // a table may have several lines
    for (std::size_t end = 0; (end = rest.find('\n')) != std::string_view::npos; rest.remove_prefix(end + 1))
        result_.printed.emplace_back(rest.substr(0, end));
    result_.printed.emplace_back(rest);
}

Expected<void> ScenarioRun::open() {
    LuaState& state = file_.state();
    state.set_print([this](std::string_view line) { print(line); });
    state.seed_random(seed_of(settings_.seed, scenario_.name));
    word_host_.all = system_words(file_.peer_words());
    word_host_.source = [this](const std::string& shown) { return file_.source(shown); };
    word_host_.fail = [this](Error error) {
        setup_error_ = error;
        return error;
    };
    auto objects = Objects::open(
        state, [this]() -> RunningSystem& { return current(); }, scenario_actor);
    if (!objects) return Unexpected(objects.error());
    objects_ = std::move(*objects);
    objects_->set_prepare([this] { return settle_or_note(); });
    objects_->set_prepare_change([this]() -> Expected<void> {
        if (!sampling_) return {};
        setup_error_ = Error{"a condition can only read values: only the scenario itself can set parameters"};
        return Unexpected(*setup_error_);
    });
    word_host_.push_entry = [this](lua_State* lua, std::string_view name) {
        objects_->push_component(lua, described_.back().live, name);
    };
    word_host_.port_path = [this](lua_State* lua, int index) -> Expected<std::optional<std::string>> {
        const ObjectRef* port = to_object(lua, index, ObjectKind::port);
        if (port == nullptr) return std::nullopt;
        auto path = fmt::format("{}.{}", port->component(), port->port());
        if (described_.empty() || port->live() != described_.back().live)
            return failure(fmt::format(
                "{} belongs to another world: functions like s:behavior add only to the world that was loaded last",
                path));
        return std::optional(std::move(path));
    };
    objects_->on_read([this](const PortAt& port) {
        constexpr std::size_t most = 32;
        if (read_ports_.size() < most) read_ports_.push_back(port);
    });
    function_texts_.clearance = [this](lua_State* lua, int index, double most) { return clearance(lua, index, most); };
    function_texts_.scalar = [this](lua_State* lua, int index, std::string_view path) {
        return objects_->scalar_at(lua, index, path);
    };
    return {};
}

std::optional<double> ScenarioRun::clearance(lua_State* lua, int index, double most) const {
    const auto at = objects_->component_of(lua, index);
    if (!at) return std::nullopt;
    const auto seen = seen_robot(at->live->system(), *at->component);
    return seen ? seen->world->clearance(seen->id, std::min(most, World::most_clearance)) : std::nullopt;
}

RunResult ScenarioRun::run() {
    const auto began = std::chrono::steady_clock::now();
    lua_State* lua = file_.state().lua();
    if (settings_.coverage != nullptr) covered_scripts_ = covered_scripts(*settings_.coverage);
    if (auto ok = open(); !ok) {
        stop(RunOutcome::could_not_run, ok.error());
    } else {
        auto called = protect(lua, Budget{10}, [this](lua_State* inside) {
            file_.push_function(inside, index_);
            Methods::push_object(inside, *this);
            lua_createtable(inside, 0, static_cast<int>(settings_.point.size()));
            for (const auto& [name, value] : settings_.point) {
                const auto is_its = [&name = name](const SweepKey& key) { return key.name == name; };
                if (std::none_of(scenario_.sweep.keys.begin(), scenario_.sweep.keys.end(), is_its))
                    continue;  // a value of s:any, which is no value of the sweep
                lua_pushlstring(inside, name.data(), name.size());
                push_plain(inside, value.data);
                lua_rawset(inside, -3);
            }
            return 3;
        });
        if (called) called = protected_call(lua, 2, 0, scenario_budget);
        take_outcome(called);
    }
    finish();
    result_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return std::move(result_);
}

// Whether the Lua error is the one that a word or a method gave.
bool ScenarioRun::is_setup_error(const CallError& error) const {
    if (error.message.find(not_seen) != std::string::npos) return true;
    if (!file_.refused().empty() && error.message.find(file_.refused()) != std::string::npos) return true;
    return setup_error_ && one_line(error.message).find(setup_error_->message) != std::string::npos;
}

void ScenarioRun::take_outcome(const CallResult& called) {
    if (stopped_) return;
    if (!called) {
        const CallError& error = called.error();
        // The error of a word or of a system is the one that Lua raised, unless the scenario caught it.
        if (setup_error_ && is_setup_error(error)) return stop(RunOutcome::could_not_run, *setup_error_);
        Error plain{one_line(error.message), error.place};
        if (plain.place.file.empty()) plain.place = scenario_.place;
        const bool could_not = error.over_budget || is_setup_error(error);
        return stop(could_not ? RunOutcome::could_not_run : RunOutcome::failed, std::move(plain));
    }
    if (auto ok = settle(); !ok) return stop(RunOutcome::could_not_run, ok.error());
    if (!check_components()) return;
    // A condition that was added after the last tick is evaluated once now, because it must be able to fail.
    for (const auto& watch : watches_) {
        if (!watch->sampled && !sample(file_.state().lua(), *watch)) return;
    }
    for (std::size_t i = 0; i < goldens_.size(); ++i) {
        const bool update = settings_.update_goldens;
        if (auto same = goldens_[i].finish(update); !same) return stop(RunOutcome::failed, same.error());
        if (update) result_.goldens[i].written = goldens_[i].fingerprint();
    }
}

std::string_view ScenarioRun::values() const {
    std::string_view name = settings_.name;
    name.remove_prefix(std::min(name.size(), scenario_.name.size()));
    if (name.starts_with(' ')) name.remove_prefix(1);
    return name;
}

void ScenarioRun::finish() {
    const auto tell = [this](const Watched& watched) {
        result_.margins.push_back(watched.margin.result(watched.expectation, watched.condition->why()));
    };
    for (const auto& watched : watches_) tell(*watched);
    for (const auto& watched : waits_) tell(*watched);
    if (result_.outcome == RunOutcome::failed && !result_.drawn.empty()) {
        std::string values;
        for (const DrawnValue& value : result_.drawn)
            values += fmt::format("{}{}={}", values.empty() ? "" : ", ", value.name, value.text);
        result_.facts.push_back("s:any drew " + values);
    }
    worlds_.stop_robots();
    result_.seconds = worlds_.now();
    result_.hash = worlds_.trace_hash();
    if (settings_.spectator != nullptr) settings_.spectator->ended(result_);
    if (settings_.coverage != nullptr) result_.coverage = settings_.coverage->take();
    result_.reads.insert(result_.reads.end(), file_.files().begin(), file_.files().end());
    if (settings_.files == nullptr) return;
    RunFiles::Kept kept = settings_.files->finish(settings_.name);
    result_.files = std::move(kept.names);
    for (const Error& problem : kept.problems) result_.facts.push_back(describe(problem));
}

}  // namespace nezumi
