// Recognizes a system file by its globals, which a behaviour may not use.
#include "bindings/lua/files/find_script.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "bindings/lua/syntax/globals.hpp"
#include "engine/base/list.hpp"

namespace nezumi {
namespace {

// Words that only a system file contains; others, such as `map` or `rate`, may be mistakes in a behaviour.
constexpr std::array<std::string_view, 5> naming_words{"arena", "robot", "behavior", "component", "connect"};

// Whether a text is a system file. A text that only requires modules counts as one, because these may be the system.
bool is_system(std::string_view text) {
    int of_systems = 0;
    int of_others = 0;
    bool names_things = false;
    bool requires_something = false;
    const SyntaxTree tree(without_preamble(text));
    for (const GlobalUse& use : global_uses(tree)) {
        if (use.assigned && use.name().starts_with("on_")) return false;
        if (use.name() == "require") {
            requires_something = true;
        } else if (!contains(sandbox_names(), use.name())) {
            ++(contains(system_word_names(), use.name()) ? of_systems : of_others);
            names_things = names_things || contains(naming_words, use.name());
        }
    }
    return (names_things && of_systems > of_others) || (requires_something && of_others == 0);
}

}  // namespace

Expected<std::filesystem::path> find_script(const Project& project, std::string_view name,
                                            const std::filesystem::path& named_in) {
    std::vector<std::string> systems;
    auto found = project.find(FileKind::script, name, named_in, [&](const std::filesystem::path& file) {
        const auto text = project.read(file);
        if (!text || !is_system(*text)) return false;
        systems.push_back(project.shown(file));
        return true;
    });
    if (found || systems.empty()) return found;
    return failure(fmt::format("{}; {}: `nezumi new behavior` makes one, in behaviors/", found.error().message,
                               systems.size() == 1
                                   ? systems.front() + " is a system file, not a behaviour"
                                   : fmt::format("{} are system files, not behaviours", fmt::join(systems, ", "))));
}

}  // namespace nezumi
