// Where running systems and those who attach to them meet: sockets in a folder that only their user can enter.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/descriptor.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// $XDG_RUNTIME_DIR/nezumi, or /tmp/nezumi-UID where there is no such folder.
std::filesystem::path console_folder();

/// A running system's socket: NAME-PID.sock in the console folder. Removed at the end.
class Listener {
public:
    /// Listens as `name`, the system's file without its ending. The folder is made if need be; one that
    /// others own or can enter is refused, as is one that is a link.
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

/// The systems that listen, sorted by name and process. Sockets that nobody listens at any more are removed. Waits for
/// none of them.
Expected<std::vector<ListeningSystem>> running_systems(const std::filesystem::path& folder = console_folder());

/// A running system that is connected to.
struct ReachedSystem {
    ListeningSystem system;
    Descriptor socket;
};

/// Connects to the one that `which` names (a name, its file, or a process number; "": the only one), within 2 s. The
/// error says what runs.
Expected<ReachedSystem> connect_to_system(std::string_view which,
                                          const std::filesystem::path& folder = console_folder());

/// "stop_at_wall (process 4711), swarm (process 4712)".
std::string list_of(const std::vector<ListeningSystem>& systems);

/// What is said of a system that does not.
std::string no_answer(const ListeningSystem& system);

/// Whether the process at the other end of a Unix socket belongs to `user`.
bool is_peer(int socket, uid_t user);

}  // namespace nezumi
