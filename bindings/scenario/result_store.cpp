// Stores the results of runs, a file for each. A file name is the hash of its result's key; the file also contains the
// key.
#include "bindings/scenario/result_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <compare>
#include <iterator>
#include <set>
#include <system_error>
#include <tuple>

#include "bindings/scenario/archive.hpp"
#include "bindings/scenario/margins.hpp"
#include "bindings/scenario/measures.hpp"
#include "engine/base/find_files.hpp"
#include "engine/base/list.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/ports/payload.hpp"
#include "engine/project/project.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_picture = std::size_t{256} << 20;  // [bytes] of a file that a run reads
constexpr std::string_view result_magic = "nezumi result 4\n";

std::string text_of(const ResultKey& key) {
    return fmt::format("{}\n{}\n{}\n{}\n{}", key.file, key.run, key.repetition, key.simplest ? "simplest" : "run",
                       key.seed);
}

// Beside scenarios, only files of kinds that runs read count. Others may change during a session, such as logs and
// reports.
bool is_read_by_runs(const fs::path& file) {
    static constexpr std::array<std::string_view, 13> endings{".lua", ".csv",  ".yaml", ".yml", ".pgm",  ".ppm", ".png",
                                                              ".jpg", ".jpeg", ".bmp",  ".tif", ".tiff", ".webp"};
    const std::string ending = file.extension().string();
    if (!contains(endings, ending)) return false;
    // Files beside this one belong to a failure.
    std::error_code none;
    return !fs::exists(file.parent_path() / "failure.txt", none);
}

// The folders whose files can change the result of a scenario file.
struct ReadFolders {
    fs::path behaviors;       // of its project; empty if there is none
    fs::path own;             // the project's folder that contains the scenario, such as tests/; else its own folder
    bool with_below = false;  // not for the project's own folder, and not outside of a project

    bool operator<(const ReadFolders& other) const {  // libc++ 13 compares paths in no other way
        return std::tie(behaviors, own, with_below) < std::tie(other.behaviors, other.own, other.with_below);
    }
};

ReadFolders folders_of(const fs::path& scenario, const std::vector<fs::path>& installed) {
    const fs::path root = Project::of(scenario, installed).root();
    std::error_code none;
    const fs::path folder = fs::weakly_canonical(fs::absolute(scenario), none).parent_path();
    if (root.empty()) return {{}, folder, false};
    const fs::path within = folder.lexically_relative(fs::weakly_canonical(root, none));
    if (within.empty() || within == "." || *within.begin() == "..") return {root / "behaviors", folder, false};
    return {root / "behaviors", root / *within.begin(), true};
}

// The files of the project that a run of a scenario file may read: all in its behaviors, and files of some kinds in the
// scenario's own folder.
std::set<fs::path> files_in(const ReadFolders& folders) {
    std::set<fs::path> files;
    if (!folders.behaviors.empty()) {
        const FoundFiles found = find_files(folders.behaviors, "");
        files.insert(found.files.begin(), found.files.end());
    }
    std::error_code none;
    if (folders.with_below) {
        const FoundFiles found = find_files(folders.own, "");
        std::copy_if(found.files.begin(), found.files.end(), std::inserter(files, files.end()), is_read_by_runs);
    } else {
        std::error_code problem;
        for (fs::directory_iterator entry(folders.own, problem), end; !problem && entry != end;
             entry.increment(problem)) {
            if (entry->is_regular_file(none) && is_read_by_runs(entry->path())) files.insert(entry->path());
        }
    }
    return files;
}

}  // namespace

std::uint64_t fingerprint(const TestPlan& plan, std::uint64_t seed, const std::string& version,
                          const std::vector<fs::path>& installed) {
    std::uint64_t all = mix(mix(0, version), seed);
    std::set<ReadFolders> read;
    for (const PlannedFile& file : plan.files) {
        const ReadFolders folders = folders_of(file.path, installed);
        if (!read.insert(folders).second) continue;
        for (const fs::path& path : files_in(folders)) {
            const std::string text = read_whole(path, path.string(), largest_picture).value_or("");
            if (is_measures_csv(text) || is_margins_csv(text)) continue;  // written by an earlier session
            all = mix(all, path.filename().string());
            all = mix(all, text);
        }
    }
    return all;
}

fs::path ResultStore::path_of(const ResultKey& key) const {
    const std::string text = text_of(key);
    return folder_in(folder_) / fmt::format("{:016x}", mix(mix(made_with_, text), text.size()));
}

Expected<void> ResultStore::keep(const ResultKey& key, const KeptResult& result) const {
    std::error_code problem;
    fs::create_directories(folder_in(folder_), problem);
    if (problem) {
        return failure(fmt::format("can't be made: {}", problem.message()), {.file = folder_in(folder_).string()});
    }
    ArchiveWriter writer{std::string(result_magic)};
    writer(made_with_);
    writer(text_of(key));
    writer(result.name);
    writer(result.seed);
    return write_whole(path_of(key), writer.bytes + to_bytes(result.result));
}

std::optional<KeptResult> ResultStore::find(const ResultKey& key) const {
    const fs::path path = path_of(key);
    const auto bytes = read_whole(path, path.string());
    if (!bytes || !bytes->starts_with(result_magic)) return std::nullopt;
    ArchiveReader reader{std::string_view(*bytes).substr(result_magic.size())};
    std::uint64_t made_with = 0;
    std::string whose;
    KeptResult kept;
    if (!reader(made_with) || !reader(whose) || !reader(kept.name) || !reader(kept.seed)) return std::nullopt;
    if (made_with != made_with_ || whose != text_of(key)) return std::nullopt;
    auto result = from_bytes(reader.bytes);
    if (!result) return std::nullopt;
    kept.result = std::move(*result);
    if (!kept.result.folder.empty()) kept.result.folder = folder_ / fs::path(kept.result.folder).filename();
    return kept;
}

void ResultStore::forget(const ResultKey& key) const {
    std::error_code none;
    fs::remove(path_of(key), none);
}

void ResultStore::remove_if_empty(bool with_parent) const {
    std::error_code none;
    if (fs::remove(folder_in(folder_), none) && with_parent) fs::remove(folder_, none);
}

}  // namespace nezumi
