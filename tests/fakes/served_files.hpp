// Files that somebody reads and writes, and a program answers: what is served as a folder.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi::fakes {

/// Results below 0 are -errno. Calls come from several threads, and may take as long as a device does.
class ServedFiles {
public:
    virtual ~ServedFiles() = default;
    /// Of all files; one in a folder has its path: "class/leds/red/brightness".
    virtual std::vector<std::string> names() const = 0;
    /// Folders that are there even while nothing is in them, each after the one that it is in.
    virtual std::vector<std::string> folders() const { return {}; }
    /// 0 when there is such a file now.
    virtual int look(const std::string& name) = 0;
    /// The handle that the other calls get; by its own count.
    virtual int open(const std::string& name, std::uint64_t& handle) = 0;
    /// What a reading from its beginning gives.
    virtual int read(const std::string& name, std::uint64_t handle, std::string& text) = 0;
    /// How many bytes it took.
    virtual int write(const std::string& name, std::uint64_t handle, std::string_view text) = 0;
};

}  // namespace nezumi::fakes
