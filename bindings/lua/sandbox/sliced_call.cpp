// Slices: a coroutine, and the hook that makes it yield.
#include "bindings/lua/sandbox/sliced_call.hpp"

namespace nezumi {
namespace {

int finish_body(lua_State* lua, int status, lua_KContext) {
    if (status == LUA_OK || status == LUA_YIELD) return lua_gettop(lua) - 1;
    current_call->caught_status = status;
    return lua_error(lua);
}

// The bottom of the coroutine: calls the function below the arguments with the message handler of every call.
int body(lua_State* lua) {
    lua_pushcfunction(lua, handle_error);
    lua_insert(lua, 1);
    return finish_body(lua, lua_pcallk(lua, lua_gettop(lua) - 2, LUA_MULTRET, 1, 0, finish_body), 0);
}

}  // namespace

tl::expected<std::unique_ptr<SlicedCall>, CallError> SlicedCall::start(LuaState& state, int arguments, Budget total) {
    auto call = std::unique_ptr<SlicedCall>(new SlicedCall(state, total));
    lua_State* const lua = state.lua();
    const int function = lua_gettop(lua) - arguments;
    const auto made = protect(lua, total, [&call](lua_State* inside) {
        call->thread_ = lua_newthread(inside);
        call->anchor_ = luaL_ref(inside, LUA_REGISTRYINDEX);
        luaL_checkstack(call->thread_, LUA_MINSTACK, nullptr);
        lua_pushcfunction(call->thread_, body);
        return 0;
    });
    if (made && lua_checkstack(call->thread_, arguments + 1) != 0) {
        lua_xmove(lua, call->thread_, arguments + 1);
        call->arguments_ = arguments + 1;
        return call;
    }
    lua_settop(lua, function - 1);
    if (!made) return tl::unexpected(made.error());
    return tl::unexpected(CallError{{"too many arguments"}, false});
}

SlicedCall::~SlicedCall() {
    if (!state_.is_lost()) luaL_unref(state_.lua(), LUA_REGISTRYINDEX, anchor_);
}

SlicedCall::Progress SlicedCall::advance(std::chrono::microseconds slice) {
    if (state_.is_lost()) {
        error_ = lost_error(total_.seconds);
        return Progress::failed;
    }
    const double left = total_.seconds - used_seconds();
    CallRecord call(thread_, Budget{left});
    call.budget_seconds = total_.seconds;
    call.slicing = true;
    call.keep_hook = true;
    call.sliced_bottom = thread_;
    call.slice_end = std::chrono::steady_clock::now() + slice;
    const std::int64_t began = thread_time();
    keep_watching(thread_);
    if (call.outer == nullptr) {
        if (_setjmp(call.escape) != 0) {
            finish_escape(call);
            error_ = lost_error(total_.seconds);
            return Progress::failed;
        }
        call.can_escape = true;
    }
    int results = 0;
    const int status = lua_resume(thread_, nullptr, arguments_, &results);
    call.can_escape = false;
    arguments_ = 0;
    used_ += thread_time() - began;
    if (status == LUA_OK) return Progress::finished;
    if (status == LUA_YIELD) {
        if (used_seconds() < total_.seconds) return Progress::running;
        call.expired = 1;
        find_place(thread_, call.expiry_place);
    }
    error_ = take_error(thread_, call.caught_status != LUA_OK ? call.caught_status : status, call);
    return Progress::failed;
}

}  // namespace nezumi
