// Joins readers of files, maker and reloader of behaviours to what the engine asks for.
#include "bindings/lua/reload/lua_host.hpp"

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
    LuaBehaviors(const Project& project, Budget budget) {
        settings_ = {.project = project, .budget = budget, .chunks = &chunks_};
    }

    Expected<std::unique_ptr<Component>> make(const BehaviorEntry& entry, const MakerContext& context) override {
        return make_behavior(entry, context, settings_);
    }

    BehaviorLoader loader() override {
        return [this, budget = settings_.budget](const BehaviorEntry& entry, const MakerContext& context,
                                                 const Project& project) -> Expected<std::unique_ptr<LoadedBehavior>> {
            // `this` may be gone meanwhile: the code is kept apart from that of the system.
            auto loaded = std::make_unique<Loaded>(*this);
            auto made =
                make_behavior(entry, context, {.project = project, .budget = budget, .chunks = &loaded->chunks});
            if (!made) return Unexpected(made.error());
            loaded->component = std::move(*made);
            return loaded;
        };
    }

    std::unique_ptr<Reloads> reloads_of(System& system) override {
        return std::make_unique<Reloader>(
            system, [this](const std::string& path) { return settings_.project.read_source(path); });
    }

private:
    struct Loaded final : LoadedBehavior {
        explicit Loaded(LuaBehaviors& behaviors) : all(behaviors) {}

        std::unique_ptr<Component> take() override {
            all.chunks_.take(chunks);
            component->script().settle(modules_of(all.settings_.project), &all.chunks_);
            return std::move(component);
        }

        LuaBehaviors& all;
        ChunkCache chunks;
        std::unique_ptr<ScriptComponent> component;
    };

    ChunkCache chunks_;
    BehaviorSettings settings_;
};

class LuaHost final : public ScriptHost {
public:
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
    Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project) const override {
        return nezumi::apply(values, spec, project);
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

    std::unique_ptr<Behaviors> behaviors(const Project& project, Budget budget) const override {
        return std::make_unique<LuaBehaviors>(project, budget);
    }
};

}  // namespace

const ScriptHost& lua_scripts() {
    static const LuaHost host;
    return host;
}

}  // namespace nezumi
