// Implements the engine's `ScriptHost` with the readers of Lua files and the factory and reloader of behaviours.
#include "bindings/lua/reload/lua_host.hpp"

#include <map>
#include <utility>

#include "bindings/lua/files/calibration_file.hpp"
#include "bindings/lua/files/robot_file.hpp"
#include "bindings/lua/files/start_values.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/files/system_text.hpp"
#include "bindings/lua/reload/reloader.hpp"
#include "bindings/lua/script/behavior_maker.hpp"

namespace nezumi {
namespace {

class LuaBehaviors final : public Behaviors {
public:
    LuaBehaviors(Budget budget, Coverage* coverage) : budget_(budget), chunks_(coverage) {}

    void load(const BehaviorEntry& entry, const MakerContext& context, const Project& project) override {
        loaded_.emplace(entry.name,
                        make_behavior(entry, context, {.project = project, .budget = budget_, .chunks = &chunks_}));
    }
    Expected<std::unique_ptr<Component>> take(const BehaviorEntry& entry) override {
        return std::move(loaded_.extract(entry.name).mapped());
    }
    void take_all(Behaviors& others) override {
        auto& more = static_cast<LuaBehaviors&>(others);
        chunks_.take(more.chunks_);
        for (const auto& [name, loaded] : more.loaded_) {
            if (loaded) (*loaded)->script().share(&chunks_);
        }
        loaded_.merge(more.loaded_);
    }
    std::unique_ptr<Reloads> reloads_of(System& system) override { return std::make_unique<Reloader>(system, chunks_); }

private:
    const Budget budget_;
    ChunkCache chunks_;
    std::multimap<std::string, Expected<std::unique_ptr<ScriptComponent>>> loaded_;
};

class LuaHost final : public ScriptHost {
public:
    explicit LuaHost(Coverage* coverage = nullptr) : coverage_(coverage) {}

    Expected<SystemSpec> read_system(const std::filesystem::path& file, const Project& project,
                                     const SystemFileOptions& options) const override {
        return read_system_file(file, project, options);
    }
    Expected<SystemSpec> read_system_text(std::string_view text, const std::string& shown, const Project& project,
                                          const SystemFileOptions& options) const override {
        return nezumi::read_system_text(text, shown, project, options);
    }
    std::string write_system_text(const SystemSpec& spec, const std::string& title) const override {
        return nezumi::write_system_text(spec, title);
    }
    Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project,
                         const PeerWords& words) const override {
        return nezumi::apply(values, spec, project, words);
    }

    Expected<void> read_robot(RobotEntry& robot, SystemSpec& part, const Project& project) const override {
        const std::string described = robot.described_by();
        if (!part.models.contains(described)) {
            const auto path = project.find(FileKind::model, robot.model, robot.place.file);
            if (!path) return Unexpected(path.error());
            auto model = read_changed_robot(*path, robot.changes, project, &part.files);
            if (!model) return Unexpected(model.error());
            part.models.emplace(described, std::move(*model));
        }
        if (!robot.calibrated) return {};
        return use_calibration(part, robot, project, {.is_needed = true, .serial = ""});
    }

    std::unique_ptr<Behaviors> behaviors(Budget budget) const override {
        // Coverage marks take at most twice the time of the script itself, which the budget must allow for.
        if (coverage_ != nullptr) budget.seconds *= 3;
        return std::make_unique<LuaBehaviors>(budget, coverage_);
    }

private:
    Coverage* const coverage_;
};

}  // namespace

const ScriptHost& lua_scripts() {
    static const LuaHost host;
    return host;
}

std::unique_ptr<ScriptHost> covered_scripts(Coverage& coverage) { return std::make_unique<LuaHost>(&coverage); }

}  // namespace nezumi
