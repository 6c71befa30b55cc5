// A file's name is a hash of whose result it has, which it says itself as well.
#include "bindings/scenario/result_store.hpp"

#include <fmt/format.h>

#include <set>
#include <system_error>

#include "bindings/lua/project/find_files.hpp"
#include "bindings/lua/project/project.hpp"
#include "bindings/scenario/archive.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "nezumi result 1\n";

std::string text_of(const ResultKey& key) {
    return fmt::format("{}\n{}\n{}\n{}", key.file, key.run, key.repetition, key.simplest ? "simplest" : "run");
}

// The files that a run of this scenario file may read, as far as they are of the project: of its behaviors all, with
// maps and pictures, elsewhere those in Lua, as recordings and results may lie there.
std::set<fs::path> files_beside(const fs::path& scenario, const std::vector<fs::path>& installed) {
    const Project project = Project::of(scenario, installed);
    const fs::path& root = project.root();
    const fs::path own = fs::absolute(scenario).parent_path();
    std::set<fs::path> files;
    const auto add = [&](const fs::path& folder, std::string_view ending) {
        const FoundFiles found = find_files(folder, ending);
        files.insert(found.files.begin(), found.files.end());
    };
    std::error_code none;
    if (!root.empty() && fs::is_directory(root / "behaviors", none)) add(root / "behaviors", "");
    if (!root.empty() && !fs::equivalent(root, own, none)) {
        add(own, ".lua");
    } else {
        // Nobody knows what lies below a folder of no project.
        for (const auto& entry : fs::directory_iterator(own, none)) {
            if (entry.path().extension() == ".lua") files.insert(entry.path());
        }
    }
    return files;
}

}  // namespace

std::uint64_t fingerprint(const TestPlan& plan, std::uint64_t seed, const std::string& version,
                          const std::vector<fs::path>& installed) {
    std::uint64_t all = mix(mix(0, version), seed);
    std::set<fs::path> folders;
    for (const PlannedFile& file : plan.files) {
        // Those of a folder have the same files beside them.
        if (!folders.insert(fs::absolute(file.path).parent_path()).second) continue;
        for (const fs::path& path : files_beside(file.path, installed)) {
            all = mix(all, path.filename().string());
            all = mix(all, read_whole(path, path.string()).value_or(""));
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
    ArchiveWriter writer{std::string(magic)};
    writer(made_with_);
    writer(text_of(key));
    writer(result.name);
    return write_whole(path_of(key), writer.bytes + to_bytes(result.result));
}

std::optional<KeptResult> ResultStore::find(const ResultKey& key) const {
    const fs::path path = path_of(key);
    const auto bytes = read_whole(path, path.string());
    if (!bytes || !bytes->starts_with(magic)) return std::nullopt;
    ArchiveReader reader{std::string_view(*bytes).substr(magic.size())};
    std::uint64_t made_with = 0;
    std::string whose;
    KeptResult kept;
    if (!reader(made_with) || !reader(whose) || !reader(kept.name)) return std::nullopt;
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
