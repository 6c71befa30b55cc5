// What stands for a language where there is none.
#include "engine/live/script_host.hpp"

namespace nezumi {
namespace {

Unexpected none() { return failure("there are no scripts here: this program has components in C++ alone"); }

class NoReloads final : public Reloads {
public:
    Expected<ActResult> reload_files(const std::vector<std::string>& /*paths*/) override { return ActResult{}; }
    Expected<ActResult> reload(const SourceText& /*source*/) override { return none(); }
    Expected<ActResult> rollback(const Component& /*component*/) override { return none(); }
    void after_tick() override {}
    std::vector<ScriptFile> loaded_files() const override { return {}; }
    std::vector<ScriptFile> files() const override { return {}; }
    Expected<Rehearsal> rehearsal(const std::vector<std::string>& /*paths*/) const override {
        return [] { return Expected<void>(); };
    }
    void limit_preparation(double /*seconds*/) override {}
};

class NoBehaviors final : public Behaviors {
public:
    Expected<std::unique_ptr<Component>> make(const BehaviorEntry& /*entry*/,
                                              const MakerContext& /*context*/) override {
        return none();
    }
    BehaviorLoader loader() override {
        return [](const auto&, const auto&, const auto&) { return none(); };
    }
    std::unique_ptr<Reloads> reloads_of(System& /*system*/) override { return std::make_unique<NoReloads>(); }
};

class NoScripts final : public ScriptHost {
public:
    Expected<SystemSpec> read_system(const std::filesystem::path& /*file*/, const Project& /*project*/,
                                     const SystemFileOptions& /*options*/) const override {
        return none();
    }
    Expected<SystemSpec> read_system_text(std::string_view /*text*/, const std::string& /*shown*/,
                                          const Project& /*project*/,
                                          const SystemFileOptions& /*options*/) const override {
        return none();
    }
    std::string write_system_text(const SystemSpec& /*spec*/, const std::string& /*title*/) const override {
        return "";
    }
    Expected<void> apply(const StartValues& /*values*/, SystemSpec& /*spec*/,
                         const Project& /*project*/) const override {
        return {};
    }
    Expected<void> read_robot(RobotEntry& robot, SystemSpec& part, const Project& /*project*/) const override {
        return part.models.contains(robot.described_by()) ? Expected<void>() : none();
    }
    std::unique_ptr<Behaviors> behaviors(const Project& /*project*/, Budget /*budget*/) const override {
        return std::make_unique<NoBehaviors>();
    }
};

}  // namespace

const ScriptHost& no_scripts() {
    static const NoScripts host;
    return host;
}

}  // namespace nezumi
