// The word `robot_model`: makes a robot's description from a Lua table.
#include "bindings/lua/files/robot_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/find_script.hpp"
#include "bindings/lua/files/merge_value.hpp"
#include "bindings/lua/files/robot_fields.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/base/list.hpp"
#include "engine/devices/wired_device.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

// The address of this constant is the result of `robot_model { ... }`, which the file returns.
const char model_mark = 0;
// The address of this constant is the key of the registry for the table of `robot_model`.
const char fields_key = 0;

const Value* value_at(const Value& value, const FieldPath& path) {
    const Value* found = &value;
    for (const std::string& part : path) {
        const FileTable* table = found->get_if<FileTable>();
        found = table != nullptr ? table->find(part) : nullptr;
        if (found == nullptr) return nullptr;
    }
    return found;
}

bool is_function_at(const Value& value, const FieldPath& path) {
    const Value* found = value_at(value, path);
    return found != nullptr && found->is<FileFunction>();
}

}  // namespace

// One robot file, and the layer of the file that it builds on. The Lua state is kept to call the file's functions.
class RobotFile::Layer {
public:
    // `above`: the files that build on this one, as the project shows them.
    // `drivers`: the names of all drivers of real robots; empty: unknown.
    Layer(const Project& project, std::vector<std::string> above, std::vector<std::string> drivers = {})
        : project_(project), above_(std::move(above)), drivers_(std::move(drivers)) {}

    Expected<void> run(std::string_view text, const std::string& shown) {
        auto file = DataFile::create(project_, {});
        if (!file) return Unexpected(file.error());
        file_ = std::move(*file);
        shown_ = shown;
        if (auto ran = file_->run(text, shown, globals()); !ran) return ran;
        if (!spec_ || lua_touserdata(file_->lua(), -1) != &model_mark)
            return failure("a robot file must end with `return robot_model { ... }`", {shown});
        spec_->model = fs::path(shown).stem().string();
        if (spec_->place.file != shown) spec_->place = {shown};
        return {};
    }

    // All mistakes of a run that failed; the result of the run has only the first one.
    std::vector<Error> errors() const { return file_ != nullptr ? file_->errors() : std::vector<Error>{}; }
    const RobotSpec& spec() const { return *spec_; }

    std::vector<std::string> files() const {
        std::vector<std::string> files = file_->files();
        files.insert(files.end(), tables_.begin(), tables_.end());
        if (base_ == nullptr) return files;
        for (std::string& file : base_->files()) {
            add_once(files, std::move(file));
        }
        return files;
    }

    RobotSpec changed(FieldCheck& check, const Value& changes, const std::string& named_in) {
        const Value whole = merge_values(check, whole_, changes);
        const auto table = [&](const FieldPath& path, const std::string& name) {
            return value_at(changes, path) != nullptr ? read_points_in(name, named_in) : read_table(path, name);
        };
        const auto call_at = [&](const FieldPath& path,
                                 const std::vector<double>& distances) -> Expected<std::vector<double>> {
            if (is_function_at(changes, path))
                return failure(
                    "only a robot file can have a function: write a robot file with base = ..., or give a 'table'");
            return call(path, distances);
        };
        RobotSpec spec =
            read_robot_fields(check, whole, {table, call_at, {}, [&](const FieldPath& path, const std::string& name) {
                                                 return find_script(path, name);
                                             }});
        spec.model = spec_->model;
        spec.place = spec_->place;
        return spec;
    }

private:
    static int robot_model(lua_State* lua) {
        auto& layer = *static_cast<Layer*>(lua_touserdata(lua, lua_upvalueindex(1)));
        // May raise a memory error; there are no C++ objects to destroy here.
        lua_settop(lua, std::max(lua_gettop(lua), 1));
        lua_pushvalue(lua, 1);
        lua_rawsetp(lua, LUA_REGISTRYINDEX, &fields_key);
        bridge(lua, [&] { return layer.read(lua); });
        lua_pushlightuserdata(lua, const_cast<char*>(&model_mark));
        return 1;
    }

    // Implements `serial { ... }` and the like: adds the field `kind` to the table, and returns the table.
    static int device(lua_State* lua) {
        const auto index = static_cast<std::size_t>(lua_tointeger(lua, lua_upvalueindex(2)));
        const std::string_view word = device_kinds()[index - 1].word;
        luaL_checktype(lua, 1, LUA_TTABLE);
        lua_settop(lua, 1);
        lua_pushlstring(lua, word.data(), word.size());
        lua_setfield(lua, 1, "kind");
        return 1;
    }

    std::vector<DataFile::Global> globals() {
        std::vector<DataFile::Global> all{{"robot_model", robot_model, this}};
        for (const DeviceKind& kind : device_kinds()) all.push_back({kind.word, device, this});
        return all;
    }

    // Raises no Lua error.
    Expected<void> read(lua_State* lua) {
        const Place place = calling_place(lua);
        const auto refuse = [&](const std::string& text) {
            return Unexpected(file_->fail({"robot_model: " + text, place}));
        };
        if (spec_)
            return refuse(fmt::format("a file can have only one, and line {} has one already", spec_->place.line));
        if (const int count = Arguments{lua}.count(); count > 1)
            return refuse(fmt::format("expected one table, got {} arguments", count));
        auto value = read_file_value(lua, 1);
        if (!value) return refuse(value.error().message);
        if (value->is_nothing()) return refuse("expected a table, got nil");
        own_ = std::move(*value);
        FieldCheck check("robot_model", "robot_model", place, file_->source(place.file));
        if (auto built = build_on_base(check, place); !built) return Unexpected(file_->fail(built.error()));
        whole_ = base_ != nullptr ? merge_values(check, base_->whole_, own_) : own_;
        RobotSpec spec = read_robot_fields(
            check, whole_,
            {[&](const FieldPath& path, const std::string& name) { return read_table(path, name); },
             [&](const FieldPath& path, const std::vector<double>& d) { return call(path, d); }, drivers_,
             [&](const FieldPath& path, const std::string& name) { return find_script(path, name); }});
        if (auto ok = check.result(); !ok) return Unexpected(file_->fail(ok.error()));
        spec.place = place;
        spec_ = std::move(spec);
        return {};
    }

    // Reads the file that the field `base` names, if there is one.
    Expected<void> build_on_base(FieldCheck& check, const Place& place) {
        Fields fields(check, own_);
        std::string name;
        if (!fields.text("base", name)) return {};
        const auto refuse = [&](const std::string& why) { check.explain({"base"}, why); };
        const auto path = project_.find(FileKind::model, name, place.file);
        if (!path) {
            refuse(path.error().message);
            return {};
        }
        const std::string shown = project_.shown(*path);
        std::vector<std::string> above = above_;
        above.push_back(shown_);
        if (contains(above, shown)) {
            refuse(fmt::format("{} can't be its own base; the bases are {}, {}", shown, fmt::join(above, ", "), shown));
            return {};
        }
        const auto text = project_.read(*path);
        if (!text) return Unexpected(text.error());
        auto base = std::make_unique<Layer>(project_, std::move(above));
        if (auto ran = base->run(*text, shown); !ran) return ran;
        base_ = std::move(base);
        return {};
    }

    // The last file that sets this field: tables are searched beside it, and functions are in its Lua state.
    Layer& owner_of(const FieldPath& path) {
        return base_ == nullptr || value_at(own_, path) != nullptr ? *this : base_->owner_of(path);
    }

    Expected<std::string> find_script(const FieldPath& path, const std::string& name) {
        auto found = nezumi::find_script(project_, name, owner_of(path).shown_);
        if (!found) return Unexpected(found.error());
        return project_.shown(*found);
    }

    using Points = Expected<std::vector<ResponseTable::Point>>;

    Points read_table(const FieldPath& path, const std::string& name) {
        Layer& owner = owner_of(path);
        return owner.read_points_in(name, owner.shown_);
    }

    Points read_points_in(const std::string& name, const std::string& named_in) {
        const auto path = project_.find(FileKind::data, name, named_in);
        if (!path) return Unexpected(path.error());
        const std::string shown = project_.shown(*path);
        const auto text = project_.read(*path);
        if (!text) return Unexpected(text.error());
        add_once(tables_, shown);
        return read_csv_response(*text, shown);
    }

    // Calls the function at this path with each distance.
    Expected<std::vector<double>> call(const FieldPath& path, const std::vector<double>& distances) {
        Layer& owner = owner_of(path);
        return owner.call_own(path, distances);
    }

    Expected<std::vector<double>> call_own(const FieldPath& path, const std::vector<double>& distances) {
        lua_State* lua = file_->lua();
        const int top = lua_gettop(lua);
        if (lua_checkstack(lua, static_cast<int>(path.size()) + 4) == 0) return failure("stack overflow");
        lua_rawgetp(lua, LUA_REGISTRYINDEX, &fields_key);
        for (const std::string& part : path) {
            if (!detail::push_raw_field(lua, lua_gettop(lua), part)) {
                lua_settop(lua, top);
                return failure("is gone");
            }
        }
        if (auto ok = check_parameters(lua, -1, 1); !ok) {
            lua_settop(lua, top);
            return Unexpected(ok.error());
        }
        std::vector<double> values;
        for (const double distance : distances) {
            lua_pushvalue(lua, -1);
            lua_pushnumber(lua, distance);
            if (const auto called = protected_call(lua, 1, 1, file_->budget()); !called) {
                Error error = file_->to_error(called.error());
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

    const Project& project_;
    std::vector<std::string> above_;
    std::vector<std::string> drivers_;
    std::string shown_;
    std::unique_ptr<DataFile> file_;
    std::unique_ptr<Layer> base_;
    Value own_, whole_;  // the table of the file, and its merge with that of the base
    std::optional<RobotSpec> spec_;
    std::vector<std::string> tables_;  // files that were read beside the robot file
};

RobotFile::RobotFile(std::unique_ptr<Layer> layer) : layer_(std::move(layer)) {}
RobotFile::~RobotFile() = default;

const RobotSpec& RobotFile::spec() const { return layer_->spec(); }
std::vector<std::string> RobotFile::files() const { return layer_->files(); }

RobotSpec RobotFile::changed(FieldCheck& check, const Value& changes, const std::string& named_in) {
    return layer_->changed(check, changes, named_in);
}

Expected<std::unique_ptr<RobotFile>> RobotFile::read(const fs::path& path, const Project& project) {
    const std::string shown = project.shown(path);
    const auto text = project.read(path);
    if (!text) return Unexpected(text.error());
    auto layer = std::make_unique<Layer>(project, std::vector<std::string>{});
    if (auto ran = layer->run(*text, shown); !ran) return Unexpected(ran.error());
    return std::unique_ptr<RobotFile>(new RobotFile(std::move(layer)));
}

Expected<RobotSpec> read_robot_text(std::string_view text, const std::string& shown, const Project& project,
                                    std::vector<std::string>* files) {
    RobotFile::Layer layer(project, {});
    if (auto ran = layer.run(text, shown); !ran) return Unexpected(ran.error());
    if (files != nullptr) {
        const auto read = layer.files();
        files->insert(files->end(), read.begin(), read.end());
    }
    return layer.spec();
}

std::vector<Error> check_robot_text(std::string_view text, const std::string& shown, const Project& project,
                                    const std::vector<std::string>& drivers) {
    RobotFile::Layer layer(project, {}, drivers);
    const auto ran = layer.run(text, shown);
    if (ran) return {};
    auto errors = layer.errors();
    if (errors.empty()) errors.push_back(ran.error());
    return errors;
}

Expected<RobotSpec> read_robot_file(const fs::path& path, const Project& project, std::vector<std::string>* files) {
    return read_changed_robot(path, "", project, files);
}

Expected<RobotSpec> read_changed_robot(const fs::path& model, const std::string& changes, const Project& project,
                                       std::vector<std::string>* files) {
    auto file = RobotFile::read(model, project);
    if (!file) return Unexpected(file.error());
    if (files != nullptr) {
        const auto read = (*file)->files();
        files->insert(files->end(), read.begin(), read.end());
    }
    if (changes.empty()) return (*file)->spec();
    const std::string shown = project.shown(model);
    const auto value = read_changes(changes, shown, project);
    if (!value) return Unexpected(value.error());
    FieldCheck check("robot", "robot", {shown}, nullptr);
    RobotSpec spec = (*file)->changed(check, *value, shown);
    if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    return spec;
}

Expected<Value> read_changes(const std::string& changes, const std::string& shown, const Project& project) {
    auto table = DataFile::create(project, {});
    if (!table) return Unexpected(table.error());
    if (auto ran = (*table)->run("return " + changes, shown, {}); !ran) return Unexpected(ran.error());
    auto value = read_file_value((*table)->lua(), -1);
    if (!value) return failure(value.error().message, {shown});
    return value;
}

}  // namespace nezumi
