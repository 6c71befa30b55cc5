// A folder and its contents, accessed without following links: nothing outside the folder is read, written or removed.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/push/file_list.hpp"
#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {

/// Takes a piece of a file's content. Returns 0 to continue, or an errno to stop.
using TakesBytes = std::function<int(std::string_view bytes)>;

class OpenFolder {
public:
    /// Fails, with the path as its location, if the folder does not exist or can't be read.
    static Expected<OpenFolder> open(const std::filesystem::path& path);

    /// Opens the subfolder of this name; a link to a folder is refused.
    Expected<OpenFolder> below(const std::string& name) const;

    int descriptor() const { return folder_.get(); }

    /// Returns the object with this name and the hash of its content; nothing if there is none.
    std::optional<ListedFile> find(const std::string& name) const;
    /// The sorted names in the subfolder `name` ("": in this folder).
    Expected<std::vector<std::string>> names_in(const std::string& name) const;
    /// Passes the content of a file, or the target of a link, to `takes`. Returns 0 or an errno.
    int read(const std::string& name, const TakesBytes& takes) const;
    /// Returns the errno with which making, replacing or removing a file of this name would fail, or 0. Missing folders
    /// are not an error.
    int refuses(const std::string& name) const;

    // These return 0 or an errno.

    int make_folder(const std::string& name) const;
    int remove(const std::string& name) const;
    int remove_empty_folder(const std::string& name) const;
    /// Moves a file of another folder to this name in one step, replacing an existing file.
    int move_here(int folder, const std::string& file, const std::string& name) const;

private:
    explicit OpenFolder(Descriptor folder) : folder_(std::move(folder)) {}

    // The folder and the last part of a path. If the folder can't be opened, `folder` is empty, and errno has the
    // reason.
    struct Place {
        Descriptor folder;
        std::string last;
    };
    Place place_of(const std::string& name) const;
    int with_place(const std::string& name, const std::function<int(int folder, const char* last)>& act) const;

    Descriptor folder_;
};

}  // namespace nezumi::push
