// Files that are read and written whole or not at all.
#include "engine/base/whole_file.hpp"

#include <fcntl.h>

#include <catch2/catch.hpp>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "engine/base/staged_file.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

std::ptrdiff_t files_in(const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder), {});
}

// While this lives, no file gets larger than this.
struct SizeLimit {
    explicit SizeLimit(rlim_t bytes) {
        getrlimit(RLIMIT_FSIZE, &before);
        const rlimit less{bytes, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &less);
        handler = std::signal(SIGXFSZ, SIG_IGN);
    }
    ~SizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, handler);
    }
    rlimit before{};
    void (*handler)(int) = nullptr;
};

}  // namespace

TEST_CASE("if a file can't be written completely, this is an error and the old file stays", "[engine][base]") {
    const Scratch scratch;
    const auto file = scratch.write("it.txt", "before");
    {
        const SizeLimit limit(1000);
        const auto full = write_whole(file, std::string(2000, 'x'));
        REQUIRE_FALSE(full);
        CHECK(describe(full.error()) == file.string() + ": can't be written: File too large");
        CHECK_FALSE(write_whole(scratch.path("fresh.txt"), std::string(2000, 'x')));
    }
    CHECK(text_of_file(file) == "before");
    CHECK(files_in(scratch.path("")) == 1);
    CHECK(write_whole(file, "after"));
    CHECK(text_of_file(file) == "after");
    CHECK(write_whole(scratch.path("fresh.txt"), ""));
    CHECK(files_in(scratch.path("")) == 2);
    CHECK(describe(write_whole(scratch.path("no/it.txt"), "text").error()) ==
          scratch.path("no/it.txt").string() + ": can't be written: No such file or directory");
}

TEST_CASE("a link, a file mode and a device are kept when a file is written", "[engine][base]") {
    const Scratch scratch;
    const auto file = scratch.write("it.txt", "before");
    std::filesystem::create_symlink("it.txt", scratch.path("link.txt"));
    chmod(file.c_str(), 0640);
    REQUIRE(write_whole(scratch.path("link.txt"), "after"));
    CHECK(std::filesystem::is_symlink(scratch.path("link.txt")));
    CHECK(text_of_file(file) == "after");
    struct stat status {};
    REQUIRE(stat(file.c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0640);
    CHECK(write_whole("/dev/null", "text"));
    CHECK(describe(write_whole("/dev/full", "text").error()) == "/dev/full: can't be written: No space left on device");
    CHECK(std::filesystem::exists("/dev/full"));
}

TEST_CASE("the old file is kept under another name", "[engine][base]") {
    const Scratch scratch;
    const auto file = scratch.path("it.txt");
    const std::string kept = file.string() + "~";
    REQUIRE(write_whole(file, "first", kept));
    CHECK_FALSE(std::filesystem::exists(kept));
    REQUIRE(write_whole(file, "second", kept));
    REQUIRE(write_whole(file, "third", kept));
    CHECK(text_of_file(file) == "third");
    CHECK(text_of_file(kept) == "second");
    CHECK(files_in(scratch.path("")) == 2);
    const std::string nowhere = scratch.path("no/it.txt").string();
    CHECK(describe(write_whole(file, "fourth", nowhere).error()) ==
          file.string() + ": can't be kept as " + nowhere + ": No such file or directory");
    CHECK(text_of_file(file) == "third");
    CHECK(files_in(scratch.path("")) == 2);
}

TEST_CASE("writing does not wait for the reader of a pipe, and keeps other files in the folder", "[engine][base]") {
    const Scratch scratch;
    const auto pipe = scratch.path("pipe");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(describe(write_whole(pipe, "text").error()) ==
          pipe.string() + ": is a pipe without a reader: start its reader first, or give a file");
    const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(reader >= 0);
    CHECK(write_whole(pipe, "text"));
    char text[4];
    CHECK(read(reader, text, sizeof text) == 4);
    close(reader);
    for (const char* beside : {"it.txt.new", "it.txt~.new"}) REQUIRE(mkfifo(scratch.path(beside).c_str(), 0600) == 0);
    const auto file = scratch.path("it.txt");
    REQUIRE(write_whole(file, "text", file.string() + "~"));
    REQUIRE(write_whole(file, "text", file.string() + "~"));
    CHECK(text_of_file(file) == "text");
}

TEST_CASE("a program that is killed while it writes a file leaves nothing of it", "[engine][base]") {
    const Scratch scratch;
    const auto file = scratch.write("it.txt", "before");
    const pid_t child = fork();
    if (child == 0) {
        StagedFile staged(file.string());
        write_all(staged.descriptor(), "half of what");
        kill(getpid(), SIGKILL);
    }
    waitpid(child, nullptr, 0);
    CHECK(text_of_file(file) == "before");
    CHECK(files_in(scratch.path("")) == 1);
}

TEST_CASE("a file is read whole, or one plain message says why not", "[engine][base]") {
    const Scratch scratch;
    const auto error = [&](const char* name) { return describe(read_whole(scratch.path(name), name).error()); };
    CHECK(error("nothing") == "nothing: there is no such file");
    CHECK(error("") == "is a folder, expected a file");
    scratch.write("big", std::string(largest_text + 1, ' '));
    CHECK(error("big") == "big: is larger than 16 MB");
    CHECK(read_whole(scratch.path("big"), "big", largest_text + 1).has_value());
    scratch.write("text", std::string("a\0b\r\n", 5));
    CHECK(*read_whole(scratch.path("text"), "text") == std::string("a\0b\r\n", 5));
    if (geteuid() == 0) return;  // who may read everything
    REQUIRE(chmod(scratch.path("text").c_str(), 0) == 0);
    CHECK(error("text") == "text: can't be read: Permission denied");
}

TEST_CASE("a FIFO, a device, a socket or a folder is refused at once, and the error names its kind", "[engine][base]") {
    const Scratch scratch;
    const auto error = [&](const std::filesystem::path& path) { return read_whole(path, "it").error().message; };
    REQUIRE(mkfifo(scratch.path("pipe").c_str(), 0600) == 0);
    CHECK(error(scratch.path("pipe")) == "is a FIFO, expected a file");
    std::filesystem::create_symlink("pipe", scratch.path("link"));
    CHECK(error(scratch.path("link")) == "is a FIFO, expected a file");
    CHECK(error("/dev/zero") == "is a device, expected a file");
    const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    scratch.path("socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
    REQUIRE(bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    CHECK(error(scratch.path("socket")) == "is a socket, expected a file");
    close(listener);
    CHECK(other_than_file(scratch.path("")) == "a folder");
    CHECK(other_than_file(scratch.path("none")).empty());
    CHECK(other_than_file(scratch.write("file", "")).empty());
}
