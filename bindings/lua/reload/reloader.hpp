// Reloads scripts in a running system: all components that a change affects, or none.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/script/script_component.hpp"
#include "engine/live/script_host.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

class Reloader final : public Reloads {
public:
    /// `system` and `chunks` must outlive this object. `chunks` gets the code of all versions.
    Reloader(System& system, ChunkCache& chunks) : system_(system), chunks_(chunks) {}

    Loader loader() const override;
    bool fits(const PreparedReload& prepared) const override;
    Expected<ActResult> commit(PreparedReload& prepared, const Project& project) override;
    Expected<ActResult> rollback(const Component& component) override;
    void after_tick() override;
    std::vector<ScriptFile> loaded_files() const override;
    std::vector<ScriptFile> files() const override;

private:
    struct Next;
    struct Prepared;

    std::vector<ScriptComponent*> scripts() const;
    void let_ports_go(ScriptComponent& component, const ScriptComponent::Version& next, std::size_t first_lost,
                      ActResult& report);
    void connect_again(ActResult& report);
    // Reports the versions that run now. If `what` is empty, reports the file of each.
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
    ChunkCache& chunks_;
    int reloads_ = 0;
    std::vector<std::string> on_probation_;  // names of components
    std::vector<ScriptFile> attempted_;      // modules of the last refused version
    std::vector<System::Dropped> lost_;      // connections that ended because a port was removed
};

}  // namespace nezumi
