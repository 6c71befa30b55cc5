// A disk that can hang: what is in its mount point lies in the folder MOUNT_POINT.disk, and writes wait while it hangs.
#include <dirent.h>
#include <fcntl.h>
#include <fuse.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <string>

#include "tests/fakes/command_socket.hpp"

namespace {

struct Disk {
    std::string folder;
    std::mutex mutex;
    std::condition_variable changed;
    bool hangs = false;

    std::string at(const char* path) const { return folder + path; }
    void set_hanging(bool hanging) {
        const std::lock_guard lock(mutex);
        hangs = hanging;
        changed.notify_all();
    }
    void wait() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return !hangs; });
    }
};

Disk& disk() { return *static_cast<Disk*>(fuse_get_context()->private_data); }
int result_of(int returned) { return returned < 0 ? -errno : returned; }
int file_of(const fuse_file_info* info) { return static_cast<int>(info->fh); }

void* start(fuse_conn_info* /*connection*/, fuse_config* /*config*/) {
    std::puts("ready");
    std::fflush(stdout);
    return &disk();
}

int get_attributes(const char* path, struct stat* status, fuse_file_info* /*info*/) {
    return result_of(lstat(disk().at(path).c_str(), status));
}

int open_at(const char* path, int flags, mode_t mode, fuse_file_info* info) {
    const int file = open(disk().at(path).c_str(), flags, mode);
    if (file < 0) return -errno;
    info->fh = static_cast<std::uint64_t>(file);
    info->direct_io = 1;
    return 0;
}

fuse_operations operations() {
    fuse_operations all{};
    all.init = start;
    all.getattr = get_attributes;
    all.create = [](const char* path, mode_t mode, fuse_file_info* info) {
        return open_at(path, info->flags | O_CREAT, mode, info);
    };
    all.open = [](const char* path, fuse_file_info* info) { return open_at(path, info->flags, 0, info); };
    all.read = [](const char* /*path*/, char* buffer, std::size_t size, off_t offset, fuse_file_info* info) {
        return result_of(static_cast<int>(pread(file_of(info), buffer, size, offset)));
    };
    all.write = [](const char* /*path*/, const char* text, std::size_t size, off_t offset, fuse_file_info* info) {
        disk().wait();
        return result_of(static_cast<int>(pwrite(file_of(info), text, size, offset)));
    };
    all.fsync = [](const char* /*path*/, int /*data_only*/, fuse_file_info* info) {
        disk().wait();
        return result_of(fsync(file_of(info)));
    };
    all.release = [](const char* /*path*/, fuse_file_info* info) { return result_of(close(file_of(info))); };
    all.truncate = [](const char* path, off_t size, fuse_file_info* /*info*/) {
        return result_of(truncate(disk().at(path).c_str(), size));
    };
    all.unlink = [](const char* path) { return result_of(unlink(disk().at(path).c_str())); };
    all.rename = [](const char* from, const char* to, unsigned flags) {
        return flags != 0 ? -EINVAL : result_of(rename(disk().at(from).c_str(), disk().at(to).c_str()));
    };
    return all;
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) {
        std::fprintf(stderr, "usage: %s MOUNT_POINT SOCKET\n", words[0]);
        return 2;
    }
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // no mount outlives the test
    std::signal(SIGPIPE, SIG_IGN);
    static Disk disk;
    disk.folder = words[1] + std::string(".disk");
    mkdir(disk.folder.c_str(), 0777);
    const auto answer = [](const std::string& line) -> std::string {
        if (line != "hang" && line != "heal") return "unknown command";
        disk.set_hanging(line == "hang");
        return "";
    };
    if (!nezumi::fakes::serve_commands(words[2], answer)) return 2;
    const fuse_operations all = operations();
    std::string program = "fake_disk", foreground = "-f", mount = words[1];
    char* arguments[] = {program.data(), foreground.data(), mount.data(), nullptr};
    const int status = fuse_main(3, arguments, &all, &disk) == 0 ? 0 : 1;
    _exit(status);  // its threads go on until then
}
