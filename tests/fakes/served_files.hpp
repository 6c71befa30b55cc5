// Files that somebody reads and writes, and a program answers: what is served as a folder.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <functional>
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
    /// Nobody has this handle any more.
    virtual void close(const std::string& /*name*/, std::uint64_t /*handle*/) {}
    /// What a reading from its beginning gives.
    virtual int read(const std::string& name, std::uint64_t handle, std::string& text) = 0;
    /// How many bytes it took.
    virtual int write(const std::string& name, std::uint64_t handle, std::string_view text) = 0;

    /// Whether it says one thing after the other, and has no places: `read_on` is called instead of `read`.
    virtual bool is_stream(const std::string& /*name*/) const { return false; }
    /// Takes at most `most` bytes of what it has said since the last call; -EAGAIN when it has said nothing: whoever
    /// reads it waits by `poll`.
    virtual int read_on(const std::string& /*name*/, std::uint64_t /*handle*/, std::size_t /*most*/,
                        std::string& /*text*/) {
        return -EINVAL;
    }
    /// What poll(2) says of a stream. `again` is to be called once when that has changed.
    virtual unsigned poll(const std::string& /*name*/, std::uint64_t /*handle*/, std::function<void()> /*again*/) {
        return 0;
    }
    /// An ioctl(2), with the data that its number says: all of that goes back, also where a real device would give
    /// less. Who asks for more than it has room for, as `evtest --query` does, is overwritten (FUSE's files can't say
    /// how much they give).
    virtual int control(const std::string& /*name*/, std::uint64_t /*handle*/, unsigned /*request*/, void* /*data*/) {
        return -ENOTTY;
    }

    /// How many bytes of it can be mapped into memory; 0: none.
    virtual std::size_t mapped_size(const std::string& /*name*/) const { return 0; }
    /// These bytes of what is mapped.
    virtual void read_mapped(const std::string& /*name*/, std::size_t /*from*/, std::size_t /*size*/, char* /*bytes*/) {
    }
    /// `changed` is to be called when what is mapped is no longer what has been read of it.
    virtual void tell_changes(std::function<void(const std::string& name)> /*changed*/) {}
};

}  // namespace nezumi::fakes
