// A folder, and what is below it, reached without following links: nothing outside of it is read, written or removed.
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

/// Takes a piece of a file's content; returns an errno to stop, 0 to go on.
using TakesBytes = std::function<int(std::string_view bytes)>;

class OpenFolder {
public:
    /// An error, with the path as its place, when there is no such folder, or it can't be read.
    static Expected<OpenFolder> open(const std::filesystem::path& path);

    /// The folder of this name in this one, which is no link to one.
    Expected<OpenFolder> below(const std::string& name) const;

    int descriptor() const { return folder_.get(); }

    /// What has this name, with the hash of its content; nothing where nothing has it.
    std::optional<ListedFile> find(const std::string& name) const;
    /// The names in the folder of this name ("": in this one), sorted.
    Expected<std::vector<std::string>> names_in(const std::string& name) const;
    /// Hands over the content of a file, or the target of a link. Returns an errno, 0 when it is done.
    int read(const std::string& name, const TakesBytes& takes) const;
    /// Why a file of this name can't be made, replaced or removed, as an errno; 0: it can. Folders that lack are no
    /// reason.
    int refuses(const std::string& name) const;

    // These return an errno, 0 when it is done.

    int make_folder(const std::string& name) const;
    int remove(const std::string& name) const;
    int remove_empty_folder(const std::string& name) const;
    /// Moves a file of another folder to this name, in one step; a file that has it goes.
    int move_here(int folder, const std::string& file, const std::string& name) const;

private:
    explicit OpenFolder(Descriptor folder) : folder_(std::move(folder)) {}

    // A name's folder and its last part. The folder is not open, and errno says why, where it can't be reached.
    struct Place {
        Descriptor folder;
        std::string last;
    };
    Place place_of(const std::string& name) const;
    int with_place(const std::string& name, const std::function<int(int folder, const char* last)>& act) const;

    Descriptor folder_;
};

}  // namespace nezumi::push
