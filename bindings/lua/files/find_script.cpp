// A system file is told by its globals: a behaviour that used them would be refused.
#include "bindings/lua/files/find_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/sandbox/globals_scan.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"

namespace nezumi {
namespace {

template <class Names>
bool has(const Names& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// Whether a text makes a system, or has one made by what it requires.
bool is_system(std::string_view text) {
    int of_systems = 0;
    int of_others = 0;
    bool requires_something = false;
    for (const GlobalUse& use : scan_globals(text)) {
        if (use.assigned && use.name.starts_with("on_")) return false;
        if (use.name == "require") {
            requires_something = true;
        } else if (!has(sandbox_names(), use.name)) {
            ++(has(system_word_names(), use.name) ? of_systems : of_others);
        }
    }
    return of_systems > of_others || (requires_something && of_others == 0);
}

}  // namespace

Expected<std::filesystem::path> find_script(const Project& project, std::string_view name,
                                            const std::filesystem::path& named_in) {
    std::string systems;
    auto found = project.find(FileKind::script, name, named_in, [&](const std::filesystem::path& file) {
        const std::string shown = project.shown(file);
        const auto text = project.read(file);
        if (!text || !is_system(*text)) return false;
        systems += (systems.empty() ? "" : ", ") + shown;
        return true;
    });
    if (found || systems.empty()) return found;
    return failure(
        fmt::format("there is no script '{}': {} is a system file, and no behaviour: `nezumi new behavior` makes one, "
                    "in behaviors/",
                    shown(name), systems));
}

}  // namespace nezumi
