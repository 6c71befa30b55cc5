// libfuse's callbacks, which find their files in FUSE's private data.
#include "tests/fakes/fuse_folder.hpp"

#include <fuse.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace nezumi::fakes {
namespace {

struct Served {
    ServedFiles* files;
    void (*ready)();
};

const Served& served() { return *static_cast<Served*>(fuse_get_context()->private_data); }
ServedFiles& files() { return *served().files; }
std::string name_of(const char* path) { return path + 1; }

void* start(fuse_conn_info* /*connection*/, fuse_config* config) {
    // Each call comes here: nothing is remembered by the kernel.
    config->direct_io = 1;
    config->attr_timeout = config->entry_timeout = config->negative_timeout = 0;
    served().ready();
    return fuse_get_context()->private_data;
}

int get_attributes(const char* path, struct stat* status, fuse_file_info* /*info*/) {
    *status = {};
    if (std::strcmp(path, "/") == 0) {
        status->st_mode = S_IFDIR | 0755;
        status->st_nlink = 2;
        return 0;
    }
    status->st_mode = S_IFREG | 0666;
    status->st_nlink = 1;
    return files().look(name_of(path));
}

int list(const char* /*path*/, void* buffer, fuse_fill_dir_t fill, off_t /*offset*/, fuse_file_info* /*info*/,
         fuse_readdir_flags /*flags*/) {
    for (const std::string& name : files().names()) {
        if (files().look(name) == 0) fill(buffer, name.c_str(), nullptr, 0, fuse_fill_dir_flags{});
    }
    return 0;
}

int open_file(const char* path, fuse_file_info* info) {
    std::uint64_t handle = 0;
    const int result = files().open(name_of(path), handle);
    info->fh = handle;
    return result;
}

int read_file(const char* path, char* buffer, std::size_t size, off_t offset, fuse_file_info* info) {
    if (offset > 0) return 0;
    std::string text;
    if (const int error = files().read(name_of(path), info->fh, text); error != 0) return error;
    const std::size_t length = std::min(size, text.size());
    std::memcpy(buffer, text.data(), length);
    return static_cast<int>(length);
}

int write_file(const char* path, const char* text, std::size_t size, off_t /*offset*/, fuse_file_info* info) {
    return files().write(name_of(path), info->fh, {text, size});
}

int truncate_file(const char* /*path*/, off_t /*size*/, fuse_file_info* /*info*/) { return 0; }

}  // namespace

int serve_folder(const std::string& mount_point, ServedFiles& files, void (*ready)()) {
    Served served{&files, ready};
    fuse_operations operations{};
    operations.getattr = get_attributes;
    operations.init = start;
    operations.open = open_file;
    operations.read = read_file;
    operations.readdir = list;
    operations.truncate = truncate_file;
    operations.write = write_file;
    std::string program = "fake", foreground = "-f", mount = mount_point;
    std::string option = "-o", threads = "max_threads=32";  // one that hangs is one less
    char* arguments[] = {program.data(), foreground.data(), option.data(), threads.data(), mount.data(), nullptr};
    return fuse_main(5, arguments, &operations, &served) == 0 ? 0 : 1;
}

}  // namespace nezumi::fakes
