// A file that is written by a thread of its own, while ticks go on.
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

TEST_CASE("writing does not wait for the disk, and everything is written at the end", "[engine][base]") {
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

TEST_CASE("the amount of waiting data is limited; beyond it writing fails without waiting", "[engine][base]") {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    {
        FileWriter writer(ends[1], 1'000'000);
        const std::string piece(100'000, 'x');
        for (int i = 0; i < 5; ++i) writer.put(piece);
        CHECK_FALSE(writer.is_behind());
        for (int i = 0; i < 5; ++i) writer.put(piece);
        CHECK(writer.is_behind());
        CHECK(writer.problem() == 0);
        for (int i = 0; i < 5; ++i) writer.put(piece);
        CHECK(writer.problem() == ENOBUFS);
        CHECK(why_not_written(writer.problem()) == "it accepts data too slowly, and too much is waiting");
        CHECK(writer.close() == ENOBUFS);
    }
    close(ends[0]);
}

TEST_CASE("a pipe without a reader is given up", "[engine][base]") {
    const bool by_others = GENERATE(false, true);
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    FileWriter writer(ends[1]);
    writer.put(std::string(1'000'000, 'x'));
    const auto before = std::chrono::steady_clock::now();
    std::thread other;
    if (by_others) other = std::thread([&] { writer.give_up(); });
    CHECK(writer.close(by_others ? FileWriter::forever : std::chrono::milliseconds(50)) == ECANCELED);
    CHECK(std::chrono::steady_clock::now() - before < std::chrono::seconds(5));
    CHECK(why_not_written(ECANCELED) == "it did not accept all data in time");
    CHECK(why_not_written(ENOSPC) == "No space left on device");
    if (other.joinable()) other.join();
    close(ends[0]);
}

TEST_CASE("a full disk ends the writing without waiting", "[engine][base]") {
    FileWriter writer(open("/dev/full", O_WRONLY));
    for (int i = 0; i < 100; ++i) writer.put(std::string(100, 'x'));
    CHECK(writer.close() == ENOSPC);
    CHECK(writer.problem() == ENOSPC);
}

TEST_CASE("texts that take long to make are made by the writing thread, in order", "[engine][base]") {
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
