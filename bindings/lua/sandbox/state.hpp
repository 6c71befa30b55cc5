// A Lua state with an exact memory limit, for one script.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <lua.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/random.hpp"
#include "bindings/lua/sandbox/small_blocks.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// Options for a new Lua state.
struct StateOptions {
    std::size_t memory_limit = std::size_t{64} << 20;  ///< [bytes], exact; at least 64 KB
    std::uint64_t seed = 1;                            ///< of `math.random`
    /// Gets each line of `print`, without its end. Must not throw. Empty: the line is dropped.
    std::function<void(std::string_view)> print{};
};

/// Owns one `lua_State`. A process may have many; each may be used from any thread, but only from one at a time.
/// Everything that may raise a Lua error, also for lack of memory, must go through `protected_call` or `protect`
/// (call.hpp).
class LuaState {
public:
    /// A new state without libraries, with small steps of the garbage collector. Fails only for lack of memory.
    static Expected<std::unique_ptr<LuaState>> create(StateOptions options = {});
    ~LuaState();
    LuaState(const LuaState&) = delete;
    LuaState& operator=(const LuaState&) = delete;

    /// The owner of a state or of any of its coroutines; reads one pointer.
    static LuaState& of(lua_State* lua) { return **static_cast<LuaState**>(lua_getextraspace(lua)); }

    /// The main thread of the state.
    lua_State* lua() const { return lua_; }

    std::size_t memory() const { return memory_; }              ///< [bytes] in use now
    std::size_t memory_limit() const { return memory_limit_; }  ///< [bytes]
    void set_memory_limit(std::size_t bytes) { memory_limit_ = bytes; }

    /// Seeds `math.random`. The caller derives the seed from (run seed, component's name, version).
    void seed_random(std::uint64_t seed);
    Random& random() { return random_; }
    std::uint64_t random_seed() const { return random_seed_; }  ///< used by `math.randomseed()`

    /// Sets the function for `print`; may be called at any time.
    void set_print(std::function<void(std::string_view)> print) { print_ = std::move(print); }
    void print(std::string_view line) const {
        if (print_) print_(line);
    }

    /// Sets a function that adds a hint to the error of a call, such as what a nil upvalue means after a reload. The
    /// function gets the error and returns the text to append. Empty: no hints. Must not throw.
    void set_hint(std::function<std::string(const Error&)> hint) { hint_ = std::move(hint); }
    /// Sets a function that returns the lines of tail calls in a function of a file, from line `first` to `last`,
    /// because a tail call is not visible in an error. Empty: unknown. Must not throw.
    using TailCalls = std::function<std::vector<int>(std::string_view file, int first, int last)>;
    void set_tail_calls(TailCalls tail_calls) { tail_calls_ = std::move(tail_calls); }
    std::vector<int> tail_calls(std::string_view file, int first, int last) const {
        return tail_calls_ ? tail_calls_(file, first, last) : std::vector<int>();
    }
    /// Sets the lines of a file at which each turn of a loop gives two line events instead of one, because the loop was
    /// edited (`edit_array_loops`). Both must outlive the state.
    void set_doubled_lines(const std::string& file, const std::vector<int>& lines) {
        doubled_file_ = &file;
        doubled_lines_ = &lines;
    }
    /// Whether a hook leaves out this event: the second one of such a line. Call it for each event.
    bool is_doubled(lua_State* lua, lua_Debug* event);
    std::string hint(const Error& error) const { return hint_ ? hint_(error) : std::string(); }

    /// An empty coroutine for a call from `lua`, with room for `values` values; null for lack of memory. If the call
    /// fails, its stack is unchanged, so the location of any error can be found after Lua has returned.
    lua_State* take_thread(lua_State* lua, int values);
    /// Takes back a coroutine of `take_thread`, which must be empty or poisoned.
    void give_back_thread(lua_State* lua, lua_State* thread);

    /// How often the memory limit was reached. The allocator does nothing else, because Lua may be in any condition
    /// when it asks for memory, and its stack may not be readable.
    std::uint64_t memory_refusals() const { return memory_refusals_; }

    /// The next number for the text of a table, function, userdata or coroutine ("table: 1").
    std::int64_t next_identity() { return ++identities_; }

    /// A lost state was abandoned inside Lua's own C code (watchdog.hpp). Its main thread is then an empty state, so
    /// using it does no harm, and every call fails.
    bool is_lost() const { return lost_; }
    /// Marks the state as lost and puts it at the head of the list. Safe in a signal handler.
    void lose(LuaState*& list) {
        lost_ = true;
        next_lost_ = list;
        list = this;
    }
    /// Replaces a lost state by an empty one; its memory stays allocated. Returns the next state of the list.
    LuaState* replace_lost();

    /// Whether the scripts' function `next` has ever stored sorted keys.
    bool has_next_cache = false;
    /// The text of an error while it passes from C++ to a Lua error (values/bridge.hpp). It is stored here, because the
    /// jump of the error would skip its destructor.
    std::string kept_error;

private:
    explicit LuaState(StateOptions options);
    bool open();
    static void* allocate(void* self, void* block, std::size_t old_size, std::size_t new_size);
    void* resize(void* block, std::size_t old_size, std::size_t new_size);
    void free(void* block, std::size_t size);

    SmallBlocks small_;  // first member, so it outlives the others
    std::size_t memory_ = 0;
    std::size_t memory_limit_;
    std::uint64_t memory_refusals_ = 0;
    lua_State* lua_ = nullptr;
    std::vector<lua_State*> idle_threads_;
    bool lost_ = false;
    LuaState* next_lost_ = nullptr;
    std::int64_t identities_ = 0;
    Random random_;
    std::uint64_t random_seed_ = 0;
    std::function<void(std::string_view)> print_;
    std::function<std::string(const Error&)> hint_;
    TailCalls tail_calls_;
    const std::string* doubled_file_ = nullptr;
    const std::vector<int>* doubled_lines_ = nullptr;
    const void* last_call_ = nullptr;  // of the last line event; only compared
    int last_line_ = 0;
};

/// Closes the variables of a coroutine, like lua_resetthread. Lua 5.4.6 and later count nested calls, beginning with
/// those of `from`.
inline int close_coroutine(lua_State* coroutine, [[maybe_unused]] lua_State* from) {
#if LUA_VERSION_RELEASE_NUM >= 50406
    return lua_closethread(coroutine, from);
#else
    return lua_resetthread(coroutine);
#endif
}

/// Whether a coroutine is poisoned: it was stopped inside its hook and can't be watched any more, so no code may run in
/// it.
inline bool is_poisoned(lua_State* coroutine) { return *static_cast<void**>(lua_getextraspace(coroutine)) == nullptr; }
inline void poison(lua_State* coroutine) { *static_cast<void**>(lua_getextraspace(coroutine)) = nullptr; }

}  // namespace nezumi
