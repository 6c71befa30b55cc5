// Reads the table of the call strictly; its functions stay in the Lua state.
#include "bindings/learning/environment_file.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "engine/records/fields.hpp"

namespace nezumi {
namespace {

constexpr char functions_key = 0;  // its address is the key of the table of functions in the registry

constexpr std::int64_t most_ticks = 1'000'000;
constexpr std::int64_t most_steps = 1'000'000'000;
constexpr std::int64_t most_values = 1'000'000;  // most values of one part of a space

const EnvironmentFunctionInfo& info(EnvironmentFunction function) {
    return environment_functions[static_cast<std::size_t>(function)];
}

// Reads a part of a space. A plain text is the name of one number without limits.
void read_part(Fields fields, const Value& given, std::vector<SpacePart>& parts) {
    FieldCheck& check = fields.check();
    const auto wrong = [&](std::string_view text) { check.wrong_at(fields.path(), text); };
    SpacePart part;
    if (const auto* text = given.get_if<std::string>()) {
        part.name = *text;
    } else {
        const std::vector<Value>& elements = fields.elements();
        const auto* name = elements.size() == 1 ? elements[0].get_if<std::string>() : nullptr;
        if (name == nullptr) return wrong("expected a table as in { \"speed\", min = 0, max = 0.3 }");
        part.name = *name;
        std::int64_t count = 1;
        fields.whole("count", count, 1, most_values);
        part.count = static_cast<std::size_t>(count);
        fields.number("min", part.min);
        fields.number("max", part.max);
        fields.done();
    }
    if (part.name.empty()) return wrong("expected a name, got \"\"");
    if (part.min > part.max)
        return wrong(fmt::format("'{}' has a min of {} above its max of {}", shown(part.name), part.min, part.max));
    for (const SpacePart& other : parts) {
        if (other.name == part.name) return wrong(fmt::format("'{}' occurs twice", shown(part.name)));
    }
    parts.push_back(std::move(part));
}

void read_parts(Fields& all, std::string_view name, std::vector<SpacePart>& parts) {
    all.require(name, "a list of numbers as { \"speed\", min = 0, max = 0.3 }");
    if (!all.has(name)) return;
    Fields list = all.inner(name);
    std::size_t index = 0;
    for (const Value& each : list.elements()) {
        FieldPath path = list.path();
        path.push_back(fmt::format("[{}]", ++index));
        const bool is_text = each.get_if<std::string>() != nullptr;
        read_part({list.check(), is_text ? Value{} : each, std::move(path)}, each, parts);
    }
    list.done();
    if (index == 0 && list.check().ok()) list.check().wrong(list.path(), "is empty: name at least one number");
}

}  // namespace

std::size_t width_of(const std::vector<SpacePart>& parts) {
    return std::accumulate(parts.begin(), parts.end(), std::size_t{0},
                           [](std::size_t sum, const SpacePart& each) { return sum + each.count; });
}

Expected<std::unique_ptr<EnvironmentFile>> EnvironmentFile::read(const SourceText& source, const Project& project,
                                                                 std::uint64_t seed,
                                                                 std::function<void(std::string_view)> print,
                                                                 std::vector<Error>* errors) {
    std::unique_ptr<EnvironmentFile> file(new EnvironmentFile);
    const auto give_up = [&](Error error) {
        if (errors != nullptr && errors->empty()) errors->push_back(error);
        return Unexpected(std::move(error));
    };
    auto data = DataFile::create(project, {.seed = seed, .print = std::move(print)});
    if (!data) return give_up(data.error());
    file->file_ = std::move(*data);
    const auto opened = protect(file->file_->lua(), Budget{10}, [](lua_State* lua) {
        lua_newtable(lua);
        lua_rawsetp(lua, LUA_REGISTRYINDEX, &functions_key);
        return 0;
    });
    if (!opened) return give_up(file->file_->to_error(opened.error()));
    if (auto ran = file->file_->run(source.text, source.shown, {{"environment", word, file.get()}}); !ran) {
        if (errors != nullptr) *errors = file->file_->errors();
        return give_up(ran.error());
    }
    if (!file->is_called_)
        return give_up({"the file has no environment: expected environment { system = \"...\", ... }", {source.shown}});
    lua_settop(file->file_->lua(), 0);
    return file;
}

Expected<std::filesystem::path> EnvironmentFile::find_system(const Project& project) const {
    auto path = project.find(FileKind::system, spec_.system, spec_.place.file);
    if (!path) return failure("environment: " + path.error().message, spec_.place);
    return std::move(*path);
}

bool EnvironmentFile::has(EnvironmentFunction function) const { return given_[static_cast<std::size_t>(function)]; }

void EnvironmentFile::push(lua_State* lua, EnvironmentFunction function) {
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &functions_key);
    lua_rawgeti(lua, -1, static_cast<lua_Integer>(function) + 1);
    lua_remove(lua, -2);
}

Error EnvironmentFile::to_error(EnvironmentFunction function, const Error& error) const {
    Error told{fmt::format("{}: {}", info(function).name, one_line(error.message)), error.place};
    if (told.place.file.empty()) told.place = places_[static_cast<std::size_t>(function)];
    return told;
}

int EnvironmentFile::word(lua_State* lua) {
    auto& file = *static_cast<EnvironmentFile*>(lua_touserdata(lua, lua_upvalueindex(1)));
    luaL_checkstack(lua, 20, nullptr);
    bridge(lua, [&] { return file.read_call(lua); });
    // Stores the functions of the call, which `read_call` has checked.
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &functions_key);
    for (std::size_t i = 0; i < environment_functions.size(); ++i) {
        if (!file.given_[i]) continue;
        lua_pushlstring(lua, environment_functions[i].name.data(), environment_functions[i].name.size());
        lua_rawget(lua, 1);
        lua_rawseti(lua, -2, static_cast<lua_Integer>(i) + 1);
    }
    return bridge(lua, [&] { return file.check_functions(lua); });
}

// Raises no Lua error.
Expected<void> EnvironmentFile::read_call(lua_State* lua) {
    const Place place = calling_place(lua);
    const auto refuse = [&](std::string text) {
        return Unexpected(file_->fail({fmt::format("environment: {}", text), place}));
    };
    if (is_called_) return refuse("is called twice: a file describes one environment");
    is_called_ = true;
    spec_.place = place;
    if (lua_type(lua, 1) != LUA_TTABLE || lua_gettop(lua) != 1)
        return refuse("expected a table, as environment { system = \"...\", ... }");
    const auto value = read_file_value(lua, 1);
    if (!value) return refuse(value.error().message);
    FieldCheck check("environment", "environment", place, file_->source(place.file));
    Fields all(check, *value);
    all.require("system", "the name of a system file");
    all.text("system", spec_.system);
    all.whole("ticks", spec_.ticks, 1, most_ticks);
    all.whole("limit", spec_.limit, 1, most_steps);
    read_parts(all, "action", spec_.action);
    read_parts(all, "observation", spec_.observation);
    for (std::size_t i = 0; i < environment_functions.size(); ++i) {
        const auto& [name, arguments, required] = environment_functions[i];
        if (required) all.require(name, "a function");
        const Value* function = all.field(name);
        if (function == nullptr) continue;
        given_[i] = function->get_if<FileFunction>() != nullptr;
        if (!given_[i])
            check.wrong(all.path_of(name), fmt::format("expected a function, got a {}", kind_of(*function)));
    }
    all.done();
    if (auto ok = check.result(); !ok) return Unexpected(file_->fail(ok.error()));
    return {};
}

// Raises no Lua error.
Expected<void> EnvironmentFile::check_functions(lua_State* lua) {
    for (std::size_t i = 0; i < environment_functions.size(); ++i) {
        if (!given_[i]) continue;
        push(lua, static_cast<EnvironmentFunction>(i));
        lua_Debug function;
        lua_pushvalue(lua, -1);
        lua_getinfo(lua, ">S", &function);
        places_[i] = function.source[0] == '@' ? Place{function.source + 1, function.linedefined} : spec_.place;
        const auto fits = check_parameters(lua, lua_gettop(lua), environment_functions[i].arguments);
        lua_pop(lua, 1);
        if (!fits) {
            const std::string text =
                fmt::format("environment: {}: {}", environment_functions[i].name, fits.error().message);
            return Unexpected(file_->fail({text, places_[i]}));
        }
    }
    return {};
}

}  // namespace nezumi
