// Where the pages of this user's running systems are: files beside the consoles' sockets, in a folder that only their
// user can enter.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bindings/console/socket_directory.hpp"
#include "engine/base/error.hpp"

namespace nezumi::web {

/// The page of a running system.
struct RunningPage {
    std::string name;
    pid_t process = 0;
    std::string url{};       ///< with the token that lets somebody act
    std::string view_url{};  ///< for those who may only look
    bool operator==(const RunningPage&) const = default;
};

/// Tells of a page while it lives: NAME-PID.html in the console's folder, which leads a browser to it. A command line
/// that says this file's name gives no token away to other users.
class PageEntry {
public:
    /// The folder is there, as `Listener::open` has made it.
    static Expected<PageEntry> open(const RunningPage& page, const std::filesystem::path& folder = console_folder());
    ~PageEntry();
    PageEntry(PageEntry&& other) noexcept : file_(std::exchange(other.file_, {})) {}
    PageEntry& operator=(PageEntry&&) = delete;

    const std::filesystem::path& file() const { return file_; }

private:
    explicit PageEntry(std::filesystem::path file) : file_(std::move(file)) {}

    std::filesystem::path file_;
};

/// Those whose process runs, sorted by name and process. Files of others are removed.
std::vector<RunningPage> running_pages(const std::filesystem::path& folder = console_folder());

}  // namespace nezumi::web
