// Functions of Linux that a web page does not have. Each fails with ENOSYS, and the callers handle this error.
#include <spawn.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <sys/types.h>

#include <cerrno>

namespace {

int refuse() {
    errno = ENOSYS;
    return -1;
}

}  // namespace

extern "C" {

int eventfd(unsigned /*initial*/, int /*flags*/) { return refuse(); }
int eventfd_read(int /*file*/, eventfd_t* /*value*/) { return refuse(); }
int eventfd_write(int /*file*/, eventfd_t /*value*/) { return refuse(); }
ssize_t getrandom(void* /*bytes*/, size_t /*size*/, unsigned /*flags*/) { return refuse(); }
int inotify_init1(int /*flags*/) { return refuse(); }
int inotify_add_watch(int /*file*/, const char* /*path*/, uint32_t /*mask*/) { return refuse(); }
int inotify_rm_watch(int /*file*/, int /*watch*/) { return refuse(); }
int memfd_create(const char* /*name*/, unsigned /*flags*/) { return refuse(); }
int renameat2(int, const char* /*from*/, int, const char* /*to*/, unsigned /*flags*/) { return refuse(); }

}  // extern "C"
