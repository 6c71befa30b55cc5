// Copies keep the times of the exercise's files, so a file with another time was saved by the pupil.
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

// At most this many entries of a folder are examined.
constexpr int most_entries = 20000;

double megabytes(std::uintmax_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

bool is_file(const fs::path& path, struct stat& status) {
    return lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

// Calls `action` with each file below `project` and its relative path. Leaves out the editor's kept versions.
template <class Action>
void for_each_file(const fs::path& project, const Action& action) {
    std::error_code problem;
    int count = 0;
    for (fs::recursive_directory_iterator entry(project, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        if (++count > most_entries) break;
        const fs::path file = entry->path().lexically_relative(project);
        if (file == ".nezumi/versions") entry.disable_recursion_pending();
        struct stat status {};
        if (is_file(entry->path(), status)) action(file, status);
    }
}

bool is_hidden(const fs::path& file) {
    return std::any_of(file.begin(), file.end(), [](const fs::path& part) { return part.string().starts_with('.'); });
}

bool is_as_given(const struct stat& status, const fs::path& start) {
    struct stat given {};
    return is_file(start, given) && given.st_mtim.tv_sec == status.st_mtim.tv_sec &&
           given.st_mtim.tv_nsec == status.st_mtim.tv_nsec;
}

}  // namespace

WorkFolder look_at_work(const fs::path& project, const fs::path& start) {
    WorkFolder work;
    for_each_file(project, [&](const fs::path& file, const struct stat& status) {
        work.bytes += static_cast<std::uintmax_t>(status.st_size);
        ++work.files;
        if (!is_hidden(file) && !is_as_given(status, start / file))
            work.last_save = std::max(work.last_save, static_cast<std::int64_t>(status.st_mtime));
    });
    return work;
}

std::optional<OverQuota> enforce_quota(const fs::path& project, const fs::path& start, const Quota& quota) {
    std::uintmax_t bytes = 0;
    std::size_t files = 0;
    std::vector<fs::path> others;  // files that the editor can't edit
    for_each_file(project, [&](const fs::path& file, const struct stat& status) {
        if (is_as_given(status, start / file)) return;
        bytes += static_cast<std::uintmax_t>(status.st_size);
        ++files;
        if (!EditedFiles::check_name(file.generic_string())) others.push_back(file);
    });
    if (bytes <= quota.bytes && files <= quota.files) return std::nullopt;
    OverQuota over;
    for (const fs::path& file : others) {
        std::error_code problem;
        if (fs::remove(project / file, problem)) ++over.removed;
    }
    over.why =
        fmt::format("too much was written: {:.1f} MB in {} files, and at most {:.1f} MB in {} files are allowed; {}",
                    megabytes(bytes), files, megabytes(quota.bytes), quota.files,
                    over.removed == 0 ? "make the texts shorter"
                                      : fmt::format("files removed because they are not text: {}", over.removed));
    return over;
}

Expected<void> check_quota(const fs::path& project, std::string_view name, std::string_view text, const Quota& quota) {
    if (!EditedFiles::check_name(name)) return {};  // the editor refuses such a name anyway
    const WorkFolder work = look_at_work(project, {});
    struct stat status {};
    const bool is_there = is_file(project / fs::path(name), status);
    const auto before = is_there ? static_cast<std::uintmax_t>(status.st_size) : 0;
    if (!is_there && work.files >= quota.files)
        return failure(fmt::format("nothing was saved: you have {} files, and no more are allowed", work.files));
    const std::uintmax_t after = work.bytes - std::min(before, work.bytes) + text.size();
    if (text.size() > before && after > quota.bytes)
        return failure(
            fmt::format("nothing was saved: your files would have {:.1f} MB, and at most {:.1f} MB are allowed",
                        megabytes(after), megabytes(quota.bytes)));
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
