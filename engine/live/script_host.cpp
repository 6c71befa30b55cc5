// The script host of a program without a script language.
#include "engine/live/script_host.hpp"

#include <algorithm>

#include "engine/base/list.hpp"
#include "engine/messages/message_catalog.hpp"
#include "engine/tree/node.hpp"

namespace nezumi {
namespace {

Unexpected none() { return failure("this program can't run scripts: it has only components in C++"); }

class NoReloads final : public Reloads {
public:
    Loader loader() const override {
        return [](const auto&...) { return std::make_unique<PreparedReload>(); };
    }
    bool fits(const PreparedReload& /*prepared*/) const override { return true; }
    Expected<ActResult> commit(PreparedReload& /*prepared*/, const Project& /*project*/) override {
        return ActResult{};
    }
    Expected<ActResult> rollback(const Component& /*component*/) override { return none(); }
    void after_tick() override {}
    std::vector<ScriptFile> loaded_files() const override { return {}; }
    std::vector<ScriptFile> files() const override { return {}; }
};

class NoBehaviors final : public Behaviors {
public:
    void load(const BehaviorEntry& /*entry*/, const MakerContext& /*context*/, const Project& /*project*/) override {}
    Expected<std::unique_ptr<Component>> take(const BehaviorEntry& /*entry*/) override { return none(); }
    void take_all(Behaviors& /*others*/) override {}
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
    Expected<void> apply(const StartValues& /*values*/, SystemSpec& /*spec*/, const Project& /*project*/,
                         const PeerWords& /*words*/) const override {
        return {};
    }
    Expected<void> read_robot(RobotEntry& robot, SystemSpec& part, const Project& /*project*/) const override {
        return part.models.contains(robot.described_by()) ? Expected<void>() : none();
    }
    std::unique_ptr<Behaviors> behaviors(Budget /*budget*/) const override { return std::make_unique<NoBehaviors>(); }
};

}  // namespace

const MessageType* PartReader::find_message(std::string_view name) const {
    const auto found =
        std::find_if(types.begin(), types.end(), [&](const MessageType* each) { return each->name == name; });
    return found != types.end() ? *found : MessageCatalog::shared().find(name);
}

std::vector<const MessageType*> defined_messages(const System& system) {
    std::vector<const MessageType*> all;
    for (const auto& component : system.components()) {
        for (const Port* port : ports_of(*component)) {
            if (!port->type()->is_compiled() && !contains(all, port->type())) all.push_back(port->type());
        }
    }
    return all;
}

const ScriptHost& no_scripts() {
    static const NoScripts host;
    return host;
}

}  // namespace nezumi
