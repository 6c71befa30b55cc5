// Readers of texts in Lua: systems, robots, behaviours, what the sandbox runs, scenarios, and files as `nezumi check`
// reads them.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/files/check_files.hpp"
#include "bindings/lua/files/robot_file.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/script/script_component.hpp"
#include "bindings/scenario/condition.hpp"
#include "reader.hpp"
#include "tests/unit/lua/objects_rig.hpp"
#include "tests/unit/lua/sandbox_support.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/scenario/scenario_rig.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi::texts {
namespace {

std::string without(std::string text, const std::string& part) {
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part)) text.erase(at, part.size());
    return text;
}

// An error beside its line; with its place where it is not in the text itself, which `file` names.
Remark remark_of(const Error& error, const std::string& file, std::string word = "error") {
    if (error.place.file != file || error.place.line == 0) return {.word = std::move(word), .text = describe(error)};
    return {std::move(word), error.place.line, error.place.column, error.message};
}

// The files of a case, in a folder of its own, whose path messages leave out.
class Folder {
public:
    void write(const std::string& name, const std::string& text) const { scratch_.write(name, text); }
    std::filesystem::path path(const std::string& name) const { return scratch_.path(name); }
    std::string shortened(std::string text) const {
        return without(without(std::move(text), scratch_.path("").string()), source_root() + "/");
    }
    Error shortened(Error error) const {
        error.message = shortened(std::move(error.message));
        error.place.file = shortened(std::move(error.place.file));
        return error;
    }

private:
    Scratch scratch_;
};

// A system file of a project with what is shipped; it is read, not built.
class SystemReader : public CaseReader {
public:
    void write(const std::string& name, const std::string& text) override { folder_.write(name, text); }
    std::vector<Remark> read(const Text& text) override {
        std::vector<Remark> remarks;
        SystemFileOptions options;
        options.peer_words = cli::peer_words();
        options.print = [&](std::string_view line) {
            remarks.push_back({.word = "prints", .text = std::string(line)});
        };
        const auto file = folder_.path(name_);
        const auto spec = read_system_text(text.code, file.string(), Project::of(file, {root}), options);
        if (!spec) remarks.push_back(remark_of(folder_.shortened(spec.error()), name_));
        for (Remark& remark : remarks) remark.text = folder_.shortened(remark.text);
        return remarks;
    }

private:
    const std::string name_ = "system.lua";
    Folder folder_;
};

// A robot file. A text that is only fields is added to a robot that has what a robot needs.
class RobotReader : public CaseReader {
public:
    void write(const std::string& name, const std::string& text) override { folder_.write(name, text); }
    std::vector<Remark> read(const Text& text) override {
        const bool whole = text.code.starts_with("return") || text.code.starts_with("local");
        const std::string code = whole ? text.code
                                       : "return robot_model { mass = 1, body = { size = { 0.1, 0.1, 0.1 } }, "
                                         "drive = { radius = 0.02, track = 0.1 },\n" +
                                             text.code + " }";
        const auto file = folder_.path("engine/robots/robot.lua");
        const auto spec = read_robot_text(code, file.string(), Project::of(file, {root}));
        if (spec) return {};
        Remark remark = remark_of(folder_.shortened(spec.error()), "engine/robots/robot.lua");
        if (!whole && remark.line > 1) --remark.line;
        return {remark};
    }

private:
    Folder folder_;
};

// A behaviour, which is loaded, activated and executed once. Its modules are the files of the case.
class BehaviorReader : public CaseReader {
public:
    void write(const std::string& name, const std::string& text) override { files_[name] = text; }
    std::vector<Remark> read(const Text& text) override {
        std::vector<Remark> remarks;
        const std::string file = "behavior.lua";
        ScriptContext context;
        context.budget = headless_budget;
        context.find_module = [this](std::string_view name, std::string_view) -> Expected<SourceText> {
            const auto found = files_.find(std::string(name) + ".lua");
            if (found == files_.end()) return failure("there is no module '" + std::string(name) + "'");
            return SourceText{"behaviors/" + found->first, found->first, found->second};
        };
        auto component =
            ScriptComponent::load("controller", {"behaviors/" + file, file, text.code}, std::move(context));
        if (!component) return {remark_of(component.error(), file)};
        (*component)->set_log([&](const LogLine& line) {
            if (line.level != LogLevel::error)
                remarks.push_back({.word = "prints", .text = fmt::format("{}: {}", to_text(line.level), line.text)});
        });
        if (const auto activated = (*component)->activate({}); activated) {
            (*component)->latch_inputs({});
            (*component)->execute({});
        }
        if ((*component)->state() == LifeState::error) remarks.push_back(remark_of((*component)->last_error(), file));
        return remarks;
    }

private:
    std::map<std::string, std::string> files_;
};

// Lua in the sandbox. Texts of a case share it, so globals of one are seen by the next.
class SandboxReader : public CaseReader {
public:
    void write(const std::string&, const std::string&) override {}
    std::vector<Remark> read(const Text& text) override { return run_in(box_, text); }

    static std::vector<Remark> run_in(Box& box, const Text& text) {
        std::vector<Remark> remarks;
        box.printed.clear();
        const auto returned = box.try_run(text.code);
        for (const std::string& line : box.printed) remarks.push_back({.word = "prints", .text = line});
        if (!returned)
            remarks.push_back(remark_of(returned.error(), "box.lua"));
        else if (!returned->empty())
            remarks.push_back({.word = "returns", .text = *returned});
        return remarks;
    }

private:
    Box box_;
};

// The same beside the counter's system, with the objects `world`, `mouse` and `controller`.
class ObjectReader : public CaseReader {
public:
    void write(const std::string& name, const std::string& text) override { rig_.folder.write(name, text); }
    std::vector<Remark> read(const Text& text) override { return SandboxReader::run_in(rig_.box, text); }

private:
    Objective rig_;
};

// A file of scenarios, or the body of one, which has `s`. All its runs are made.
class ScenarioReader : public CaseReader {
public:
    void write(const std::string& name, const std::string& text) override { folder_.write(name, text); }
    std::vector<Remark> read(const Text& text) override {
        const bool whole = text.code.starts_with("scen") || text.code.find("\nscenario(") != std::string::npos;
        folder_.write(name_, whole ? text.code : "scenario('it', function(s) " + text.code + "\nend)");
        folder_.write("behaviors/none.lua", "param('x', 1)");
        TestSessionOptions options = simulated_session();
        options.folder = folder_.path("failures");
        options.peer_words = cli::peer_words();
        const auto planned = plan_tests({.paths = {folder_.path(name_)},
                                         .seed = options.seed,
                                         .installed = options.installed,
                                         .peer_words = options.peer_words});
        if (!planned) return {remark_of(folder_.shortened(planned.error()), name_)};
        std::vector<Remark> remarks;
        for (const auto& file : planned->files) {
            for (const Error& error : file.errors) remarks.push_back(remark_of(folder_.shortened(error), name_));
        }
        for (const PlannedRun& run : planned->runs) {
            const RunResult result = run_planned(*planned, run, options, true);
            for (const std::string& line : result.printed)
                remarks.push_back({.word = "prints", .text = folder_.shortened(line)});
            if (result.outcome == RunOutcome::passed) continue;
            remarks.push_back(remark_of(folder_.shortened(result.error), name_,
                                        result.outcome == RunOutcome::failed ? "failed" : "error"));
        }
        return remarks;
    }

private:
    const std::string name_ = "it_test.lua";
    Folder folder_;
};

// Lua that returns a condition. Its margin in one sample, and the comparison that decided.
class MarginReader : public CaseReader {
public:
    void write(const std::string&, const std::string&) override {}
    std::vector<Remark> read(const Text& text) override {
        auto state = create_sandbox().value();
        lua_State* const lua = state->lua();
        const std::string file = "box.lua";
        const auto chunk = compile(text.code, file);
        if (!chunk) return {remark_of(chunk.error(), file)};
        if (auto ran = load_chunk(lua, *chunk); !ran) return {remark_of(ran.error(), file)};
        if (auto ran = protected_call(lua, 0, 1, {}); !ran) return {remark_of(ran.error(), file)};
        FunctionTexts texts([&](const std::string& name) { return name == file ? &text.code : nullptr; });
        auto condition = Condition::take(lua, -1, texts);
        if (!condition) return {remark_of(condition.error(), file)};
        const auto held = (*condition)->sample(lua);
        if (!held) return {remark_of(held.error(), file)};
        const Robustness& margin = (*condition)->robustness();
        if (std::isfinite(margin.value))
            return {{.word = "returns",
                     .text = fmt::format("{} ({})", text_of_number(margin.value, margin.decided->unit),
                                         text_of(*margin.decided))}};
        const std::string& why = (*condition)->why();
        return {{.word = "returns", .text = "none: " + (why.empty() ? why_without_numbers(margin) : why)}};
    }
};

// A file as `nezumi check` reads it. All texts of a case are files of one project.
class CheckReader : public CaseReader {
public:
    void write(const std::string& name, const std::string& text) override { folder_.write(name, text); }
    std::vector<Remark> read(const Text& text) override {
        std::vector<Remark> remarks;
        for (const Error& error : cli::check_file(folder_.path(text.name), cli::simulated_systems()))
            remarks.push_back(remark_of(folder_.shortened(error), text.name));
        return remarks;
    }

private:
    Folder folder_;
};

}  // namespace

std::string CaseReader::answer(const std::string&) { return "this kind has no transcripts"; }

std::unique_ptr<CaseReader> make_reader(std::string_view kind) {
    if (kind == "systems") return std::make_unique<SystemReader>();
    if (kind == "robots") return std::make_unique<RobotReader>();
    if (kind == "behaviors") return std::make_unique<BehaviorReader>();
    if (kind == "sandbox") return std::make_unique<SandboxReader>();
    if (kind == "objects") return std::make_unique<ObjectReader>();
    if (kind == "scenarios") return std::make_unique<ScenarioReader>();
    if (kind == "margins") return std::make_unique<MarginReader>();
    if (kind == "checks") return std::make_unique<CheckReader>();
    if (kind == "console") return make_console_reader();
    if (kind == "commands") return make_command_reader();
    return nullptr;
}

}  // namespace nezumi::texts
