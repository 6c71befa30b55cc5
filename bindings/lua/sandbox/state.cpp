// Memory accounting, settings of the garbage collector, and the life of a Lua state.
#include "bindings/lua/sandbox/state.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "engine/base/list.hpp"

#if defined(NEZUMI_ADDRESS_SANITIZER)
#include <sanitizer/lsan_interface.h>
#endif

namespace nezumi {
namespace {

// Small steps keep pauses short: on a heap of 2 MB, they were 10 times shorter than with Lua's defaults. With a pause
// of 200 % and a speed of 10, the heap would grow to three times the live memory. With the values below, a script of a
// swarm needs 14 KB less, and executes 0.5 % more instructions (docs/performance.md).
constexpr int gc_pause = 150;        // [%] of the live memory before a new cycle begins
constexpr int gc_step_speed = 40;    // work per allocation
constexpr int gc_step_size_log = 8;  // [log2 bytes] between two steps

// All Lua code runs within protected_call, so an error elsewhere is a programming error. Prints its text and ends the
// process.
int panic(lua_State* lua) {
    const char* message = lua_type(lua, -1) == LUA_TSTRING ? lua_tostring(lua, -1) : "unknown";
    std::fprintf(stderr, "nezumi: Lua error outside a protected call: %s\n", message);
    std::abort();
}

// A call needs one coroutine, and nested calls one each; more are rarely needed at a time.
constexpr std::size_t most_idle_threads = 4;

// Returns a new coroutine, which the registry keeps alive.
int new_thread(lua_State* lua) {
    lua_State* const thread = lua_newthread(lua);
    lua_pushvalue(lua, -1);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, thread);
    return 1;
}

// A lost state can't be closed, because it was abandoned inside Lua's own C code.
void leave_to_leak([[maybe_unused]] const lua_State* lost) {
#if defined(NEZUMI_ADDRESS_SANITIZER)
    __lsan_ignore_object(lost);
#endif
}

}  // namespace

LuaState::LuaState(StateOptions options) : memory_limit_(options.memory_limit), print_(std::move(options.print)) {
    seed_random(options.seed);
    idle_threads_.reserve(most_idle_threads);
}

Expected<std::unique_ptr<LuaState>> LuaState::create(StateOptions options) {
    auto state = std::unique_ptr<LuaState>(new LuaState(std::move(options)));
    if (!state->open()) return failure("not enough memory for a new Lua state");
    return state;
}

bool LuaState::open() {
    lua_ = lua_newstate(&LuaState::allocate, this);
    if (lua_ == nullptr) return false;
    *static_cast<LuaState**>(lua_getextraspace(lua_)) = this;
    lua_atpanic(lua_, panic);
    lua_gc(lua_, LUA_GCINC, gc_pause, gc_step_speed, gc_step_size_log);
    return true;
}

LuaState* LuaState::replace_lost() {
    lua_gc(lua_, LUA_GCSTOP);  // the old state must not change: code may still use it
    leave_to_leak(lua_);
    small_.abandon();
    memory_ = 0;
    idle_threads_.clear();
    if (!open()) std::abort();
    return std::exchange(next_lost_, nullptr);
}

LuaState::~LuaState() {
    if (lua_ != nullptr) lua_close(lua_);
}

lua_State* LuaState::take_thread(lua_State* lua, int values) {
    lua_State* thread = nullptr;
    if (!idle_threads_.empty()) {
        thread = idle_threads_.back();
        idle_threads_.pop_back();
    } else {
        lua_pushcfunction(lua, new_thread);
        if (lua_pcall(lua, 0, 1, 0) == LUA_OK) thread = lua_tothread(lua, -1);
        lua_pop(lua, 1);
    }
    if (thread == nullptr || lua_checkstack(thread, values) != 0) return thread;
    give_back_thread(lua, thread);
    return nullptr;
}

void LuaState::give_back_thread(lua_State* lua, lua_State* thread) {
    if (!is_poisoned(thread) && idle_threads_.size() < most_idle_threads) return idle_threads_.push_back(thread);
    lua_pushnil(lua);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, thread);  // the key exists, so this takes no memory
}

void LuaState::seed_random(std::uint64_t seed) {
    random_seed_ = seed;
    random_ = Random(seed, 0);
}

void* LuaState::allocate(void* self, void* block, std::size_t old_size, std::size_t new_size) {
    LuaState& state = *static_cast<LuaState*>(self);
    const std::size_t held = block != nullptr ? old_size : 0;  // without a block, old_size is the type of the object
    if (new_size == 0) {
        if (block != nullptr) state.free(block, held);
        state.memory_ -= held;
        return nullptr;
    }
    if (new_size > held && new_size - held > state.memory_limit_ - std::min(state.memory_, state.memory_limit_)) {
        ++state.memory_refusals_;
        return nullptr;
    }
    void* grown = state.resize(block, held, new_size);
    if (grown != nullptr) state.memory_ += new_size - held;
    return grown;
}

// `block` may be null. The result is null if there is no memory; never for a block that shrinks.
void* LuaState::resize(void* block, std::size_t old_size, std::size_t new_size) {
    const bool is_small = block != nullptr && small_.owns(block);
    if (block != nullptr && !is_small) return std::realloc(block, new_size);
    if (is_small && new_size <= old_size) return block;
    void* moved = small_.take(new_size);
    if (moved == nullptr) moved = std::malloc(new_size);
    if (moved == nullptr || !is_small) return moved;
    std::memcpy(moved, block, old_size);
    small_.give_back(block, old_size);
    return moved;
}

void LuaState::free(void* block, std::size_t size) {
    if (small_.owns(block)) {
        small_.give_back(block, size);
    } else {
        std::free(block);
    }
}

bool LuaState::is_doubled(lua_State* lua, lua_Debug* event) {
    if (event->event != LUA_HOOKLINE || doubled_lines_ == nullptr) return false;
    const bool is_again = last_call_ == event->i_ci && last_line_ == event->currentline;
    last_call_ = event->i_ci;
    last_line_ = event->currentline;
    return is_again && contains(*doubled_lines_, event->currentline) && lua_getinfo(lua, "S", event) != 0 &&
           *event->source == '@' && event->source + 1 == *doubled_file_;
}

}  // namespace nezumi
