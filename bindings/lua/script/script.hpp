// One version of a script: its Lua state, and the declarations of its file.
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
#include "engine/messages/message_files.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

class Script;

/// The context in which a script is loaded.
struct ScriptContext {
    std::string component;                             ///< the name of the component
    std::uint64_t seed = 0;                            ///< of the run
    int version = 1;                                   ///< the number of this version
    Budget budget = paced_budget;                      ///< of every call into the script, also of loading
    std::size_t memory_limit = std::size_t{64} << 20;  ///< [bytes]
    ModuleFinder find_module;                          ///< empty: there are no modules
    MessageFinder find_message;                        ///< empty: only message types that this program contains
    ChunkCache* chunks = nullptr;  ///< shares compiled code among components; may be null, must outlive them
    ParameterValues configured;    ///< parameter values of a system file, which the top level of the script can read
    double tick_rate = 100;        ///< [Hz] for `dt` before the first execution
    double seconds = 0;            ///< `now()` while the script loads
    std::vector<Error>* diagnostics = nullptr;  ///< gets the errors of declarations while loading continues; null:
                                                ///< the first error ends loading
};

/// `input(...)` or `output(...)`.
struct PortDeclaration {
    Direction direction = Direction::in;
    std::string name;
    const MessageType* type = nullptr;
    std::string doc;
    std::uint32_t queue = 0;  ///< length of the queue of an in-port
    std::vector<Value> safe;  ///< safe value of an out-port, if it has one; a vector because payloads are large
    Place place;

    /// Whether a port fits this declaration.
    bool fits(const Port& port) const {
        return port.direction() == direction && port.name() == name && port.type() == type;
    }
};

/// A method of a port object for a `FieldWrite` of the file.
struct FieldWriter {
    const FieldWrite* write = nullptr;
    std::vector<const Type::Field*> fields{};  ///< of its arguments; none if the port's type has not all of the names
};

/// The port of a port object in Lua. The object stores the address of this slot.
struct PortSlot {
    Script* script = nullptr;
    const PortDeclaration* declaration = nullptr;
    const void* object = nullptr;   ///< address of the Lua object, to check `self`
    Port* port = nullptr;           ///< null while the file loads
    bool is_read_in_place = false;  ///< nothing has an array that was read when the next one is read
    std::vector<FieldWriter> writers{};
    bool live = false;  ///< scripts may read and write the port, because their version is the one that runs
};

/// `about { ... }`.
struct ScriptAbout {
    std::string version, vendor, category;
    bool given = false;
};

/// What a version takes over from the version before; all may be null.
struct Inheritance {
    const Parameters* parameters = nullptr;       ///< values that were set and still fit are kept
    const PlainData* state = nullptr;             ///< the contents of `state`
    std::vector<ScriptFile>* required = nullptr;  ///< gets every file that loading reads: modules, messages
    /// If not null, `take_state_over` sets `state` later, and this becomes true if the top level reads `state` or the
    /// time.
    bool* looks_at_tick = nullptr;
};

class Script {
public:
    /// Runs the top level of a file, which only declares. May be called in another thread than that of the ticks.
    static Expected<std::unique_ptr<Script>> load(const SourceText& source, ScriptContext context,
                                                  const Inheritance& inheritance = {});

    ~Script();
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;

    /// The file without its text.
    const ScriptFile& file() const { return file_; }
    const ScriptCode& code() const { return *code_; }
    const ScriptContext& context() const { return context_; }
    /// The text of the file or module that has this name in messages; "" if the text is no longer known.
    std::string text_of(std::string_view shown) const;
    /// The files that `require` loaded, directly or not, and those that define its messages.
    const std::vector<ScriptFile>& modules() const { return modules_; }
    const std::list<PortDeclaration>& ports() const { return ports_; }
    std::list<PortSlot>& slots() { return slots_; }
    const std::vector<CommandDeclaration>& commands() const { return commands_; }
    const ScriptAbout& about() const { return about_; }
    /// The first comment of the file.
    const std::string& doc() const { return doc_; }
    Tasks& tasks() { return tasks_; }
    const Tasks& tasks() const { return tasks_; }
    Probes& probes() { return probes_; }
    const Probes& probes() const { return probes_; }
    bool has(Hook hook) const { return hooks_[static_cast<std::size_t>(hook)] != LUA_NOREF; }
    /// The parameters of the component while this version runs; before, those that the file declares.
    Parameters& parameters();
    /// Moves the declared parameters to the component.
    Parameters take_parameters() { return std::exchange(parameters_, {}); }

    /// Connects the script to its component, whose time and state it then sees. The script can't write to its ports
    /// until `go_live`.
    void bind(Component& owner);
    /// Sets the limit of every further call.
    void set_budget(Budget budget) { context_.budget = budget; }
    /// Sets the cache of shared code.
    void share(ChunkCache* chunks) { context_.chunks = chunks; }
    /// Notes that the result of loading may depend on the tick.
    void note_look_at_tick() {
        if (inheritance_.looks_at_tick != nullptr) *inheritance_.looks_at_tick = true;
    }
    /// Sets `state` after a load with `Inheritance::looks_at_tick`.
    Expected<void> take_state_over(const PlainData& state);
    /// Opens the ports to the script, if this version is now the one that runs, or closes them. The slots must have
    /// their ports.
    void go_live(bool live);

    /// The part of a budget that remains for further calls in a tick in which a call failed late: see
    /// `has_used_its_tick`.
    static constexpr double reserve = 0.1;
    /// Calls a callback, if the script has it. Tasks start with `on_activated`, run before `on_execute`, and end before
    /// the other callbacks.
    Expected<void> call(Hook hook);
    /// Whether the last failed call used more than the part `reserve` of its budget. Then a further call in this tick,
    /// such as `on_aborting`, gets only this part, so that both together take little more than one budget.
    bool has_used_its_tick() const { return failed_seconds_ > context_.budget.seconds * reserve; }
    /// Calls `on_reload(old_version)`.
    Expected<void> call_on_reload(int old_version);
    /// Calls a command with copies of these arguments; its results are copies.
    Expected<PlainData> call_command(std::string_view name, const PlainData& arguments);
    /// A copy of the script's `state`. `dropped` gets the values that are not plain data.
    Expected<PlainData> take_state(std::vector<Dropped>& dropped);
    /// A copy of `state` within a limit: tables beyond it are left out.
    Expected<PlainSnapshot> state_snapshot(const PlainLimit& limit, std::vector<Dropped>* dropped = nullptr);
    /// Calls `set_plain` for `state`.
    Expected<void> set_state(const PlainData& data);

    /// [bytes] memory of its Lua state.
    std::size_t memory() const { return lua_->memory(); }
    /// Limits for everything that an execution writes to its ports, and for what is logged in a second of `now()`. The
    /// engine stores this outside of the script's memory.
    static constexpr std::size_t most_written_bytes = std::size_t{64} << 20;
    static constexpr std::size_t most_logged_bytes = std::size_t{1} << 20;
    /// Counts written bytes of this execution. False if they are too many.
    bool may_write(std::size_t bytes) {
        written_bytes_ += bytes;
        return written_bytes_ <= most_written_bytes;
    }
    /// Log lines of the top level, which could not be sent yet.
    std::vector<std::pair<LogLevel, std::string>> take_early_log() { return std::exchange(early_log_, {}); }

    // Functions for the C functions that scripts call. Errors are texts without a location.

    enum class Phase { loading, bound, live };
    Phase phase() const { return phase_; }
    Component* owner() const { return owner_; }
    lua_State* lua() const { return lua_->lua(); }
    double seconds() const { return owner_ != nullptr ? owner_->now().seconds : context_.seconds; }
    double dt() const;
    void log(LogLevel level, std::string text);

    /// An element that the script read, although the message does not have it. An error in the same line names the
    /// element.
    struct MissingElement {
        CallRecord::ScriptPlace place;
        lua_Integer index = 0;
        std::size_t count = 0;  ///< number of elements that the message has
        const PortDeclaration* port = nullptr;
    };
    void note_missing(const MissingElement& element) { missing_ = element; }

    /// A message type by its name. While the script loads, message files are searched too.
    Expected<const MessageType*> find_message(std::string_view name);
    Expected<PortSlot*> declare_port(PortDeclaration declaration);
    Expected<void> declare_parameter(ParameterSpec spec);
    /// `function` is a registry reference.
    Expected<void> declare_command(CommandDeclaration declaration, int function);
    Expected<void> declare_about(ScriptAbout about);
    Expected<void> declare_task(Task task);
    /// Returns an error unless tasks can be started and cancelled now.
    Expected<void> check_tasks_run(std::string_view function) const;
    /// The index of the callback that an assignment of this Lua type to this global defines. An error if the name is
    /// not a callback, or can't be defined now.
    Expected<std::size_t> check_hook(std::string_view name, std::string_view type) const;
    void set_hook(std::size_t hook, int function, int line);
    /// The registry reference of a callback; LUA_REFNIL if it is not defined, LUA_NOREF if there is no such callback.
    int hook_function(std::string_view name) const;
    /// Finds and compiles a module. Then run `module_chunk`, its code, and call `end_module` afterwards, even if the
    /// code fails.
    Expected<void> begin_module(std::string_view name);
    void end_module();
    const Chunk& module_chunk() const { return module_->chunk; }
    /// Pushes the argument of `module_chunk`, if it has one. Returns the number of arguments.
    int push_module_marks(lua_State* lua) const;

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
    // Prepares each call: updates parameters that have changed, and resets counters.
    Expected<void> begin_call();
    static int call_with_tasks(lua_State* L);
    /// Discards the written values of out-ports that have a safe value.
    void discard_unsafe();
    Expected<std::shared_ptr<const ScriptCode>> compile(const SourceText& source, ScriptKind kind) const;
    // Checks that all parameters which the file reads are declared; otherwise the line would fail when it runs.
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
    std::shared_ptr<const ScriptCode> code_;
    std::shared_ptr<const ScriptCode> module_;  // the module that loads
    Coverage* coverage_ = nullptr;
    std::list<PortDeclaration> ports_;
    std::list<PortSlot> slots_;
    std::vector<CommandDeclaration> commands_;
    std::vector<int> command_functions_;  // registry references, in the order of `commands_`
    ScriptAbout about_;
    Probes probes_;
    Parameters parameters_;
    std::array<int, 9> hook_lines_{};
    std::vector<std::pair<LogLevel, std::string>> early_log_;
    double failed_seconds_ = 0;  // CPU time of the last failed call
    MissingElement missing_{};   // the last one of this execution
    // The members below, and `missing_.port`, are used in every tick.
    Tasks tasks_;
    std::array<int, 9> hooks_{};     // registry references, by Hook
    std::size_t written_bytes_ = 0;  // in this execution
    std::size_t logged_bytes_ = 0;   // since `logged_since_`
    double logged_since_ = 0;        // [s] when the second began in which logged bytes are counted
    Component* owner_ = nullptr;
    Phase phase_ = Phase::loading;
    bool was_activated_ = false;         // in this version
    std::uint64_t seen_parameters_ = 0;  // version of the parameters that `config` shows
    std::unique_ptr<LuaState> lua_;      // last, so destroyed first
};

}  // namespace nezumi
