// The addresses of this user's running pages: files beside the console sockets, in a folder that only the user can
// enter.
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
    std::string url{};       ///< with the token for full access
    std::string view_url{};  ///< with the token for viewing only
    bool operator==(const RunningPage&) const = default;
};

/// Announces a page while the object exists: the file NAME-PID.html in the console's folder redirects a browser to the
/// page. A browser opened with this file name has no token in its command line, which other users could read.
class PageEntry {
public:
    /// The folder must exist, as made by `Listener::open`.
    static Expected<PageEntry> open(const RunningPage& page, const std::filesystem::path& folder = console_folder());
    ~PageEntry();
    PageEntry(PageEntry&& other) noexcept : file_(std::exchange(other.file_, {})) {}
    PageEntry& operator=(PageEntry&&) = delete;

    const std::filesystem::path& file() const { return file_; }

private:
    explicit PageEntry(std::filesystem::path file) : file_(std::move(file)) {}

    std::filesystem::path file_;
};

/// The pages whose process runs, sorted by name and process. Files of ended processes are removed.
std::vector<RunningPage> running_pages(const std::filesystem::path& folder = console_folder());

}  // namespace nezumi::web
