// Where the files that a person names are found: beside the file that names them, in the project, among the installed
// ones.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/project/project_files.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// What kind of file a name stands for: where it is looked for, and which ending may be left out.
enum class FileKind {
    script,  ///< a behaviour: `NAME.lua` in `behaviors/`
    model,   ///< a robot: `NAME.lua` in `behaviors/` or, of the installed ones, `engine/robots/`
    module,  ///< what `require "a.b"` names: `a/b.lua` in `behaviors/` or `behaviors/lib/`
    system,  ///< a system: `NAME.lua` in `behaviors/systems/` or `behaviors/`
    data,    ///< a map, a table, a picture: the name as it is, in `behaviors/` or, of the installed ones,
             ///< `engine/robots/`
};

class Project {
public:
    /// The project of a file: the nearest folder above it that has `behaviors/`, or none. `installed` are folders laid
    /// out as the sources are, with `behaviors/` and `engine/robots/`. Paths may be relative to the working directory.
    /// `files` must outlive all copies of the project.
    static Project of(const std::filesystem::path& file, std::vector<std::filesystem::path> installed = {},
                      const ProjectFiles& files = disk());

    /// The same, with its files found and read through others, which must outlive all copies of it.
    Project through(const ProjectFiles& files) const {
        Project project = *this;
        project.files_ = &files;
        return project;
    }
    const ProjectFiles& files() const { return *files_; }

    /// The folder that has `behaviors/`; empty when there is none.
    const std::filesystem::path& root() const { return root_; }
    const std::vector<std::filesystem::path>& installed() const { return installed_; }

    /// Where the file called `name` is: beside the file `named_in`, then in `behaviors/`, then among the installed
    /// ones; never that file itself. The error says the nearest name and every place that was looked at; it has no
    /// place of its own. A file that `passes_over` says is meant by nobody is none.
    Expected<std::filesystem::path> find(
        FileKind kind, std::string_view name, const std::filesystem::path& named_in,
        const std::function<bool(const std::filesystem::path&)>& passes_over = {}) const;

    /// The names of all such files that `find` would find, sorted.
    std::vector<std::string> names(FileKind kind, const std::filesystem::path& named_in) const;

    /// The whole of a file; its place in errors is the path as `shown` shows it.
    Expected<std::string> read(const std::filesystem::path& path) const;
    /// The text of a script, which messages call by `shown`.
    Expected<SourceText> read_source(const std::string& path) const;

    /// A path as a person would type it: relative to the working directory when it is below it.
    std::string shown(const std::filesystem::path& path) const;

private:
    // Where such a file is looked for, in this order; `naming` is the whole path of the file that names it.
    std::vector<std::filesystem::path> folders(FileKind kind, const std::filesystem::path& naming) const;

    const ProjectFiles* files_ = &disk();
    std::filesystem::path working_;
    std::filesystem::path root_;
    std::vector<std::filesystem::path> installed_;
};

}  // namespace nezumi
