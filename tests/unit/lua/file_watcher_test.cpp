// Every way in which editors and tools save a file is noticed, and a file without a change is not.
#include "engine/live/file_watcher.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <future>
#include <memory>
#include <thread>

#include "engine/project/script_source.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;
using Text = std::string;
using Clock = std::chrono::steady_clock;

struct WatchedFolder {
    WatchedFolder() {
        fs::remove_all(path);
        fs::create_directories(path / "project" / "behaviors");
    }
    ~WatchedFolder() { fs::remove_all(path); }

    fs::path path = fs::temp_directory_path() / ("nezumi_watch_" + std::to_string(::getpid()));
    fs::path file = path / "project" / "behaviors" / "it.lua";
};

void write(const fs::path& path, const Text& text) { std::ofstream(path) << text; }

constexpr double longest_wait = 60;  // [s], of a thread that gets a hundredth of a processor

// Whether this becomes so within these seconds.
bool soon(const std::function<bool()>& is_so, double seconds = longest_wait) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (!is_so()) {
        if (Clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

constexpr double never = 1e6;  // [s]

// Nothing but notices tell of changes, unless the watcher is to look for itself.
struct Watched : WatchedFolder {
    explicit Watched(double look_every = never) : watcher(look_every) {
        write(file, "one");
        write(other, "other");
        watcher.watch(
            {{file.string(), ScriptFile({"", "", "one"}).hash}, {other.string(), ScriptFile({"", "", "other"}).hash}});
        settle();
    }
    // Until nothing that has happened can still be under way.
    void settle() const { std::this_thread::sleep_for(std::chrono::milliseconds(60)); }
    bool notices(double seconds = longest_wait) {
        return soon(
            [this] {
                changed.clear();
                for (const FileWatcher::Change& change : watcher.take_changes()) changed.push_back(change.path);
                return !changed.empty();
            },
            seconds);
    }
    // Whether the watched file, and only it, is told.
    bool notices_it() { return notices() && changed == std::vector<Text>{file.string()}; }

    fs::path other = path / "project" / "behaviors" / "other.lua";
    FileWatcher watcher;
    std::vector<Text> changed;
};

}  // namespace

TEST_CASE("a file that is overwritten is detected", "[lua][watcher]") {
    Watched it;
    write(it.file, "two");
    CHECK(it.notices_it());
    write(it.file, "three");
    CHECK(it.notices_it());
}

TEST_CASE("a file that is replaced by renaming is detected each time", "[lua][watcher]") {
    Watched it;
    for (const Text text : {"two", "three", "four"}) {
        write(it.path / "project" / "behaviors" / ".it.lua.tmp", text);
        fs::rename(it.path / "project" / "behaviors" / ".it.lua.tmp", it.file);
        CHECK(it.notices_it());
    }
}

TEST_CASE("a file that is moved from another folder is detected", "[lua][watcher]") {
    Watched it;
    write(it.path / "new.lua", "two");
    fs::rename(it.path / "new.lua", it.file);
    CHECK(it.notices_it());
}

TEST_CASE("a file that vim saves with a renamed backup is detected", "[lua][watcher]") {
    Watched it;
    for (const Text text : {"two", "three"}) {
        write(it.path / "project" / "behaviors" / "4913", "");
        fs::remove(it.path / "project" / "behaviors" / "4913");
        fs::rename(it.file, it.file.string() + "~");
        write(it.file, text);
        fs::remove(it.file.string() + "~");
        CHECK(it.notices_it());
    }
}

TEST_CASE("files that vim saves with a copied backup, and that emacs saves, are detected", "[lua][watcher]") {
    Watched it;
    fs::copy_file(it.file, it.file.string() + "~");
    write(it.file, "two");
    CHECK(it.notices_it());
    write(it.path / "project" / "behaviors" / "#it.lua#", "three");  // emacs's auto-save is nothing
    fs::rename(it.file, it.file.string() + "~");
    write(it.file, "three");
    fs::remove(it.path / "project" / "behaviors" / "#it.lua#");
    CHECK(it.notices_it());
}

TEST_CASE("a touch, and saving the same text, are not changes", "[lua][watcher]") {
    Watched it;
    fs::last_write_time(it.file, fs::file_time_type::clock::now());
    write(it.file, "one");
    CHECK_FALSE(it.notices(0.1));
}

TEST_CASE("many saves in a short time are detected a few times, including the last one", "[lua][watcher]") {
    Watched it;
    for (int i = 0; i < 50; ++i) write(it.file, "text " + std::to_string(i));
    int times = 0;
    while (it.notices(0.1)) ++times;
    CHECK(times >= 1);
    CHECK(times <= 25);
    write(it.file, "text 49");  // known
    CHECK_FALSE(it.notices(0.1));
}

TEST_CASE("an empty file, an incomplete file and then the complete file are detected", "[lua][watcher]") {
    Watched it;
    write(it.file, "");
    CHECK(it.notices_it());
    std::ofstream slow(it.file);
    slow << "first half" << std::flush;
    CHECK_FALSE(it.notices(0.1));  // it is not closed yet
    slow << " and the rest";
    slow.close();
    CHECK(it.notices_it());
}

TEST_CASE("a deleted file is not a change until it exists again", "[lua][watcher]") {
    Watched it;
    fs::remove(it.file);
    CHECK_FALSE(it.notices(0.1));
    write(it.file, "one");
    CHECK_FALSE(it.notices(0.1));
    fs::remove(it.file);
    write(it.file, "two");
    CHECK(it.notices_it());
}

TEST_CASE("a folder that is removed and created again is detected", "[lua][watcher]") {
    Watched it;
    for (const Text text : {"two", "three"}) {
        fs::remove_all(it.path / "project");
        fs::create_directories(it.path / "project" / "behaviors");
        write(it.file, text);
        write(it.other, "other");
        CHECK(it.notices_it());
        it.settle();
        write(it.file, text + " again");  // and is watched from then on
        CHECK(it.notices_it());
    }
}

TEST_CASE("a folder that is replaced by another one is detected", "[lua][watcher]") {
    Watched it;
    fs::create_directories(it.path / "next" / "behaviors");
    write(it.path / "next" / "behaviors" / "it.lua", "two");
    write(it.path / "next" / "behaviors" / "other.lua", "other");
    fs::rename(it.path / "project", it.path / "before");
    fs::rename(it.path / "next", it.path / "project");
    CHECK(it.notices_it());
    it.settle();
    write(it.path / "before" / "behaviors" / "it.lua", "of no interest");
    CHECK_FALSE(it.notices(0.1));
    write(it.file, "three");
    CHECK(it.notices_it());
}

TEST_CASE("a changed link is detected, and its target is watched", "[lua][watcher]") {
    Watched it;
    fs::create_directories(it.path / "elsewhere");
    write(it.path / "elsewhere" / "real.lua", "two");
    fs::remove(it.file);
    fs::create_symlink(it.path / "elsewhere" / "real.lua", it.file);
    CHECK(it.notices_it());
    it.settle();
    write(it.path / "elsewhere" / "real.lua", "three");
    CHECK(it.notices_it());
    write(it.path / "linked.lua", "four");
    fs::remove(it.file);
    fs::create_hard_link(it.path / "linked.lua", it.file);
    CHECK(it.notices_it());
}

TEST_CASE("files can be added to a watcher, and known contents stay known", "[lua][watcher]") {
    Watched it;
    write(it.path / "more.lua", "more");
    write(it.file, "two");
    CHECK(it.notices_it());
    it.watcher.watch({{it.file.string(), 1}, {(it.path / "more.lua").string(), 2}});
    CHECK(it.notices());  // what is given as known of the new one is wrong
    CHECK(it.changed == std::vector<Text>{(it.path / "more.lua").string()});
    write(it.other, "not watched any more");
    CHECK_FALSE(it.notices(0.1));
}

TEST_CASE("changes without events are found by regular checks", "[lua][watcher]") {
    Watched it(0.02);
    std::ofstream slow(it.file);
    slow << "not closed yet" << std::flush;
    CHECK(it.notices_it());
}

TEST_CASE("another Lua file in a watched folder is reported separately", "[lua][watcher]") {
    Watched it;
    CHECK_FALSE(it.watcher.take_others());
    write(it.path / "project" / "behaviors" / "module.lua", "new");
    CHECK(soon([&] { return it.watcher.take_others(); }));
    it.settle();
    CHECK_FALSE(it.watcher.has_news());
    CHECK_FALSE(it.watcher.take_others());
}

TEST_CASE("a file that can't be read is reported once, and again only after it could be read", "[lua][watcher]") {
    WatchedFolder it;
    write(it.file, "version 1");
    FileWatcher watcher(0.2);
    watcher.watch({{it.file.string(), ScriptFile({"", "", "version 1"}).hash}});
    int version = 1;
    const auto loses_it = [&](const Text& why) {
        std::vector<FileWatcher::Loss> losses;
        CHECK(soon([&] { return !(losses = watcher.take_losses()).empty(); }));
        REQUIRE(losses.size() == 1);
        CHECK(losses[0].path == it.file.string());
        CHECK(losses[0].why == why);
        std::this_thread::sleep_for(std::chrono::milliseconds(700));
        CHECK(watcher.take_losses().empty());
        fs::remove_all(it.file);
        write(it.file, "version " + std::to_string(++version));
        CHECK(soon([&] { return !watcher.take_changes().empty(); }));
    };
    fs::remove(it.file);
    REQUIRE(::mkfifo(it.file.c_str(), 0600) == 0);
    loses_it("is a FIFO, expected a file");
    fs::remove(it.file);
    loses_it("there is no such file");
    fs::remove(it.file);
    fs::create_directory(it.file);
    loses_it("is a folder, expected a file");
    fs::resize_file(it.file, 17 << 20);
    loses_it("is larger than 16 MB");
}

TEST_CASE("a file system that does not answer does not delay the end", "[lua][watcher][wallclock]") {
    struct Waiting {
        std::promise<void> asked, answer, left;
    };
    const auto waiting = std::make_shared<Waiting>();
    auto begin = Clock::now();
    {
        FileWatcher watcher(FileWatcher::usual_poll_period, [waiting](const Text&) -> Expected<SourceText> {
            waiting->asked.set_value();
            waiting->answer.get_future().wait();
            waiting->left.set_value();
            return failure("at last");
        });
        watcher.watch({{"/it.lua", 1}});
        waiting->asked.get_future().wait();
        begin = Clock::now();
    }
    CHECK(Clock::now() - begin < std::chrono::seconds(1));
    waiting->answer.set_value();
    waiting->left.get_future().wait();  // and what its thread still does harms nobody
}
