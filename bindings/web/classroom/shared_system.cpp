// A pupil's files are read without following links, as the editor reads them.
#include "bindings/web/classroom/shared_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "bindings/web/classroom/exercises.hpp"
#include "bindings/web/edited_files.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/project/folders.hpp"
#include "engine/project/project.hpp"

namespace nezumi::web {
namespace {

namespace fs = std::filesystem;

}  // namespace

Expected<std::unique_ptr<SharedSystem>> SharedSystem::open(SharedOptions options, fs::path folder) {
    std::error_code problem;
    options.file = fs::canonical(options.file, problem);
    if (problem) return failure(problem.message(), {options.file.string()});
    std::unique_ptr<SharedSystem> shared(new SharedSystem(std::move(options), std::move(folder)));
    const std::string part = shared->options.file.lexically_relative(shared->root()).generic_string();
    if (shared->root().empty() || !part.starts_with("behaviors/"))
        return failure("is not within behaviors/ of a project: make one with nezumi new project NAME",
                       {shared->options.file.string()});
    if (auto ok = shared->renew(); !ok) return Unexpected(ok.error());
    return shared;
}

fs::path SharedSystem::root() const { return Project::of(options.file).root(); }

fs::path SharedSystem::file() const { return folder / options.file.lexically_relative(root()); }

Expected<void> SharedSystem::renew() const {
    std::error_code problem;
    fs::remove_all(folder, problem);
    if (auto ok = copy_files(root() / "behaviors", folder / "behaviors", true); !ok) return ok;
    fs::remove_all(folder / exercises_folder, problem);  // pupils must not see hidden scenarios
    fs::create_directories(folder / ".nezumi", problem);
    if (problem) return failure("can't be made: " + problem.message(), {folder.string()});
    return {};
}

Expected<std::size_t> SharedSystem::take_behaviors(const fs::path& work) const {
    const EditedFiles files(work);
    std::vector<std::pair<std::string, std::string>> fresh, replacing;
    const auto runs = [&](const std::string& name) {
        return std::any_of(view.scripts().begin(), view.scripts().end(),
                           [&](const std::string& script) { return folder / script == folder / name; });
    };
    bool is_one_running = false;
    for (const std::string& name : files.names()) {
        if (!name.starts_with("behaviors/") || name.starts_with("behaviors/systems/") || !name.ends_with(".lua"))
            continue;
        auto text = files.read(name);
        if (!text) return Unexpected(text.error());
        is_one_running = is_one_running || runs(name);
        std::error_code none;
        auto& list = fs::exists(folder / name, none) ? replacing : fresh;
        list.emplace_back(name, std::move(text->text));
    }
    if (!is_one_running) {
        std::set<std::string> names;
        for (const std::string& script : view.scripts()) names.insert(fs::path(script).filename().string());
        return failure(
            fmt::format("no file of yours is a behaviour of this system, which runs {}", fmt::join(names, ", ")));
    }
    // New modules come first, because a behaviour that is reloaded may need them.
    std::size_t changed = 0;
    for (const auto& list : {fresh, replacing}) {
        for (const auto& [name, text] : list) {
            const fs::path place = folder / name;
            if (const auto before = read_whole(place, name); before && *before == text) continue;
            std::error_code none;
            fs::create_directories(place.parent_path(), none);
            if (auto ok = write_whole(place, text); !ok) return Unexpected(ok.error());
            ++changed;
        }
    }
    return changed;
}

}  // namespace nezumi::web
