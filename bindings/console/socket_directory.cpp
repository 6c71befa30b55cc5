// Opens sockets through the descriptor of their folder. So no other folder can replace the checked one, and the path of
// the folder may be long.
#include "bindings/console/socket_directory.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/number_in.hpp"

namespace nezumi {
namespace {

constexpr std::string_view suffix = ".sock";

std::string why() { return std::strerror(errno); }

// Opens the folder. Refuses a folder of another user, or one that others can enter.
Expected<Descriptor> open_folder(const std::filesystem::path& path) {
    Descriptor folder(::open(path.c_str(), O_DIRECTORY | O_NOFOLLOW | O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (!folder || fstat(folder.get(), &status) != 0)
        return failure("can't open the console's folder " + path.string() + ": " + why());
    if (status.st_uid != geteuid())
        return failure("the console's folder " + path.string() + " belongs to another user: remove it");
    if ((status.st_mode & 077) != 0)
        return failure("other users can enter the console's folder " + path.string() + ": run chmod 700 on it");
    return folder;
}

// The name of a system as a file name, without characters that file names can't have.
std::string plain_name(std::string_view name) {
    constexpr std::size_t longest = NAME_MAX - std::string_view("-4194304.sock").size();
    std::string plain(name);
    for (char& letter : plain) {
        if (letter == '/' || static_cast<unsigned char>(letter) < ' ' || letter == '\x7f') letter = '_';
    }
    if (plain.starts_with('.')) plain.front() = '_';
    if (plain.empty()) plain = "system";
    if (plain.size() <= longest) return plain;
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(plain[end]) & 0xc0) == 0x80) --end;  // not within a character
    return plain.substr(0, end);
}

// The name of a system from the text that a person typed: this name, or the name of the file.
std::string name_meant(std::string_view which) {
    const std::filesystem::path path(which);
    return path.extension() == ".lua" ? path.stem().string() : std::string(which);
}

sockaddr_un address_in(const Descriptor& folder, std::string_view name) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::snprintf(address.sun_path, sizeof address.sun_path, "/proc/self/fd/%d/%.*s", folder.get(),
                  static_cast<int>(name.size()), name.data());
    return address;
}

// A stopped system accepts no connection: clients that wait for it give up after this time, with EAGAIN.
constexpr timeval longest_wait{.tv_sec = 2, .tv_usec = 0};

Descriptor connect_in(const Descriptor& folder, std::string_view name, bool wait) {
    Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | (wait ? 0 : SOCK_NONBLOCK), 0));
    if (!socket) return socket;
    const auto let_sends_wait = [&](const timeval& time) {
        return setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &time, sizeof time) == 0;
    };
    // The path of the socket may be too long for a socket address. Opening the socket gives a short path to it.
    const Descriptor file(openat(folder.get(), std::string(name).c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
    if (!file) return Descriptor();
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::snprintf(address.sun_path, sizeof address.sun_path, "/proc/self/fd/%d", file.get());
    if ((wait && !let_sends_wait(longest_wait)) ||
        connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        (wait && !let_sends_wait({}))) {
        const int error = errno;
        socket.close();
        errno = error;
    }
    return socket;
}

// NAME-PID.sock; nothing for any other file.
std::optional<ListeningSystem> parse_name(std::string_view file) {
    if (!file.ends_with(suffix)) return std::nullopt;
    file.remove_suffix(suffix.size());
    const std::size_t dash = file.rfind('-');
    if (dash == std::string_view::npos || dash == 0 || file.front() == '.') return std::nullopt;
    ListeningSystem system{.name = std::string(file.substr(0, dash)), .path = {}};
    system.process = number_in<int>(file.substr(dash + 1)).value_or(0);
    if (system.process <= 0) return std::nullopt;
    return system;
}

}  // namespace

std::filesystem::path console_folder() {
    const char* runtime = std::getenv("XDG_RUNTIME_DIR");
    struct stat status {};
    if (runtime != nullptr && runtime[0] == '/' && stat(runtime, &status) == 0 && S_ISDIR(status.st_mode) &&
        status.st_uid == geteuid())
        return std::filesystem::path(runtime) / "nezumi";
    return "/tmp/nezumi-" + std::to_string(geteuid());
}

Expected<Listener> Listener::open(std::string_view name, const std::filesystem::path& path) {
    if (mkdir(path.c_str(), 0700) != 0 && errno != EEXIST)
        return failure("can't make the console's folder " + path.string() + ": " + why());
    auto folder = open_folder(path);
    if (!folder) return Unexpected(folder.error());

    const std::string process = std::to_string(getpid());
    const std::string file = plain_name(name) + "-" + process + std::string(suffix);
    // The socket gets its final name only when it listens: other processes remove sockets of this name that don't
    // listen.
    const std::string unready = "." + process;

    Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const sockaddr_un address = address_in(*folder, unready);
    unlinkat(folder->get(), unready.c_str(), 0);
    if (!socket || bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        fchmodat(folder->get(), unready.c_str(), 0600, 0) != 0 || listen(socket.get(), 16) != 0 ||
        renameat(folder->get(), unready.c_str(), folder->get(), file.c_str()) != 0)
        return failure("can't listen in the console's folder " + path.string() + ": " + why());
    return Listener(std::move(*folder), std::move(socket), path / file);
}

Listener::~Listener() {
    if (folder_) unlinkat(folder_.get(), path_.filename().c_str(), 0);
}

Expected<std::vector<ListeningSystem>> running_systems(const std::filesystem::path& path) {
    std::vector<ListeningSystem> systems;
    if (struct stat status{}; lstat(path.c_str(), &status) != 0 && errno == ENOENT) return systems;
    const auto folder = open_folder(path);
    if (!folder) return Unexpected(folder.error());
    // fdopendir takes ownership of its descriptor, so it gets a duplicate.
    const std::unique_ptr<DIR, int (*)(DIR*)> list(fdopendir(dup(folder->get())), closedir);
    if (list == nullptr) return failure("can't read the console's folder " + path.string() + ": " + why());
    while (const dirent* entry = readdir(list.get())) {
        auto system = parse_name(entry->d_name);
        if (!system) continue;
        const Descriptor socket = connect_in(*folder, entry->d_name, false);
        if (!socket && errno == ECONNREFUSED) unlinkat(folder->get(), entry->d_name, 0);
        if (!socket && errno != EAGAIN) continue;
        system->path = path / entry->d_name;
        systems.push_back(std::move(*system));
    }
    std::sort(systems.begin(), systems.end(), [](const ListeningSystem& a, const ListeningSystem& b) {
        return std::pair(a.name, a.process) < std::pair(b.name, b.process);
    });
    return systems;
}

Expected<ReachedSystem> connect_to_system(std::string_view which, const std::filesystem::path& path) {
    const auto systems = running_systems(path);
    if (!systems) return Unexpected(systems.error());
    if (systems->empty()) return failure("nothing is running: start a system with `nezumi run FILE`");

    std::vector<ListeningSystem> fitting;
    const std::string name = plain_name(name_meant(which));
    for (const ListeningSystem& system : *systems) {
        if (which.empty() || system.name == name || std::to_string(system.process) == which) fitting.push_back(system);
    }
    if (fitting.empty()) {
        return failure("no system '" + shown(which) + "' is running" +
                       did_you_mean(which, *systems, &ListeningSystem::name) + "; running: " + list_of(*systems));
    }
    if (fitting.size() > 1)
        return failure("several systems are running, choose one by its name or process number: " + list_of(fitting));

    const auto folder = open_folder(path);
    if (!folder) return Unexpected(folder.error());
    Descriptor socket = connect_in(*folder, fitting.front().path.filename().string(), true);
    if (!socket && errno == EAGAIN) return failure(no_answer(fitting.front()));
    if (!socket) return failure("can't reach " + list_of(fitting) + ": " + why());
    if (!is_peer(socket.get(), geteuid())) return failure(list_of(fitting) + " belongs to another user");
    return ReachedSystem{std::move(fitting.front()), std::move(socket)};
}

std::string list_of(const std::vector<ListeningSystem>& systems) {
    std::string text;
    for (const ListeningSystem& system : systems) {
        if (!text.empty()) text += ", ";
        text += system.name + " (process " + std::to_string(system.process) + ")";
    }
    return text;
}

std::string no_answer(const ListeningSystem& system) {
    return list_of({system}) + " does not answer: it is stopped, or very busy";
}

bool is_peer(int socket, uid_t user) {
    ucred peer{};
    socklen_t size = sizeof peer;
    return getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == user;
}

}  // namespace nezumi
