// Writes the files of `nezumi test --coverage`. A file that has changed since the run is shown without its lines.
#include "bindings/cli/test/coverage_files.hpp"

#include <filesystem>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/files/lua_kind.hpp"
#include "engine/base/find_files.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/project/project.hpp"

namespace nezumi::cli {

void add_unloaded_files(CoverageReport& report) {
    namespace fs = std::filesystem;
    const fs::path root = Project::of(fs::current_path() / "any", installed_folders()).root();
    if (root.empty()) return;
    for (const fs::path& path : find_files(root / "behaviors", ".lua").files) {
        const auto text = read_whole(path, path.string());
        if (!text) continue;
        const LuaKind kind = kind_of_file(path, *text);
        if (kind == LuaKind::behavior || kind == LuaKind::module)
            report.add_unloaded(path.lexically_relative(root).string(), *text);
    }
}

Expected<void> write_coverage(const CoverageReport& report, const std::string& folder) {
    namespace fs = std::filesystem;
    const fs::path root = Project::of(fs::current_path() / "any", installed_folders()).root();
    const auto read = [&root](const std::string& file, std::uint64_t hash) -> std::optional<std::string> {
        auto text = read_whole(root / file, file);
        if (!text || ScriptFile({"", "", *text}).hash != hash) return std::nullopt;
        return std::move(*text);
    };
    if (auto ok = write_whole(fs::path(folder) / "coverage.txt", report.text(read)); !ok) return ok;
    return write_whole(fs::path(folder) / "lcov.info", report.lcov());
}

}  // namespace nezumi::cli
