// The sandbox for files that describe data.
#include "bindings/lua/files/data_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "bindings/lua/modules/native_modules.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/sandbox/strict_globals.hpp"
#include "bindings/lua/values/bridge.hpp"

namespace nezumi {
namespace {

// Key of the table in the registry with the results of modules, by file.
const char modules_key = 0;

}  // namespace

std::string one_line(std::string text) {
    constexpr std::size_t longest = 1000;
    if (text.size() > longest) {
        text.resize(longest);
        text += "...";
    }
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = c == '\n' || c == '\t' ? ' ' : '?';
    }
    return text;
}

Place calling_place(lua_State* lua) {
    lua_Debug activation;
    for (int level = 1; lua_getstack(lua, level, &activation) != 0; ++level) {
        lua_getinfo(lua, "Sl", &activation);
        if (activation.currentline > 0 && activation.source[0] == '@')
            return {activation.source + 1, activation.currentline};
    }
    return {};
}

DataFile::DataFile(const Project& project, DataFileOptions options) : project_(project), options_(std::move(options)) {}

Expected<std::unique_ptr<DataFile>> DataFile::create(const Project& project, DataFileOptions options) {
    std::unique_ptr<DataFile> file(new DataFile(project, std::move(options)));
    auto state = create_sandbox({.seed = file->options_.seed, .print = file->options_.print});
    if (!state) return Unexpected(state.error());
    file->state_ = std::move(*state);
    if (file->options_.coverage != nullptr) file->options_.coverage->add(*file->state_);
    return file;
}

DataFile::~DataFile() {
    if (options_.coverage != nullptr && state_ != nullptr) options_.coverage->remove(*state_);
}

Error DataFile::fail(Error error) {
    error.message = one_line(std::move(error.message));
    if (!error_) error_ = error;
    return error;
}

const FileSource* DataFile::source(const std::string& shown) const {
    const auto found = sources_.find(shown);
    return found == sources_.end() ? nullptr : &found->second;
}

Error DataFile::to_error(const CallError& error) const {
    Error plain{one_line(error.message), error.place,
                error.over_budget ? Error::Kind::out_of_time : Error::Kind::ordinary};
    if (plain.place.file.empty()) plain.place.file = shown_;
    return plain;
}

Expected<Chunk> DataFile::compile_file(std::string_view text, const std::string& shown) {
    auto chunk = compile_checked(text, shown, known_);
    if (!chunk) {
        if (errors_.empty()) errors_ = chunk.error();
        for (Error& error : errors_) error.message = one_line(std::move(error.message));
        return Unexpected(errors_.front());
    }
    sources_.emplace(shown, FileSource(text, shown));
    files_.push_back(shown);
    return std::move(*chunk);
}

Expected<void> DataFile::run(std::string_view text, const std::string& shown, const std::vector<Global>& globals) {
    auto ran = try_to_run(text, shown, globals);
    if (!ran && errors_.empty()) errors_ = {ran.error()};
    return ran;
}

Expected<void> DataFile::try_to_run(std::string_view text, const std::string& shown,
                                    const std::vector<Global>& globals) {
    shown_ = shown;
    known_ = sandbox_globals();
    known_.readable.push_back("require");
    for (const Global& global : globals) known_.readable.push_back(global.name);
    auto chunk = compile_file(text, shown);
    if (!chunk) return Unexpected(chunk.error());

    const auto installed = protect(lua(), options_.budget, [&](lua_State* inside) {
        lua_createtable(inside, 0, 0);
        lua_rawsetp(inside, LUA_REGISTRYINDEX, &modules_key);
        lua_pushglobaltable(inside);
        lua_pushlightuserdata(inside, this);
        lua_pushcclosure(inside, require, 1);
        lua_setfield(inside, -2, "require");
        lua_Integer index = 0;
        for (const Global& global : globals) {
            lua_pushlstring(inside, global.name.data(), global.name.size());
            lua_pushlightuserdata(inside, global.self);
            lua_pushinteger(inside, index++);
            lua_pushcclosure(inside, global.function, 2);
            lua_rawset(inside, -3);
        }
        return 0;
    });
    if (!installed) return Unexpected(to_error(installed.error()));
    if (auto strict = make_globals_strict(lua(), {}); !strict) return strict;
    auto ran = load_chunk(lua(), *chunk);
    if (ran) ran = protected_call(lua(), 0, 1, options_.budget);
    if (error_) return Unexpected(*error_);
    if (!ran) return Unexpected(to_error(ran.error()));
    return {};
}

// Raises no Lua error.
Expected<DataFile::Module> DataFile::find_module(lua_State* lua) {
    const Place place = calling_place(lua);
    const auto refuse = [&](Error error) -> Expected<Module> {
        if (error.place.file.empty()) {
            error.place = place;
            if (!error.message.starts_with("require: ")) error.message = "require: " + error.message;
        }
        return Unexpected(fail(std::move(error)));
    };
    if (auto ok = Arguments{lua}.at_most("require", 1, "(name)"); !ok) return refuse(ok.error());
    if (lua_type(lua, 1) != LUA_TSTRING) {
        return refuse({fmt::format("expected a module's name, got {}", lua_typename(lua, lua_type(lua, 1)))});
    }
    std::size_t size = 0;
    const char* name = lua_tolstring(lua, 1, &size);
    const auto path = project_.find(FileKind::module, {name, size}, place.file);
    if (!path) return refuse(path.error());
    module_ = project_.shown(*path);
    if (loaded_.contains(module_)) return Module::known;
    if (loading_.contains(module_)) return refuse({fmt::format("module '{}' requires itself", name)});
    const auto text = project_.read(*path);
    if (!text) return refuse(text.error());
    auto chunk = compile_file(*text, module_);
    if (!chunk) return refuse(chunk.error());
    chunk_ = std::move(*chunk);
    covered_ = nullptr;
    if (options_.coverage != nullptr) covered_ = options_.coverage->mark({path->string(), module_, *text}, chunk_);
    loading_.insert(module_);
    return Module::compiled;
}

int DataFile::require(lua_State* lua) {
    auto& file = *static_cast<DataFile*>(lua_touserdata(lua, lua_upvalueindex(1)));
    if (push_native_module(lua, 1)) return 1;
    Module found = Module::known;
    bridge(lua, [&] { return file.find_module(lua).map([&](Module module) { found = module; }); });
    lua_settop(lua, 1);
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &modules_key);
    lua_pushlstring(lua, file.module_.data(), file.module_.size());
    if (found == Module::known) {
        lua_rawget(lua, 2);
        return 1;
    }
    const Chunk& chunk = file.chunk_;
    if (luaL_loadbufferx(lua, chunk.bytecode.data(), chunk.bytecode.size(), "chunk", "b") != LUA_OK)
        return lua_error(lua);
    if (file.covered_ != nullptr) {
        Coverage::push_marks(lua, *file.covered_);
    } else {
        lua_pushvalue(lua, 1);
    }
    lua_call(lua, 1, 1);
    if (lua_isnil(lua, -1)) {
        lua_pop(lua, 1);
        lua_pushboolean(lua, 1);
    }
    // The stack is now: name, table of modules, file, result.
    lua_pushvalue(lua, 3);
    lua_pushvalue(lua, 4);
    lua_rawset(lua, 2);
    const char* shown = lua_tostring(lua, 3);
    file.loaded_.insert(shown);
    file.loading_.erase(shown);
    return 1;
}

}  // namespace nezumi
