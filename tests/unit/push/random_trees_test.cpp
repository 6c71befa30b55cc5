// Projects and robots' folders made at random: whatever a person does on either side, a push destroys nothing.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "bindings/push/interrupted.hpp"
#include "tests/unit/environment.hpp"
#include "tests/unit/push/traced_robot.hpp"

using namespace nezumi;
using namespace nezumi::push;

namespace {

namespace fs = std::filesystem;
using Tree = std::map<std::string, std::string>;

class Person {
public:
    explicit Person(unsigned seed) : random_(seed) {}

    std::size_t below(std::size_t bound) { return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random_); }

    // Writes, links, empties or removes something somewhere in a folder. Whatever is written says who did, and is new.
    void change(const fs::path& folder, const std::string& who) {
        const std::string name = any_name();
        const fs::path path = folder / name;
        std::error_code none;
        for (auto slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
            if (fs::is_symlink(folder / name.substr(0, slash))) return;  // it would be written elsewhere
        }
        const std::string text = who + " " + std::to_string(++count_);
        switch (below(7)) {
            case 0: fs::remove_all(path, none); return;
            case 1: fs::remove_all(path, none); [[fallthrough]];
            case 2: fs::create_directories(path, none); return;
            case 3:
                fs::remove_all(path, none);
                fs::create_directories(path.parent_path(), none);
                fs::create_symlink(below(2) == 0 ? "../outside" : text, path, none);
                return;
            default:
                fs::create_directories(path.parent_path(), none);
                if (!fs::is_symlink(path)) std::ofstream(path, std::ios::binary) << text;
        }
    }

private:
    std::string any_name() {
        static const std::vector<std::string> names{"a", "b", "-rf", ":x", "a b", "new\nline", "it's \"q\"", "$(x)"};
        std::string name = names[below(names.size())];
        while (below(2) == 0) name += "/" + names[below(3)];
        return name;
    }
    std::mt19937 random_;
    int count_ = 0;
};

bool is_kept(const std::vector<FileChange>& changes, const std::string& name) {
    return std::any_of(changes.begin(), changes.end(), [&](const FileChange& change) {
        return !is_change(change.what) && (change.name == name || name.starts_with(change.name + "/"));
    });
}

// What the robot's folder must be, given what was there, what pushes had brought, and the project.
void check_pushed(const Tree& before, const Tree& brought, const Tree& project, const Tree& after,
                  const std::vector<FileChange>& changes) {
    for (const auto& [name, content] : before) {
        CAPTURE(name, content);
        const auto earlier = brought.find(name);
        const bool is_as_brought = earlier != brought.end() && earlier->second == content;
        const bool is_same = project.contains(name) && project.at(name) == content;
        if (content == "/" || is_as_brought || is_same) continue;
        // The robot's own, or edited there.
        CHECK((after.contains(name) && after.at(name) == content));
        if (project.contains(name)) CHECK(is_kept(changes, name));
    }
    for (const auto& [name, content] : project) {
        CAPTURE(name, content);
        if (!is_kept(changes, name)) CHECK((after.contains(name) && after.at(name) == content));
    }
    for (const auto& [name, content] : after) {
        CAPTURE(name, content);
        const bool is_of_project = project.contains(name) && project.at(name) == content;
        if (!is_of_project && content != "/") {
            REQUIRE(before.contains(name));
            CHECK(before.at(name) == content);
            CHECK((!brought.contains(name) || brought.at(name) != content || is_kept(changes, name)));
        }
    }
}

void push_at_random(unsigned seed) {
    CAPTURE(seed);
    Person person(seed);
    const TracedRobot robot;
    robot.scratch.write("home/outside/file", "outside");
    const Tree outside = tree_of(robot.home() / "outside");
    Tree brought;  // what is as a push has brought it
    for (int round = 0; round < 6; ++round) {
        CAPTURE(round);
        for (std::size_t i = person.below(8) + 1; i > 0; --i) person.change(robot.project(), "project");
        if (round > 0) {
            for (std::size_t i = person.below(4); i > 0; --i) person.change(robot.there(), "robot");
        }
        const Tree project = tree_of(robot.project());
        const Tree before = tree_of(robot.there());
        const auto shown = robot.push("robots", true).sent;
        REQUIRE(shown);
        CHECK(tree_of(robot.there()) == before);

        // On a twin, the push is cut somewhere.
        const TracedRobot twin;
        fs::remove_all(twin.scratch.path());
        fs::copy(robot.scratch.path(), twin.scratch.path(),
                 fs::copy_options::recursive | fs::copy_options::copy_symlinks);
        const auto sent = robot.push().sent;
        REQUIRE(sent);
        CHECK(sent->changes == shown->changes);
        const Tree after = tree_of(robot.there());
        check_pushed(before, brought, project, after, sent->changes);
        CHECK(tree_of(robot.home() / "outside") == outside);

        const auto cut = twin.push_cut({.at = person.below(30) + 1});
        REQUIRE(finish_interrupted_push(twin.there()));
        const Tree found = tree_of(twin.there());
        CHECK((found == before || found == after));
        REQUIRE(twin.push().sent);
        CHECK(tree_of(twin.there()) == after);
        CHECK(tree_of(twin.home() / "outside") == outside);

        for (const auto& [name, content] : project) {
            if (after.contains(name) && after.at(name) == content) brought[name] = content;
        }
        std::erase_if(brought, [&](const auto& file) { return !project.contains(file.first); });
    }
}

}  // namespace

TEST_CASE("a push to any folder keeps the robot's files, brings the rest, and may be interrupted", "[push][random]") {
    const int pushes = number_from_environment("NEZUMI_PUSHES", 12);
    for (int seed = 1; seed <= pushes; ++seed) push_at_random(static_cast<unsigned>(seed));
}
