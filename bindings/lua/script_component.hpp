// A component written in Lua: one file is one component type.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/script.hpp"
#include "engine/component.hpp"

namespace nezumi {

class ScriptComponent final : public Component {
public:
    /// A component of this name from the text of its file; INACTIVE. `context.component` is set to the name.
    static Expected<std::unique_ptr<ScriptComponent>> load(std::string name, SourceText source, ScriptContext context);

    int version() const override { return version_; }
    Script& script() { return *script_; }
    const Script& script() const { return *script_; }

    /// The commands that its script gives, callable as `name:command(...)`.
    const std::vector<CommandDeclaration>& commands() const { return script_->commands(); }
    /// Runs a command between two ticks. When it fails, nothing that it wrote is published and the component goes on.
    Expected<PlainData> call_command(std::string_view command, const PlainData& arguments, const Time& now);
    /// A copy of the script's `state`, for a look at it; what is no plain data is left out.
    Expected<PlainData> copy_state();

    // The steps of a reload. None of them is of use alone: `Reloader` makes a transaction of them.

    /// A version that does not run (yet, or any more), with the ports that only it has.
    struct Version {
        std::unique_ptr<Script> script;
        int number = 0;
        Parameters parameters;
        std::vector<std::unique_ptr<InPortBase>> in_ports;
        std::vector<std::unique_ptr<OutPortBase>> out_ports;
        std::vector<std::string> warnings;  ///< what could not be taken over from the version before
    };

    /// Loads another version, which takes over the state and the parameters of the one that runs. Touches nothing.
    Expected<Version> prepare(SourceText source, const Time& now);
    /// Makes the ports that it needs and runs its `on_reload`. Touches nothing.
    Expected<void> adopt(Version& next, const Time& now);
    /// The ports that have no place in `next`.
    std::vector<Port*> ports_going(const Version& next) const;
    /// Replaces the version that runs, between two ticks; can't fail. Ports that fit stay the same objects with what
    /// they hold, those in `ports_going` are in the version that is returned. They must be disconnected by then.
    Version commit(Version next);

    /// The number that the next version will have.
    int next_version() const { return newest_ + 1; }

protected:
    Expected<void> on_activated() override { return script_->call(Hook::on_activated); }
    Expected<void> on_execute() override { return script_->call(Hook::on_execute); }
    Expected<void> on_deactivated() override { return script_->call(Hook::on_deactivated); }
    Expected<void> on_aborting() override { return script_->call(Hook::on_aborting); }
    Expected<void> on_error() override { return script_->call(Hook::on_error); }
    Expected<void> on_reset() override { return script_->call(Hook::on_reset); }

private:
    ScriptComponent(std::string name, std::string type) : Component(std::move(name), std::move(type)) {}

    void make_ports(Version& next) const;
    void fill_slots(Version& next) const;

    std::unique_ptr<Script> script_;
    int version_ = 0;
    int newest_ = 0;  // the highest number that a version had
};

}  // namespace nezumi
