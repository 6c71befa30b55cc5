// A project as small as can be, and how it is run.
#pragma once

#include <string>
#include <vector>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

namespace nezumi {

/// A project of one behaviour, in a system of its own.
class BehaviorProject {
public:
    explicit BehaviorProject(const std::string& behavior,
                             const std::string& system = "behavior \"it\" { script = \"it\" }\n") {
        scratch.write("behaviors/it.lua", behavior);
        file = scratch.write("system.lua", system).string();
    }
    Outcome run(std::vector<std::string> options) const {
        options.insert(options.begin(), {"run", file, "--headless", "--speed", "max"});
        return run_nezumi(options);
    }
    Scratch scratch;
    std::string file;
};

}  // namespace nezumi
