// The history of inputs, in a file that all consoles of a user share.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// $XDG_STATE_HOME/nezumi/history, or ~/.local/state/nezumi/history; empty when there is no home.
std::filesystem::path history_path();

/// One input a line, its own ends of line written as \n. Consoles that run at once append to it, each input whole.
class HistoryFile {
public:
    /// More inputs than twice this are cut down to this when the file is read.
    static constexpr std::size_t kept = 5000;

    /// An empty path keeps nothing.
    explicit HistoryFile(std::filesystem::path path) : path_(std::move(path)) {}

    /// All inputs, oldest first; none when there is no file yet.
    std::vector<std::string> read() const;
    /// Appends one at the end. The folder and the file are made if need be, for their user alone.
    Expected<void> append(std::string_view input) const;

private:
    std::filesystem::path path_;
};

}  // namespace nezumi
