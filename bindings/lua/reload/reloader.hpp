// Reloads scripts in a running system: all that a change touches go together, or not at all.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/script/script_component.hpp"
#include "engine/live/script_host.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

class Reloader final : public Reloads {
public:
    using Reader = std::function<Expected<SourceText>(const std::string& path)>;

    /// `read` gives the present text of a script or module.
    explicit Reloader(System& system, Reader read = read_source) : system_(system), read_(std::move(read)) {}

    Expected<ActResult> reload_files(const std::vector<std::string>& paths) override;
    Expected<ActResult> reload(const SourceText& source) override;
    Expected<ActResult> rollback(const Component& component) override;
    void after_tick() override;
    std::vector<ScriptFile> loaded_files() const override;
    std::vector<ScriptFile> files() const override;
    Expected<Rehearsal> rehearsal(const std::vector<std::string>& paths) const override;
    void limit_preparation(double seconds) override { preparation_seconds_ = seconds; }

private:
    // A version to be loaded only to see whether it can be, with copies of all that it needs.
    struct Part {
        SourceText source;
        ScriptContext context;
        Parameters parameters;
        PlainData state;
        int running = 0;  // version
    };
    using Change = std::pair<ScriptComponent*, SourceText>;

    static Expected<void> rehearse(const std::vector<Part>& parts);
    std::vector<ScriptComponent*> scripts() const;
    Expected<std::vector<Change>> changes_of(const std::vector<std::string>& paths) const;
    Expected<ActResult> run(const std::vector<Change>& changes);
    void let_ports_go(ScriptComponent& component, const ScriptComponent::Version& next, ActResult& report);
    void connect_again(ActResult& report);
    // Says which versions run now. An empty `what` is the file of each.
    void finish(const ActResult& report, std::string_view what);
    // Components of one file that run the same version.
    struct Group {
        std::string file;
        int version;
        std::vector<std::string> components;
    };
    std::vector<Group> groups_of(const ActResult& report) const;
    ActResult go_back(int reload, bool keep_settings);
    void watch_probation(const ScriptComponent& component);

    System& system_;
    Reader read_;
    int reloads_ = 0;
    double preparation_seconds_ = 0;
    std::vector<std::string> on_probation_;  // names of components
    std::vector<ScriptFile> attempted_;      // modules of the version that was refused last
    std::vector<System::Dropped> lost_;      // connections that ended with a port
};

}  // namespace nezumi
