// One version of a script: its own Lua state, and what the file declared when it was loaded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <lua.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/state.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"
#include "bindings/lua/script/probes.hpp"
#include "bindings/lua/script/script_chunk.hpp"
#include "bindings/lua/script/tasks.hpp"
#include "bindings/lua/values/plain_data.hpp"
#include "engine/components/component.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

class Script;

/// What a script is loaded for.
struct ScriptContext {
    std::string component;                             ///< its name
    std::uint64_t seed = 0;                            ///< of the run
    int version = 1;                                   ///< the number this version will have
    Budget budget = paced_budget;                      ///< of every call into the script, its loading included
    std::size_t memory_limit = std::size_t{64} << 20;  ///< [bytes]
    ModuleFinder find_module;                          ///< empty: there are no modules
    ChunkCache* chunks = nullptr;  ///< shares compiled code among components; may be null, must outlive them
    ParameterValues configured;    ///< values of a system file, so that the file's top level reads them
    double tick_rate = 100;        ///< [Hz]; `dt` before the first execution
    double seconds = 0;            ///< `now()` while it loads
    std::vector<Error>* diagnostics = nullptr;  ///< takes what is wrong with declarations, and loading goes on; null:
                                                ///< the first ends it
};

/// `input(...)` or `output(...)`.
struct PortDeclaration {
    Direction direction = Direction::in;
    std::string name;
    std::size_t type = 0;  ///< in `message_types`
    std::string doc;
    std::size_t queue = 0;    ///< of an in-port
    std::vector<Value> safe;  ///< of an out-port, if it has one: a payload is large
    Place place;

    /// A port that fits this declaration.
    bool fits(const Port& port) const {
        return port.direction() == direction && port.name() == name && port.type() == type;
    }
};

/// What a port object in Lua refers to. Its address is in the object and in its methods.
struct PortSlot {
    Script* script = nullptr;
    const PortDeclaration* declaration = nullptr;
    const void* object = nullptr;  ///< the Lua object, to know it by
    Port* port = nullptr;          ///< null while the file loads
    bool live = false;             ///< it may be read and written: the version is the one that runs
};

/// `about { ... }`.
struct ScriptAbout {
    std::string version, vendor, category;
    bool given = false;
};

/// What a version takes over from the one before it; all may be null.
struct Inheritance {
    const Parameters* parameters = nullptr;       ///< values that somebody set and that still fit are kept
    const PlainData* state = nullptr;             ///< the contents of `state`
    std::vector<ScriptFile>* required = nullptr;  ///< is told of every module that is required
    /// `state` comes later, by `take_state_over`: set where the top level looks at it before, or at the time.
    bool* looks_at_tick = nullptr;
};

class Script {
public:
    /// Runs the top level of a file, which declares and does not act. May run beside the tick.
    static Expected<std::unique_ptr<Script>> load(const SourceText& source, ScriptContext context,
                                                  const Inheritance& inheritance = {});

    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;

    /// Where it came from; the text itself is let go.
    const ScriptFile& file() const { return file_; }
    const ScriptContext& context() const { return context_; }
    /// The text of it, or of a module, as messages call them; "" where that is not known any more.
    std::string text_of(std::string_view shown) const;
    /// The files that `require` loaded, directly or not.
    const std::vector<ScriptFile>& modules() const { return modules_; }
    const std::list<PortDeclaration>& ports() const { return ports_; }
    std::list<PortSlot>& slots() { return slots_; }
    const std::vector<CommandDeclaration>& commands() const { return commands_; }
    const ScriptAbout& about() const { return about_; }
    /// The comment that its file begins with.
    const std::string& doc() const { return doc_; }
    Tasks& tasks() { return tasks_; }
    const Tasks& tasks() const { return tasks_; }
    Probes& probes() { return probes_; }
    const Probes& probes() const { return probes_; }
    bool has(Hook hook) const { return hooks_[static_cast<std::size_t>(hook)] != LUA_NOREF; }
    /// The component's while this version is live; before, as the file declares them.
    Parameters& parameters();
    /// What the file declares, to be given to the component.
    Parameters take_parameters() { return std::exchange(parameters_, {}); }

    /// From now on the script sees this component's time and name. Its ports can't be written until `go_live`.
    void bind(Component& owner);
    /// What every call may use up from now on.
    void set_budget(Budget budget) { context_.budget = budget; }
    /// Where the code is that it shares from now on.
    void share(ChunkCache* chunks) { context_.chunks = chunks; }
    /// Notes that loaded in another tick it could be another.
    void note_look_at_tick() {
        if (inheritance_.looks_at_tick != nullptr) *inheritance_.looks_at_tick = true;
    }
    /// Gives it the `state` that was to come later.
    Expected<void> take_state_over(const PlainData& state);
    /// Opens the ports, or closes them: whether this version is the one that runs. Their slots must be filled.
    void go_live(bool live);

    /// The part of a budget that is kept for `on_aborting`: the hooks of a tick have one budget, not one each.
    static constexpr double reserve = 0.1;
    /// Calls a callback; nothing when the script has none. Tasks start with `on_activated`, run a slice before
    /// `on_execute`, and end before the others.
    Expected<void> call(Hook hook);
    /// Whether the call that failed last used more than the reserve: then only that is left of the tick's budget.
    bool has_used_its_tick() const { return failed_seconds_ > context_.budget.seconds * reserve; }
    /// Calls `on_reload(old_version)`.
    Expected<void> call_on_reload(int old_version);
    /// Calls a command with copies of these arguments; its results are copies.
    Expected<PlainData> call_command(std::string_view name, const PlainData& arguments);
    /// A copy of the script's `state`; what is no plain data is listed in `dropped`.
    Expected<PlainData> take_state(std::vector<Dropped>& dropped);
    /// As much of `state` as a limit allows.
    Expected<PlainSnapshot> state_snapshot(const PlainLimit& limit, std::vector<Dropped>* dropped = nullptr);
    /// `set_plain` of `state`.
    Expected<void> set_state(const PlainData& data);

    /// [bytes] that its Lua state uses.
    std::size_t memory() const { return lua_->memory(); }
    /// Log lines of the top level, which nobody could be told yet.
    /// What one execution may write into all its ports, and say in the log. The engine keeps it outside of the script's
    /// own memory.
    static constexpr std::size_t most_written_bytes = std::size_t{64} << 20;
    static constexpr std::size_t most_logged_bytes = std::size_t{1} << 20;
    /// Counts so many bytes as written in this execution. False when they are too many.
    bool may_write(std::size_t bytes) {
        written_bytes_ += bytes;
        return written_bytes_ <= most_written_bytes;
    }
    std::vector<std::pair<LogLevel, std::string>> take_early_log() { return std::exchange(early_log_, {}); }

    // What the functions that scripts call use. Errors are texts without a place.

    enum class Phase { loading, bound, live };
    Phase phase() const { return phase_; }
    Component* owner() const { return owner_; }
    lua_State* lua() const { return lua_->lua(); }
    double seconds() const { return owner_ != nullptr ? owner_->now().seconds : context_.seconds; }
    double dt() const;
    void log(LogLevel level, std::string text);

    /// An element that is not there, read of what a port gave: an error of the same line tells of it.
    struct MissingElement {
        CallRecord::ScriptPlace place;
        lua_Integer index = 0;
        std::size_t count = 0;  ///< of the elements that are there
        const PortDeclaration* port = nullptr;
    };
    void note_missing(const MissingElement& element) { missing_ = element; }

    Expected<PortSlot*> declare_port(PortDeclaration declaration);
    Expected<void> declare_parameter(ParameterSpec spec);
    /// `function` is a registry reference.
    Expected<void> declare_command(CommandDeclaration declaration, int function);
    Expected<void> declare_about(ScriptAbout about);
    Expected<void> declare_task(Task task);
    /// Tasks can be started and cancelled now.
    Expected<void> check_tasks_run(std::string_view function) const;
    /// The hook that may be defined by this global now, with a value of this Lua type.
    Expected<std::size_t> check_hook(std::string_view name, std::string_view type) const;
    void set_hook(std::size_t hook, int function, int line);
    /// The registry reference of a callback; LUA_REFNIL when it is not defined, LUA_NOREF when there is no such
    /// callback.
    int hook_function(std::string_view name) const;
    /// Finds and compiles a module; `module_chunk` is then its code, to be run before `end_module`, however it ends.
    Expected<void> begin_module(std::string_view name);
    void end_module();
    const Chunk& module_chunk() const { return module_chunk_; }

private:
    struct LoadingModule {
        std::string name;
        std::string path;
    };

    Script(const SourceText& source, ScriptContext context);
    template <class Body>
    std::invoke_result_t<Body, lua_State*> with_state(Body&& body);
    Expected<void> run_top_level(const SourceText& source);
    Expected<void> check_loading(std::string_view function) const;
    Expected<void> check_name(std::string_view kind, std::string_view name, bool keyword_allowed) const;
    // What comes before each call: shows parameters that have changed, and counts anew.
    Expected<void> begin_call();
    static int call_with_tasks(lua_State* L);
    /// Takes back what waits in out-ports that have a safe value.
    void discard_unsafe();
    Expected<ScriptCode> compile(const SourceText& source, ScriptKind kind) const;
    // Each parameter that the file reads and did not declare: it would fail when that line runs for the first time.
    Expected<void> check_parameters(const std::vector<ParameterUse>& uses) const;
    Error to_error(const CallError& error) const;
    std::string hint(const Error& error) const;

    ScriptFile file_;
    std::string doc_;
    ScriptContext context_;
    Inheritance inheritance_;  // while it loads
    std::vector<ScriptFile> modules_;
    std::vector<LoadingModule> loading_modules_;
    std::optional<Error> module_error_;
    Chunk module_chunk_;
    std::list<PortDeclaration> ports_;
    std::list<PortSlot> slots_;
    std::vector<CommandDeclaration> commands_;
    std::vector<int> command_functions_;  // registry references, as `commands_`
    ScriptAbout about_;
    Probes probes_;
    Parameters parameters_;
    std::array<int, 9> hook_lines_{};
    std::vector<std::pair<LogLevel, std::string>> early_log_;
    double failed_seconds_ = 0;  // of CPU time, that the last call that failed had used
    MissingElement missing_{};   // the last one, in this execution
    // From here on, and of the last one its port, is what every tick looks at.
    Tasks tasks_;
    std::array<int, 9> hooks_{};     // registry references, by Hook
    std::size_t written_bytes_ = 0;  // in this execution
    std::size_t logged_bytes_ = 0;   // likewise
    Component* owner_ = nullptr;
    Phase phase_ = Phase::loading;
    bool was_activated_ = false;         // in this version
    std::uint64_t seen_parameters_ = 0;  // version of the parameters that `config` shows
    std::unique_ptr<LuaState> lua_;      // last: dies first
};

}  // namespace nezumi
