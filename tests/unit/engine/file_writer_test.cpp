// A file that is written beside the ticks.
#include "engine/base/file_writer.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <string>
#include <thread>

#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("whoever writes waits for no disk, and all of it is there at the end", "[engine][base]") {
    // A pipe that nobody reads yet is a disk that stalls.
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    FileWriter writer(ends[1]);
    const std::string piece(100'000, 'x');
    const auto before = std::chrono::steady_clock::now();
    for (int i = 0; i < 20; ++i) writer.put(piece);  // a pipe takes 64 KB
    CHECK(std::chrono::steady_clock::now() - before < std::chrono::seconds(5));
    std::size_t read_bytes = 0;
    std::thread reader([&] {
        char buffer[65536];
        for (ssize_t got = 1; got > 0;) {
            got = read(ends[0], buffer, sizeof buffer);
            if (got > 0) read_bytes += static_cast<std::size_t>(got);
        }
    });
    CHECK(writer.close() == 0);
    reader.join();
    CHECK(read_bytes == 2'000'000);
    close(ends[0]);
}

TEST_CASE("what waits to be written has a limit, and nothing of it gets lost", "[engine][base]") {
    const Scratch scratch;
    const auto path = scratch.path("it");
    {
        FileWriter writer(open(path.c_str(), O_WRONLY | O_CREAT, 0666), 10);
        for (int i = 0; i < 1000; ++i) writer.put(std::to_string(i) + "\n");
    }
    std::string expected;
    for (int i = 0; i < 1000; ++i) expected += std::to_string(i) + "\n";
    CHECK(text_of_file(path) == expected);
}

TEST_CASE("a disk that is full ends the writing and keeps nobody waiting", "[engine][base]") {
    FileWriter writer(open("/dev/full", O_WRONLY), 10);
    for (int i = 0; i < 100; ++i) writer.put(std::string(100, 'x'));
    CHECK(writer.close() == ENOSPC);
    CHECK(writer.problem() == ENOSPC);
}

TEST_CASE("what takes long to be made is made by the thread that writes, in its place", "[engine][base]") {
    const Scratch scratch;
    const auto file = scratch.path("it");
    std::thread::id maker;
    {
        FileWriter writer(open(file.c_str(), O_WRONLY | O_CREAT, 0600));
        writer.put("first ");
        writer.put(7, [&] {
            maker = std::this_thread::get_id();
            return std::string("second ");
        });
        writer.put("third");
        CHECK(writer.close() == 0);
    }
    CHECK(text_of_file(file) == "first second third");
    CHECK(maker != std::this_thread::get_id());
}
