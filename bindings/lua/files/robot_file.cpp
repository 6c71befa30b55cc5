// The word `robot_model`: from a table in Lua to a robot's description.
#include "bindings/lua/files/robot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/robot_fields.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/values/codec.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

// The result of `robot_model { ... }`, for the file to return.
const char model_mark = 0;

class Reader {
public:
    Reader(DataFile& file, const Project& project) : file_(file), project_(project) {}

    static int robot_model(lua_State* lua) {
        auto& reader = *static_cast<Reader*>(lua_touserdata(lua, lua_upvalueindex(1)));
        bridge(lua, [&] { return reader.read(lua); });
        lua_pushlightuserdata(lua, const_cast<char*>(&model_mark));
        return 1;
    }

    std::optional<RobotSpec> spec;
    std::vector<std::string> tables;  // files that were read beside the robot file

private:
    // Raises no Lua error.
    Expected<void> read(lua_State* lua) {
        const Place place = calling_place(lua);
        const auto refuse = [&](const std::string& text) {
            return Unexpected(file_.fail({"robot_model: " + text, place}));
        };
        if (spec) return refuse(fmt::format("is called twice, first in line {}", spec->place.line));
        if (const int count = Arguments{lua}.count(); count > 1)
            return refuse(fmt::format("expected one table, got {} arguments", count));
        const auto value = read_file_value(lua, 1);
        if (!value) return refuse(value.error().message);
        if (value->is_nil()) return refuse("expected a table, got nil");
        FieldCheck check("robot_model", "robot_model", place, file_.source(place.file));
        RobotSpec read = read_robot_fields(
            check, *value,
            {[&](const std::string& name) { return read_table(name, place); },
             [&](const FieldPath& path, const std::vector<double>& distances) { return call(lua, path, distances); }});
        if (auto ok = check.result(); !ok) return Unexpected(file_.fail(ok.error()));
        read.place = place;
        spec = std::move(read);
        return {};
    }

    Expected<std::vector<ResponseTable::Point>> read_table(const std::string& name, const Place& place) {
        const auto path = project_.find(FileKind::data, name, place.file);
        if (!path) return Unexpected(path.error());
        const std::string shown = project_.shown(*path);
        const auto text = project_.read(*path);
        if (!text) return Unexpected(text.error());
        if (std::find(tables.begin(), tables.end(), shown) == tables.end()) tables.push_back(shown);
        return read_csv_response(*text, shown);
    }

    // Calls the function at this path of the first argument with each distance.
    Expected<std::vector<double>> call(lua_State* lua, const FieldPath& path, const std::vector<double>& distances) {
        const int top = lua_gettop(lua);
        if (lua_checkstack(lua, static_cast<int>(path.size()) + 4) == 0) return failure("stack overflow");
        lua_pushvalue(lua, 1);
        for (const std::string& part : path) {
            if (!detail::push_raw_field(lua, lua_gettop(lua), part)) return failure("is gone");
        }
        std::vector<double> values;
        for (const double distance : distances) {
            lua_pushvalue(lua, -1);
            lua_pushnumber(lua, distance);
            if (const auto called = protected_call(lua, 1, 1, file_.budget()); !called) {
                Error error = file_.to_error(called.error());
                lua_settop(lua, top);
                error.message = fmt::format("response({}): {}", distance, error.message);
                return Unexpected(std::move(error));
            }
            const bool is_number = lua_type(lua, -1) == LUA_TNUMBER;
            const double value = is_number ? lua_tonumber(lua, -1) : 0;
            if (!is_number || std::isnan(value)) {
                const std::string got = is_number ? "nan" : lua_typename(lua, lua_type(lua, -1));
                lua_settop(lua, top);
                return failure(fmt::format("returned {} for a distance of {} m, expected a number", got, distance));
            }
            lua_pop(lua, 1);
            values.push_back(value);
        }
        lua_settop(lua, top);
        return values;
    }

    DataFile& file_;
    const Project& project_;
};

// Reads a text and, when it fails, tells all that is wrong.
Expected<RobotSpec> read_robot(std::string_view text, const std::string& shown, const Project& project,
                               std::vector<std::string>* files, std::vector<Error>& errors) {
    auto file = DataFile::create(project, {});
    if (!file) return Unexpected(file.error());
    Reader reader(**file, project);
    if (auto ran = (*file)->run(text, shown, {{"robot_model", Reader::robot_model, &reader}}); !ran) {
        errors = (*file)->errors();
        return Unexpected(ran.error());
    }
    if (!reader.spec || lua_touserdata((*file)->lua(), -1) != &model_mark) {
        return failure("a robot file ends with `return robot_model { ... }`", {shown});
    }
    RobotSpec spec = std::move(*reader.spec);
    spec.model = fs::path(shown).stem().string();
    if (spec.place.file != shown) spec.place = {shown};
    if (files != nullptr) {
        files->insert(files->end(), (*file)->files().begin(), (*file)->files().end());
        files->insert(files->end(), reader.tables.begin(), reader.tables.end());
    }
    return spec;
}

}  // namespace

Expected<RobotSpec> read_robot_text(std::string_view text, const std::string& shown, const Project& project,
                                    std::vector<std::string>* files) {
    std::vector<Error> errors;
    return read_robot(text, shown, project, files, errors);
}

std::vector<Error> check_robot_text(std::string_view text, const std::string& shown, const Project& project) {
    std::vector<Error> errors;
    const auto spec = read_robot(text, shown, project, nullptr, errors);
    if (!spec && errors.empty()) errors.push_back(spec.error());
    return errors;
}

Expected<RobotSpec> read_robot_file(const fs::path& path, const Project& project, std::vector<std::string>* files) {
    const std::string shown = project.shown(path);
    const auto text = project.read(path);
    if (!text) return Unexpected(text.error());
    return read_robot_text(*text, shown, project, files);
}

}  // namespace nezumi
