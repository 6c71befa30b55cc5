// Methods of a scenario about recorded runs: s:recorded and s:judge.
#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/read_options.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "bindings/scenario/scenario_methods.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

// The file of a recording: beside the scenario's file, then in the project, then as it is given.
fs::path find_recording(const ScenarioFile& file, const Place& place, const std::string& name) {
    const fs::path places[] = {fs::path(place.file).parent_path() / name, file.project().root() / name};
    std::error_code none;
    for (const fs::path& each : places) {
        if (fs::is_regular_file(each, none)) return each.lexically_normal();
    }
    return name;
}

// Reads { ["/scan"] = "robot.scan" }.
void read_map(Fields& fields, std::map<std::string, std::string>& map) {
    Fields topics = fields.inner("map");
    for (const FileField& each : topics.all()) topics.text(each.name, map[each.name]);
    topics.done();
}

}  // namespace

int ScenarioRun::Methods::recorded(ScenarioRun& run, lua_State* lua) {
    if (lua_type(lua, 2) != LUA_TSTRING)
        return raise(run, "expected the file of a recording, as in s:recorded \"drive.mcap\"");
    const std::string name(lua_tostring(lua, 2));
    RecordedOptions options;
    std::map<std::string, std::string> map;
    auto check = FieldCheck::of_options(fmt::format("'{}'", shown(name)));
    if (auto ok = read_options(lua, 3, std::move(check), options, {}, [&](Fields& fields) { read_map(fields, map); });
        !ok)
        return raise(run, ok.error().message);
    LiveOptions systems = run.world_options();
    run.result_.reads.push_back(find_recording(run.file_, calling_place(lua), name).string());
    if (run.settings_.recordings == nullptr || systems.build.real_time)
        return raise(run, "recordings can be used only in simulation");
    const fs::path file = find_recording(run.file_, calling_place(lua), name);
    auto world = run.settings_.recordings->open(file, map, std::move(systems));
    if (!world) {
        run.setup_error_ = Error{one_line(describe(world.error())), calling_place(lua)};
        return raise(run, run.setup_error_->message);
    }
    const double length = (*world)->length();
    RunningSystem& live = run.worlds_.add(std::move(*world));
    live.activate();
    if (run.settings_.files != nullptr) run.settings_.files->begin_recorded(run.worlds_.size() - 1, live, file);
    const auto pushed = protect(lua, condition_budget, [&](lua_State* inside) {
        run.objects_->push_system(inside, live);
        lua_pushnumber(inside, length);
        return 2;
    });
    return pushed ? 2 : raise(run, pushed.error().message);
}

int ScenarioRun::Methods::judge(ScenarioRun& run, lua_State* lua) {
    if (lua_type(lua, 2) != LUA_TTABLE)
        return raise(run, "expected options, as in s:judge { behavior = \"keeper\", run = \"drive.mcap\" }");
    JudgeRequest request;
    if (auto ok = read_options(lua, 2, FieldCheck::of_options("judge"), request, {},
                               [&](Fields& fields) { read_map(fields, request.map); });
        !ok)
        return raise(run, ok.error().message);
    if (run.settings_.recordings == nullptr) return raise(run, "behaviours can be judged only in simulation");
    const Place place = calling_place(lua);
    const auto script = run.file_.project().find(FileKind::script, request.behavior, place.file);
    if (!script) return raise(run, script.error().message);
    request.behavior = script->string();
    request.run = find_recording(run.file_, place, request.run).string();
    run.result_.reads.insert(run.result_.reads.end(), {request.behavior, request.run});
    const auto lines = run.settings_.recordings->judge(request);
    if (!lines) {
        run.setup_error_ = Error{one_line(describe(lines.error())), place};
        return raise(run, run.setup_error_->message);
    }
    if (lines->empty()) return 0;
    fails(run, lua, fmt::format("judge failed: {}", lines->front()));
    for (std::size_t i = 1; i < lines->size(); ++i) run.result_.facts.push_back((*lines)[i]);
    return end_run;
}

}  // namespace nezumi
