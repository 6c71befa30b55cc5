// The folder with the sockets of running systems. Only their user can enter it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// $XDG_RUNTIME_DIR/nezumi, or /tmp/nezumi-UID if there is no such folder.
std::filesystem::path console_folder();

/// A running system's socket: NAME-PID.sock in the console folder. Removed at the end.
class Listener {
public:
    /// Listens with `name`, the system's file name without its ending. Creates the folder if necessary. A folder that
    /// belongs to another user, that others can enter, or that is a link, is refused.
    static Expected<Listener> open(std::string_view name, const std::filesystem::path& folder = console_folder());
    ~Listener();
    Listener(Listener&&) noexcept = default;
    Listener& operator=(Listener&&) = delete;

    int file() const { return socket_.get(); }
    const std::filesystem::path& path() const { return path_; }

private:
    Listener(Descriptor folder, Descriptor socket, std::filesystem::path path)
        : folder_(std::move(folder)), socket_(std::move(socket)), path_(std::move(path)) {}

    Descriptor folder_;
    Descriptor socket_;
    std::filesystem::path path_;
};

/// A system that listens.
struct ListeningSystem {
    std::string name;
    pid_t process = 0;
    std::filesystem::path path;
};

/// The systems that listen, sorted by name and process. Removes sockets without a listener. Does not wait for any
/// system.
Expected<std::vector<ListeningSystem>> running_systems(const std::filesystem::path& folder = console_folder());

/// A connection to a running system.
struct ReachedSystem {
    ListeningSystem system;
    Descriptor socket;
};

/// Connects to the system that `which` names (its name, file or process number; "": the only one), within 2 s. The
/// error lists the running systems.
Expected<ReachedSystem> connect_to_system(std::string_view which,
                                          const std::filesystem::path& folder = console_folder());

/// "stop_at_wall (process 4711), swarm (process 4712)".
std::string list_of(const std::vector<ListeningSystem>& systems);

/// The message about a system that does not answer.
std::string no_answer(const ListeningSystem& system);

/// Whether the process at the other end of a Unix socket belongs to `user`.
bool is_peer(int socket, uid_t user);

}  // namespace nezumi
