// One version of a script. Loading: the top level runs in a fresh state and declares. Running: one protected call per
// callback.
#include "bindings/lua/script/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/script_config.hpp"
#include "bindings/lua/script/script_globals.hpp"
#include "bindings/lua/script/script_ports.hpp"
#include "bindings/lua/syntax/first_comment.hpp"
#include "bindings/lua/syntax/tail_calls.hpp"
#include "bindings/lua/values/set_plain.hpp"
#include "engine/base/list.hpp"
#include "engine/ports/payload.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

Script::Script(const SourceText& source, ScriptContext context)
    : file_(source), doc_(first_comment(source.text)), context_(std::move(context)) {
    hooks_.fill(LUA_NOREF);
}

Script::~Script() {
    if (coverage_ != nullptr) coverage_->remove(*lua_);
}

Expected<std::unique_ptr<Script>> Script::load(const SourceText& source, ScriptContext context,
                                               const Inheritance& inheritance) {
    auto script = std::unique_ptr<Script>(new Script(source, std::move(context)));
    Script* const self = script.get();
    const std::uint64_t seed = mix(mix(script->context_.seed, script->context_.component),
                                   static_cast<std::uint64_t>(script->context_.version));
    auto lua =
        create_sandbox({.memory_limit = script->context_.memory_limit,
                        .seed = seed,
                        .print = [self](std::string_view line) { self->log(LogLevel::info, std::string(line)); }},
                       Libraries::when_named);
    if (!lua) return Unexpected(lua.error());
    script->lua_ = std::move(*lua);
    if (script->context_.chunks != nullptr) script->coverage_ = script->context_.chunks->coverage();
    if (script->coverage_ != nullptr) script->coverage_->add(*script->lua_);
    script->lua_->set_hint([self](const Error& error) { return self->hint(error); });
    script->lua_->set_tail_calls(
        [self](std::string_view file, int first, int last) { return tail_calls_of(self->text_of(file), first, last); });
    script->inheritance_ = inheritance;
    auto ok = script->run_top_level(source);
    script->inheritance_ = {};
    script->context_.find_module = {};  // modules are loaded while the file loads
    script->context_.find_message = {};
    if (!ok) return Unexpected(std::move(ok.error()));
    return script;
}

Error Script::to_error(const CallError& error) const {
    Error plain{error.message, error.place, error.over_budget ? Error::Kind::out_of_time : Error::Kind::ordinary,
                error.frames};
    if (plain.place.file.empty()) plain.place.file = file_.shown;
    return plain;
}

Expected<std::shared_ptr<const ScriptCode>> Script::compile(const SourceText& source, ScriptKind kind) const {
    if (context_.chunks != nullptr) return context_.chunks->compile(source, kind);
    auto code = compile_script(source, kind);
    if (!code) return Unexpected(code.error().front());
    return std::make_shared<const ScriptCode>(std::move(*code));
}

Expected<void> Script::run_top_level(const SourceText& source) {
    lua_State* L = lua_->lua();
    auto compiled = compile(source, ScriptKind::component);
    if (!compiled) return Unexpected(compiled.error());
    code_ = std::move(*compiled);
    lua_->set_doubled_lines(file_.shown, code_->doubled_lines);
    auto installed = protect(L, context_.budget, [&](lua_State* inside) {
        install_globals(inside, *this);
        if (inheritance_.looks_at_tick == nullptr) set_state_global(inside, inheritance_.state);
        return 0;
    });
    if (!installed) return Unexpected(to_error(installed.error()));
    if (auto loaded = load_chunk(L, code_->chunk); !loaded) return Unexpected(to_error(loaded.error()));
    int arguments = 0;
    if (code_->covered != nullptr) {
        const auto pushed = protect(L, context_.budget, [this](lua_State* inside) {
            Coverage::push_marks(inside, *code_->covered);
            return 1;
        });
        if (!pushed) return Unexpected(to_error(pushed.error()));
        arguments = 1;
    }
    auto ran = protected_call(L, arguments, 0, context_.budget);
    if (!ran) {
        // The error of a module has its own location, not the line that requires it.
        if (module_error_ && ran.error().message.find(module_error_->message) != std::string::npos)
            return Unexpected(*module_error_);
        return Unexpected(to_error(ran.error()));
    }
    if (ports_.empty() && commands_.empty() && parameters_.all().empty() && tasks_.empty() &&
        std::all_of(hooks_.begin(), hooks_.end(), [](int function) { return function == LUA_NOREF; })) {
        return failure("the file declares nothing: no port, parameter, command, task or callback", {file_.shown});
    }
    if (auto ok = check_parameters(code_->parameters); !ok) return ok;
    lua_gc(L, LUA_GCCOLLECT);  // collects the garbage of loading; this runs no code of the script
    seen_parameters_ = parameters_.version();
    phase_ = Phase::bound;
    return {};
}

Expected<void> Script::check_parameters(const std::vector<ParameterUse>& uses) const {
    std::vector<Error>* const diagnostics = context_.diagnostics;
    // A wrong declaration declares nothing, so correct uses of its parameter would be reported too.
    if (diagnostics != nullptr && !diagnostics->empty()) return {};
    std::vector<std::string_view> names;
    for (const auto& parameter : parameters_.all()) names.push_back(parameter.spec.name);
    for (const ParameterUse& use : uses) {
        if (parameters_.find(use.name) != nullptr) continue;
        Error error{fmt::format("config: unknown parameter '{}'{}", shown(use.name), did_you_mean(use.name, names)),
                    {file_.shown, use.line, use.column}};
        if (diagnostics == nullptr) return Unexpected(std::move(error));
        diagnostics->push_back(std::move(error));
    }
    return {};
}

std::string Script::text_of(std::string_view shown) const {
    if (context_.chunks == nullptr) return "";
    if (file_.shown == shown) return context_.chunks->text_of(file_);
    const auto module =
        std::find_if(modules_.begin(), modules_.end(), [&](const ScriptFile& each) { return each.shown == shown; });
    return module != modules_.end() ? context_.chunks->text_of(*module) : "";
}

// Modules

Expected<void> Script::begin_module(std::string_view name) {
    if (phase_ != Phase::loading)
        return failure(fmt::format(
            "require '{}': modules are loaded while the file loads; call require at the top of the file", name));
    if (!context_.find_module) return failure(fmt::format("require '{}': this script can't load modules", name));
    std::string chain;
    for (const LoadingModule& loading : loading_modules_) {
        if (loading.name == name || !chain.empty()) chain += loading.name + " requires ";
    }
    if (!chain.empty())
        return failure(fmt::format("require '{}': the modules require each other: {}{}", name, chain, name));
    auto source = context_.find_module(name, loading_modules_.empty() ? file_.path : loading_modules_.back().path);
    if (!source) return failure(fmt::format("require '{}': {}", shown(name), source.error().message));
    if (inheritance_.required != nullptr) inheritance_.required->emplace_back(*source);
    auto code = compile(*source, ScriptKind::module);
    if (!code) {
        module_error_ = code.error();
        return failure(module_error_->message);
    }
    loading_modules_.push_back({std::string(name), source->path});
    modules_.emplace_back(*source);
    module_ = std::move(*code);
    return {};
}

Expected<const MessageType*> Script::find_message(std::string_view name) {
    if (!context_.find_message) return find_message_type(name);
    std::vector<SourceText> read;
    const auto found = context_.find_message(name, file_.path, &read);
    for (const SourceText& file : read) {
        if (inheritance_.required != nullptr) inheritance_.required->emplace_back(file);
        const ScriptFile used(file);
        add_once(modules_, used);
    }
    if (found) return found->type;
    // Errors in a message's file are reported at their own location.
    if (!found.error().place.file.empty() && !module_error_) module_error_ = found.error();
    return Unexpected(found.error());
}

int Script::push_module_marks(lua_State* lua) const {
    if (module_->covered == nullptr) return 0;
    Coverage::push_marks(lua, *module_->covered);
    return 1;
}

void Script::end_module() { loading_modules_.pop_back(); }

// Running

void Script::bind(Component& owner) { owner_ = &owner; }

void Script::go_live(bool live) {
    phase_ = live ? Phase::live : Phase::bound;
    for (PortSlot& slot : slots_) slot.live = live;
}

Parameters& Script::parameters() { return phase_ == Phase::live ? owner_->parameters() : parameters_; }

double Script::dt() const {
    const double given = owner_ != nullptr ? owner_->dt() : 0;
    if (given > 0) return given;
    return 1.0 / (owner_ != nullptr && owner_->rate > 0 ? owner_->rate : context_.tick_rate);
}

void Script::log(LogLevel level, std::string text) {
    // `abs`, because the time may also have gone back.
    if (std::abs(seconds() - logged_since_) >= 1) {
        logged_since_ = seconds();
        logged_bytes_ = 0;
    }
    if (logged_bytes_ > most_logged_bytes) return;
    logged_bytes_ += sizeof(std::string) + text.size();
    if (logged_bytes_ > most_logged_bytes) {
        level = LogLevel::warn;
        text = fmt::format("more than {} MB of log in one second: the rest of that second is dropped",
                           most_logged_bytes >> 20);
    }
    if (owner_ != nullptr) return owner_->log(level, std::move(text));
    early_log_.emplace_back(level, std::move(text));
}

Expected<void> Script::begin_call() {
    written_bytes_ = 0;
    missing_.port = nullptr;
    Parameters& now = parameters();
    if (now.version() == seen_parameters_) return {};
    auto ok = protect(lua(), context_.budget, [&](lua_State* L) {
        show_parameters(L, now);
        return 0;
    });
    if (!ok) return Unexpected(to_error(ok.error()));
    seen_parameters_ = now.version();
    return {};
}

void Script::discard_unsafe() {
    for (PortSlot& slot : slots_) {
        auto* out = slot.port != nullptr && slot.port->direction() == Direction::out
                        ? static_cast<OutPortBase*>(slot.port)
                        : nullptr;
        if (out != nullptr && out->has_safe()) out->discard();
    }
}

// Lua arguments: the script, the callback. The script may not have defined this callback.
int Script::call_with_tasks(lua_State* L) {
    auto& script = *static_cast<Script*>(lua_touserdata(L, 1));
    const auto hook = static_cast<Hook>(lua_tointeger(L, 2));
    lua_settop(L, 0);
    if (hook == Hook::on_execute) {
        script.tasks_.run(L, script.seconds());
    } else {
        script.tasks_.end(L, script.seconds());
        // On a port with a safe value, this value is written, and not what tasks wrote while they were closed.
        if (hook == Hook::on_deactivated) script.discard_unsafe();
    }
    const int function = script.hooks_[static_cast<std::size_t>(hook)];
    if (function == LUA_NOREF) return 0;
    lua_rawgeti(L, LUA_REGISTRYINDEX, function);
    lua_call(L, 0, 0);
    return 0;
}

Expected<void> Script::call(Hook hook) {
    if (hook == Hook::on_activated) {
        was_activated_ = true;
        tasks_.start_all(seconds());
    }
    const int function = hooks_[static_cast<std::size_t>(hook)];
    const bool with_tasks = !tasks_.empty() && hook != Hook::on_activated && hook != Hook::on_error;
    if (function == LUA_NOREF && !with_tasks) return {};
    if (auto ok = begin_call(); !ok) return ok;
    lua_State* L = lua_->lua();
    if (with_tasks) {
        lua_pushcfunction(L, call_with_tasks);
        lua_pushlightuserdata(L, this);
        lua_pushinteger(L, static_cast<lua_Integer>(hook));
    } else {
        lua_rawgeti(L, LUA_REGISTRYINDEX, function);
    }
    Budget budget = context_.budget;
    if (hook == Hook::on_aborting && has_used_its_tick()) budget.seconds *= reserve;
    if (auto ok = protected_call(L, with_tasks ? 2 : 0, 0, budget); !ok) {
        failed_seconds_ = ok.error().used_seconds;
        return Unexpected(to_error(ok.error()));
    }
    return {};
}

Expected<void> Script::call_on_reload(int old_version) {
    const int function = hooks_[static_cast<std::size_t>(Hook::on_reload)];
    if (function == LUA_NOREF) return {};
    if (auto ok = begin_call(); !ok) return ok;
    lua_State* L = lua_->lua();
    lua_rawgeti(L, LUA_REGISTRYINDEX, function);
    lua_pushinteger(L, old_version);
    if (auto ok = protected_call(L, 1, 0, context_.budget); !ok) return Unexpected(to_error(ok.error()));
    return {};
}

Expected<PlainData> Script::call_command(std::string_view name, const PlainData& arguments) {
    const auto command =
        std::find_if(commands_.begin(), commands_.end(), [&](const auto& c) { return c.name == name; });
    if (command == commands_.end()) {
        return failure(fmt::format("unknown command '{}'{}", shown(name),
                                   did_you_mean(name, commands_, &CommandDeclaration::name)));
    }
    if (auto ok = begin_call(); !ok) return Unexpected(ok.error());
    lua_State* L = lua_->lua();
    const int before = lua_gettop(L);
    const int function = command_functions_[static_cast<std::size_t>(command - commands_.begin())];
    auto pushed = protect(L, context_.budget, [&](lua_State* inside) {
        lua_rawgeti(inside, LUA_REGISTRYINDEX, function);
        push_plain(inside, arguments);
        return lua_gettop(inside);
    });
    if (!pushed) return Unexpected(to_error(pushed.error()));
    auto called = protected_call(L, static_cast<int>(arguments.values.size()), LUA_MULTRET, context_.budget);
    if (!called) return Unexpected(to_error(called.error()));
    const int count = lua_gettop(L) - before;
    std::vector<std::string> names;
    for (int i = 1; i <= count; ++i) names.push_back(fmt::format("result {}", i));
    std::vector<Dropped> dropped;
    auto results = take_plain(L, count, context_.budget, names, dropped);
    lua_settop(L, before);
    if (!results) return results;
    if (!dropped.empty()) {
        return failure(fmt::format("command '{}': {} is {}, and only plain data can be returned", name,
                                   dropped.front().path, dropped.front().what),
                       command->place);
    }
    return results;
}

// Calls `body` with the table `state` on top of the stack.
template <class Body>
std::invoke_result_t<Body, lua_State*> Script::with_state(Body&& body) {
    lua_State* L = lua_->lua();
    const int before = lua_gettop(L);
    auto pushed = protect(L, context_.budget, [](lua_State* inside) {
        push_state(inside);
        return 1;
    });
    if (!pushed) return Unexpected(to_error(pushed.error()));
    auto result = body(L);
    lua_settop(L, before);
    return result;
}

Expected<PlainData> Script::take_state(std::vector<Dropped>& dropped) {
    // Copied between two ticks; a larger state would delay the tick too much.
    constexpr PlainLimit most{.values = 250'000, .text = std::size_t{16} << 20U};
    return with_state([&](lua_State* L) { return take_plain(L, 1, context_.budget, {"state"}, dropped, most); });
}

Expected<PlainSnapshot> Script::state_snapshot(const PlainLimit& limit, std::vector<Dropped>* dropped) {
    return with_state([&](lua_State* L) { return snapshot_plain(L, context_.budget, limit, "state", dropped); });
}

Expected<void> Script::set_state(const PlainData& data) {
    auto set = protect(lua_->lua(), context_.budget, [&](lua_State* inside) {
        push_state(inside);
        set_plain(inside, data);
        return 0;
    });
    return set ? Expected<void>() : Unexpected(to_error(set.error()));
}

Expected<void> Script::take_state_over(const PlainData& state) {
    auto set = protect(lua_->lua(), context_.budget, [&](lua_State* inside) {
        set_state_global(inside, &state);
        return 0;
    });
    return set ? Expected<void>() : Unexpected(to_error(set.error()));
}

namespace {

// Error messages of Lua for common mistakes in a first script, and the correct code.
constexpr std::pair<std::string_view, std::string_view> cures[] = {
    {"attempt to add a 'string' with", ".. joins strings in Lua"},
    {"attempt to perform arithmetic on a string value", ".. joins strings in Lua"},
    {"pairs' (table expected, got nil)", "was it set under this name? `x or {}` gives an empty table if x is nil"},
    {"attempt to call a table value (for iterator", "write `for i, value in ipairs(list) do`"},
    {"attempt to compare number with table", "a list is not a number: list[1] is its first element"},
    {"attempt to compare table with number", "a list is not a number: list[1] is its first element"},
    {" a port value", "a port is not its value: read it first, with `:read()`"},
};

}  // namespace

std::string Script::hint(const Error& error) const {
    const auto says = [&](std::string_view text) { return error.message.find(text) != std::string::npos; };
    // Lua has no name for an element: in its message the nil value is "field '?'", or has no name in a comparison or a
    // loop.
    const bool of_an_element = says("nil value (field '?')") || says("nil value (field 'integer index')") ||
                               (says("attempt to compare ") && says("nil")) || (says("bad 'for' ") && says("got nil)"));
    if (of_an_element && missing_.port != nullptr && missing_.place.line == error.place.line &&
        missing_.place.file == error.place.file) {
        return fmt::format(": there is no element {} among the {} of {}", missing_.index, missing_.count,
                           port_title(*missing_.port));
    }
    if (says("attempt to perform arithmetic on a string value") && !says("constant")) return "";
    for (const auto& [message, cure] : cures) {
        if (says(message)) return fmt::format(": {}", cure);
    }
    // A reload resets locals, and does not call on_activated again, which may have set them.
    if (was_activated_ || context_.version == 1 || !says("nil value (upvalue '")) return "";
    return "; a reload resets the file's locals and does not run on_activated again: set the variable at the "
           "top of the file or in on_reload, or keep its value in `state`";
}

}  // namespace nezumi
