// A script host that returns a given description instead of reading a system file, so that a system without a file can
// restart and go back in time.
#pragma once

#include "engine/live/script_host.hpp"

namespace nezumi {

/// Reads every system file as `spec`. Everything else is left to `host`, which must outlive this object.
class GivenSystem final : public ScriptHost {
public:
    GivenSystem(const ScriptHost& host, SystemSpec spec) : host_(host), spec_(std::move(spec)) {}

    Expected<SystemSpec> read_system(const std::filesystem::path&, const Project&,
                                     const SystemFileOptions&) const override {
        return spec_;
    }
    Expected<SystemSpec> read_system_text(std::string_view text, const std::string& shown, const Project& project,
                                          const SystemFileOptions& options) const override {
        return host_.read_system_text(text, shown, project, options);
    }
    std::string write_system_text(const SystemSpec& spec, const std::string& title) const override {
        return host_.write_system_text(spec, title);
    }
    Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project,
                         const PeerWords& words) const override {
        return host_.apply(values, spec, project, words);
    }
    Expected<void> read_robot(RobotEntry& robot, SystemSpec& part, const Project& project) const override {
        return host_.read_robot(robot, part, project);
    }
    std::unique_ptr<Behaviors> behaviors(Budget budget) const override { return host_.behaviors(budget); }

private:
    const ScriptHost& host_;
    const SystemSpec spec_;
};

}  // namespace nezumi
