// Copies keep the times of the exercise's files, so a file with another time was saved by somebody.
#include "bindings/web/classroom/work_folder.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <system_error>
#include <tuple>
#include <vector>

#include "bindings/web/edited_files.hpp"

namespace nezumi::web {
namespace {

namespace fs = std::filesystem;

// A folder with more entries is not looked at further.
constexpr int most_entries = 20000;

bool is_file(const fs::path& path, struct stat& status) {
    return lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

WorkFolder look_at_work(const fs::path& project, const fs::path& start) {
    WorkFolder work;
    std::error_code problem;
    int count = 0;
    for (fs::recursive_directory_iterator entry(project, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        if (++count > most_entries) break;
        if (entry->path().filename().string().starts_with('.')) {
            entry.disable_recursion_pending();
            continue;
        }
        struct stat status {
        }, given{};
        if (!is_file(entry->path(), status)) continue;
        work.bytes += static_cast<std::uintmax_t>(status.st_size);
        ++work.files;
        const bool is_as_given = is_file(start / entry->path().lexically_relative(project), given) &&
                                 given.st_mtim.tv_sec == status.st_mtim.tv_sec &&
                                 given.st_mtim.tv_nsec == status.st_mtim.tv_nsec;
        if (!is_as_given) work.last_save = std::max(work.last_save, static_cast<std::int64_t>(status.st_mtime));
    }
    return work;
}

Expected<void> check_quota(const fs::path& project, std::string_view name, std::string_view text, const Quota& quota) {
    if (!EditedFiles::check_name(name)) return {};  // the editor refuses it
    const WorkFolder work = look_at_work(project, {});
    struct stat status {};
    const bool is_there = is_file(project / fs::path(name), status);
    const auto before = is_there ? static_cast<std::uintmax_t>(status.st_size) : 0;
    if (!is_there && work.files >= quota.files)
        return failure(fmt::format("nothing was saved: you have {} files, the most that are allowed", work.files));
    const std::uintmax_t after = work.bytes - std::min(before, work.bytes) + text.size();
    if (text.size() > before && after > quota.bytes)
        return failure(fmt::format("nothing was saved: your files would have {:.1f} MB, and {:.1f} MB are allowed",
                                   static_cast<double>(after) / (1 << 20),
                                   static_cast<double>(quota.bytes) / (1 << 20)));
    return {};
}

void trim_versions(const fs::path& project, std::uintmax_t most) {
    std::vector<std::tuple<std::int64_t, std::uintmax_t, fs::path>> versions;
    std::uintmax_t bytes = 0;
    std::error_code problem;
    for (fs::recursive_directory_iterator entry(project / ".nezumi/versions", problem), end; !problem && entry != end;
         entry.increment(problem)) {
        struct stat status {};
        if (!is_file(entry->path(), status)) continue;
        const auto size = static_cast<std::uintmax_t>(status.st_size);
        bytes += size;
        versions.emplace_back(status.st_mtime, size, entry->path());
    }
    if (bytes <= most) return;
    std::sort(versions.begin(), versions.end());
    for (const auto& [time, size, path] : versions) {
        if (bytes <= most) break;
        fs::remove(path, problem);
        bytes -= size;
    }
}

}  // namespace nezumi::web
