// Finds the files that a person names: beside the file that names them, in the project, and among the installed files.
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

/// The kind of a file, which determines the folders for the search and the ending that may be omitted.
enum class FileKind {
    script,   ///< a behaviour: `NAME.lua` in `behaviors/`
    model,    ///< a robot: `NAME.lua` in `behaviors/`, or for installed ones in `engine/robots/`
    module,   ///< what `require "a.b"` names: `a/b.lua` in `behaviors/` or `behaviors/lib/`
    system,   ///< a system: `NAME.lua` in `behaviors/systems/` or `behaviors/`
    data,     ///< a map, a table, a picture: the complete name, in `behaviors/`, or for installed ones in
              ///< `engine/robots/`
    message,  ///< what defines message types: in `behaviors/messages/`, with any of their endings
};

class Project {
public:
    /// The project of a file: the nearest folder above it that has `behaviors/`, or none. `installed` are folders with
    /// the same structure as the sources, with `behaviors/` and `engine/robots/`. Paths may be relative to the working
    /// directory. `files` must outlive all copies of the project.
    static Project of(const std::filesystem::path& file, std::vector<std::filesystem::path> installed = {},
                      const ProjectFiles& files = disk());

    /// The same project, but it accesses files by `files`, which must outlive all copies of the returned project.
    Project through(const ProjectFiles& files) const {
        Project project = *this;
        project.files_ = &files;
        return project;
    }
    const ProjectFiles& files() const { return *files_; }

    /// The folder that has `behaviors/`; empty if there is none.
    const std::filesystem::path& root() const { return root_; }
    const std::vector<std::filesystem::path>& installed() const { return installed_; }

    /// The path of the file `name`: beside the file `named_in`, then in `behaviors/`, then among the installed files.
    /// Never returns `named_in` itself. The error has the nearest name and all places that were searched, and no
    /// location. Files for which `passes_over` returns true are ignored.
    Expected<std::filesystem::path> find(
        FileKind kind, std::string_view name, const std::filesystem::path& named_in,
        const std::function<bool(const std::filesystem::path&)>& passes_over = {}) const;

    /// The names of all files that `find` could find, sorted.
    std::vector<std::string> names(FileKind kind, const std::filesystem::path& named_in) const;

    /// The folders in which files of this kind are searched, in order: the folder of `named_in`, which is the file that
    /// mentions the name; the folders of the project; the installed folders.
    std::vector<std::filesystem::path> places(FileKind kind, const std::filesystem::path& named_in) const {
        return folders(kind, (working_ / named_in).lexically_normal());
    }

    /// The whole text of a file. The location of errors is the path as returned by `shown`.
    Expected<std::string> read(const std::filesystem::path& path) const;
    /// The text of a script, with the name `shown` in messages.
    Expected<SourceText> read_source(const std::string& path) const;

    /// A path as a person would type it: relative to the working directory if it is below that directory.
    std::string shown(const std::filesystem::path& path) const;

private:
    // The folders for files of this kind, in the order of the search; `naming` is the full path of the file that
    // mentions the name.
    std::vector<std::filesystem::path> folders(FileKind kind, const std::filesystem::path& naming) const;

    const ProjectFiles* files_ = &disk();
    std::filesystem::path working_;
    std::filesystem::path root_;
    std::vector<std::filesystem::path> installed_;
};

}  // namespace nezumi
