// The name of an exercise is the name of its folder, and becomes part of paths. So only identifiers are allowed.
#include "bindings/web/classroom/exercises.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "engine/base/names.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::web {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_text_of_exercise = std::size_t{1} << 17;

std::string text_of(const fs::path& file) {
    return read_whole(file, file.string(), longest_text_of_exercise).value_or("");
}

}  // namespace

fs::path system_of(std::string_view exercise) {
    return fs::path("behaviors/systems") / fmt::format("{}.lua", exercise);
}

std::vector<Exercise> find_exercises(const std::vector<fs::path>& folders) {
    std::vector<Exercise> found;
    for (const fs::path& folder : folders) {
        std::error_code problem;
        for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
            Exercise each{.name = entry->path().filename().string(), .folder = entry->path()};
            const bool is_known =
                std::any_of(found.begin(), found.end(), [&](const Exercise& other) { return other.name == each.name; });
            std::error_code none;
            if (!is_identifier(each.name) || is_known ||
                !fs::is_regular_file(each.start() / system_of(each.name), none))
                continue;
            each.text = text_of(each.folder / "text.md");
            each.text_ja = text_of(each.folder / "text.ja.md");
            if (!each.text.empty()) found.push_back(std::move(each));
        }
    }
    std::sort(found.begin(), found.end(),
              [](const Exercise& left, const Exercise& right) { return left.name < right.name; });
    return found;
}

Expected<void> copy_files(const fs::path& from, const fs::path& to, bool replaces) {
    std::error_code problem;
    const auto wrong = [&](const fs::path& path) {
        return failure("can't be copied: " + problem.message(), {path.string()});
    };
    fs::create_directories(to, problem);
    if (problem) return wrong(to);
    int count = 0;
    for (fs::recursive_directory_iterator entry(from, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        const fs::path& path = entry->path();
        if (path.filename().string().starts_with('.')) {
            entry.disable_recursion_pending();
            continue;
        }
        if (entry->is_symlink(problem)) continue;
        if (++count > most_copied) return failure(fmt::format("has more than {} files", most_copied), {from.string()});
        const fs::path there = to / path.lexically_relative(from);
        if (entry->is_directory(problem)) {
            fs::create_directories(there, problem);
        } else if (entry->is_regular_file(problem)) {
            const bool is_there = fs::exists(fs::symlink_status(there, problem));
            problem.clear();
            if (is_there && !replaces) continue;
            fs::copy_file(path, there, fs::copy_options::overwrite_existing, problem);
            std::error_code none;
            fs::last_write_time(there, fs::last_write_time(path, none), none);
        }
        if (problem) return wrong(path);
    }
    if (problem) return wrong(from);
    return {};
}

}  // namespace nezumi::web
