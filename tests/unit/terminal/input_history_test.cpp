// The history of inputs lasts, is shared by consoles, and never loses a line.
#include "bindings/terminal/input_history.hpp"

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("inputs of several lines come back as they were typed", "[console][history]") {
    const Scratch folder;
    const HistoryFile history(folder.path("a/b/nezumi/history"));
    CHECK(history.read().empty());
    const std::vector<std::string> inputs{"ls()", "for i = 1, 3 do\n  print(\"\\n\")\nend", "x = \"\\\\\"", "\xC3\xBC"};
    for (const std::string& input : inputs) REQUIRE(history.append(input));
    CHECK(HistoryFile(folder.path("a/b/nezumi/history")).read() == inputs);
}

TEST_CASE("only the user can read the history", "[console][history]") {
    const Scratch folder;
    REQUIRE(HistoryFile(folder.path("nezumi/history")).append("secret"));
    struct stat status {};
    REQUIRE(stat(folder.path("nezumi/history").c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0600);
    REQUIRE(stat(folder.path("nezumi").c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0700);
}

TEST_CASE("a truncated line does not damage the next one", "[console][history]") {
    const Scratch folder;
    std::ofstream(folder.path("history")) << "whole\ncut o";
    const HistoryFile history(folder.path("history"));
    REQUIRE(history.append("next"));
    CHECK(history.read() == std::vector<std::string>{"whole", "cut o", "next"});
}

TEST_CASE("consoles that write at the same time lose no line, even while the file is shortened", "[console][history]") {
    const Scratch folder;
    {
        std::ofstream long_file(folder.path("history"));
        for (std::size_t line = 0; line <= 2 * HistoryFile::kept; ++line) long_file << "old " << line << "\n";
    }
    constexpr int writers = 4;
    constexpr int each = 100;
    std::vector<std::thread> threads;
    threads.reserve(writers + 1);
    for (int writer = 0; writer < writers; ++writer) {
        threads.emplace_back([&folder, writer] {
            const HistoryFile history(folder.path("history"));
            for (int line = 0; line < each; ++line)
                (void)history.append(std::to_string(writer) + "\n" + std::to_string(line));
        });
    }
    threads.emplace_back([&folder] { (void)HistoryFile(folder.path("history")).read(); });
    for (std::thread& thread : threads) thread.join();

    const auto inputs = HistoryFile(folder.path("history")).read();
    CHECK(inputs.size() <= HistoryFile::kept + writers * each);
    std::vector<int> next(writers, 0);
    for (const std::string& input : inputs) {
        if (input.starts_with("old")) continue;
        const std::size_t end = input.find('\n');
        REQUIRE(end != std::string::npos);
        CHECK(std::stoi(input.substr(end + 1)) == next[std::stoul(input)]++);
    }
    CHECK(next == std::vector<int>(writers, each));
}

TEST_CASE("a long history is shortened to its latest lines when it is read", "[console][history]") {
    const Scratch folder;
    const auto write = [&](std::size_t count) {
        std::ofstream file(folder.path("history"));
        for (std::size_t line = 1; line <= count; ++line) file << "line " << line << "\n";
    };
    const auto lines = [&] { return lines_of(text_of_file(folder.path("history"))); };
    const HistoryFile history(folder.path("history"));
    write(2 * HistoryFile::kept);
    CHECK(history.read().size() == 2 * HistoryFile::kept);
    CHECK(lines().size() == 2 * HistoryFile::kept);

    write(2 * HistoryFile::kept + 1);
    CHECK(history.read().size() == 2 * HistoryFile::kept + 1);
    REQUIRE(lines().size() == HistoryFile::kept);
    CHECK(lines().front() == "line " + std::to_string(HistoryFile::kept + 2));
    CHECK(lines().back() == "line " + std::to_string(2 * HistoryFile::kept + 1));
    CHECK(history.read().front() == lines().front());
}

TEST_CASE("a history that can't be written is an error", "[console][history]") {
    const Scratch folder;
    std::ofstream(folder.path("file")) << "";
    const auto kept = HistoryFile(folder.path("file/nezumi/history")).append("x");
    REQUIRE_FALSE(kept);
    CHECK(kept.error().message ==
          "can't keep the history in " + folder.path("file/nezumi/history").string() + ": Not a directory");
    CHECK(HistoryFile({}).append("nowhere"));
}
