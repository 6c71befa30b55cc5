// A push during which the power fails: only what was synced is on the disk for certain.
#include <sys/stat.h>
#include <sys/syscall.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include "bindings/push/interrupted.hpp"
#include "tests/unit/push/second_push.hpp"

using namespace nezumi;
using namespace nezumi::push;

namespace {

namespace fs = std::filesystem;

ino_t inode_of(const fs::path& path) {
    struct stat status {};
    return lstat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

bool is_plain_file(const fs::path& path) { return fs::is_regular_file(fs::symlink_status(path)); }

void copy_tree(const fs::path& from, const fs::path& to) {
    fs::remove_all(to);
    fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
}

// A home folder, and what is left of it when the power fails: of what was not synced, nothing, or names without
// content.
class FailingDisk {
public:
    FailingDisk(const fs::path& home, fs::path durable) : home_(fs::canonical(home)), durable_(std::move(durable)) {
        sync_all();
    }

    void see(const DiskCall& call, bool is_over) {
        const fs::path path = call.path;
        if (call.number == SYS_write) unwritten_from(path);
        if (!is_over) return;
        if (call.number == SYS_syncfs) sync_all();
        if (call.number == SYS_fsync) fs::is_directory(path) ? sync_folder(path) : sync_file(path);
        if (call.number == SYS_unlinkat || call.number == SYS_renameat) forget_removed();
    }

    void lose_all_since_sync(const fs::path& to) const { copy_tree(durable_, to); }
    void lose_contents(const fs::path& to) const {
        copy_tree(home_, to);
        for (const auto& entry : fs::recursive_directory_iterator(home_)) {
            if (is_plain_file(entry.path()) && !synced_.contains(inode_of(entry.path())))
                std::ofstream(to / fs::relative(entry.path(), home_), std::ios::trunc);
        }
    }

private:
    fs::path durable_of(const fs::path& path) const { return durable_ / fs::relative(path, home_); }
    void unwritten_from(const fs::path& path) { synced_.erase(inode_of(path)); }
    void sync_all() {
        copy_tree(home_, durable_);
        synced_.clear();
        for (const auto& entry : fs::recursive_directory_iterator(home_)) synced_.insert(inode_of(entry.path()));
    }
    void sync_file(const fs::path& path) {
        synced_.insert(inode_of(path));
        fs::copy_file(path, durable_of(path), fs::copy_options::overwrite_existing);
    }
    // Its names; contents only of files that were synced themselves.
    void sync_folder(const fs::path& folder) {
        for (const auto& entry : fs::directory_iterator(durable_of(folder))) {
            if (!fs::exists(fs::symlink_status(folder / entry.path().filename()))) fs::remove_all(entry.path());
        }
        for (const auto& entry : fs::directory_iterator(folder)) {
            const fs::path copy = durable_of(entry.path());
            if (fs::is_directory(entry.symlink_status())) {
                fs::create_directory(copy);
            } else {
                fs::remove(copy);
                fs::copy(entry.path(), copy, fs::copy_options::copy_symlinks);
                if (is_plain_file(copy) && !synced_.contains(inode_of(entry.path()))) fs::resize_file(copy, 0);
            }
        }
    }
    void forget_removed() {
        std::set<ino_t> there;
        for (const auto& entry : fs::recursive_directory_iterator(home_)) there.insert(inode_of(entry.path()));
        std::erase_if(synced_, [&](ino_t inode) { return !there.contains(inode); });
    }

    fs::path home_, durable_;
    std::set<ino_t> synced_;
};

}  // namespace

TEST_CASE("a power cut at any step of a push leaves either the old project or the new one", "[push][cut]") {
    for (std::size_t at = 1;; ++at) {
        CAPTURE(at);
        const SecondPush push;
        FailingDisk disk(push.robot.home(), push.robot.scratch.path("durable"));
        const auto cut = push.robot.push_cut(
            {.at = at, .watch = [&](const DiskCall& call, bool is_over) { disk.see(call, is_over); }});
        const fs::path left[] = {push.robot.scratch.path("without names"), push.robot.scratch.path("without contents")};
        disk.lose_all_since_sync(left[0]);
        disk.lose_contents(left[1]);
        for (const fs::path& after : left) {
            CAPTURE(after);
            copy_tree(after, push.robot.home());
            REQUIRE(finish_interrupted_push(push.robot.there()));
            const auto found = tree_of(push.robot.there());
            if (cut.calls < at) {
                CHECK(found == push.new_tree);
            } else {
                CHECK((found == push.old_tree || found == push.new_tree));
            }
            REQUIRE(push.robot.push().sent);
            CHECK(tree_of(push.robot.there()) == push.new_tree);
        }
        if (cut.calls < at) break;
    }
}
