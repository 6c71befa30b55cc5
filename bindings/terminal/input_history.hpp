// The history of inputs in a file that all consoles of a user share.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// $XDG_STATE_HOME/nezumi/history, or ~/.local/state/nezumi/history; empty without a home folder.
std::filesystem::path history_path();

/// One input per line, with its line ends written as \n. Several consoles may append at the same time, each input as a
/// whole.
class HistoryFile {
public:
    /// A file with more than twice this number of inputs is shortened to this number when it is read.
    static constexpr std::size_t kept = 5000;

    /// With an empty path nothing is stored.
    explicit HistoryFile(std::filesystem::path path) : path_(std::move(path)) {}

    /// All inputs, oldest first; none when there is no file yet.
    std::vector<std::string> read() const;
    /// Appends an input. Makes the folder and the file if missing, readable only by the user.
    Expected<void> append(std::string_view input) const;

private:
    std::filesystem::path path_;
};

}  // namespace nezumi
