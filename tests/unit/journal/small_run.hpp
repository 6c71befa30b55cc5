// A system with one behaviour, journaled tick by tick.
#pragma once

#include <functional>
#include <memory>
#include <sstream>
#include <string>

#include "bindings/journal/journal.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/journal/random_run.hpp"

namespace nezumi {

/// Journals as `nezumi run --journal` does.
struct SmallRun {
    explicit SmallRun(const std::string& script, Budget budget = headless_budget,
                      const std::function<void(const Scratch&)>& prepare = {}) {
        folder.write("behaviors/it.lua", script);
        if (prepare) prepare(folder);
        const std::filesystem::path system = folder.write("system.lua", "behavior 'it' { script = 'it' }\n");
        LiveOptions options;
        options.scripts = &lua_scripts();
        options.budget = budget;
        live = std::move(RunningSystem::load(system, std::move(options)).value());
        journal = std::move(Journal::create(file).value());
        journal->begin(*live, journal_version, false);
        live->activate();
    }
    void tick(int count = 1) {
        for (; count > 0; --count) live->tick();
    }
    std::uint64_t end() {
        journal->end(RunEnd::duration, "", live->when(), live->trace_hash());
        return live->trace_hash();
    }
    /// The journal with a line replaced, or the error of replaying it.
    std::string error_with(int line, const std::string& other) const {
        std::istringstream in(text_of_file(file));
        std::string changed;
        std::string each;
        for (int number = 1; std::getline(in, each); ++number) changed += (number == line ? other : each) + "\n";
        const std::filesystem::path copy = folder.write("changed.journal", changed);
        std::string error = replay(copy).error;
        const auto at = error.find(copy.string());
        return at == std::string::npos ? error : error.replace(at, copy.string().size(), "J");
    }

    Scratch folder;
    std::filesystem::path file = folder.path("it.journal");
    std::unique_ptr<RunningSystem> live;
    std::unique_ptr<Journal> journal;
};

/// A behaviour that writes how far it has counted.
inline const std::string counter = R"(
local out = output("out", "TimedLong")
param("step", 1)
local n = 0
function on_execute() n = n + config.step out:write(n) end
)";

}  // namespace nezumi
