// The page's editor and scenarios, as a browser asks for them.
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

using Json = WebRig::Json;

// A program that stands for nezumi.
std::string program(const Scratch& folder, const std::string& lines) {
    folder.write("bin/nezumi", "#!/bin/sh\n" + lines);
    const std::string path = (folder.path() / "bin/nezumi").string();
    chmod(path.c_str(), 0755);
    return path;
}

Json edit(const std::string& what, int id, Json more = Json::object()) {
    more.update({{"do", "edit"}, {"what", what}, {"id", id}});
    return more;
}

}  // namespace

TEST_CASE("a browser lists, reads and saves the files of the project", "[web][editor]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const Json list = WebRig::answer(browser, edit("list", 1));
    CHECK(list["ok"] == true);
    const auto& files = list["files"];
    REQUIRE(std::any_of(files.begin(), files.end(),
                        [](const Json& each) { return each["file"] == "behaviors/counter.lua"; }));
    const Json read = WebRig::answer(browser, edit("read", 2, {{"file", "behaviors/counter.lua"}}));
    CHECK(read["content"] == counter_behavior);
    const Json saved = WebRig::answer(browser, edit("save", 3,
                                                    {{"file", "behaviors/counter.lua"},
                                                     {"text", counter_behavior + std::string("-- more\n")},
                                                     {"mark", read["mark"]}}));
    CHECK(saved["ok"] == true);
    CHECK(rig.said("browser 1: saves behaviors/counter.lua"));
    const Json again = WebRig::answer(
        browser, edit("save", 4, {{"file", "behaviors/counter.lua"}, {"text", "x"}, {"mark", read["mark"]}}));
    CHECK(again["ok"] == false);
    CHECK(again["changed"] == true);
    CHECK(again["text"] == "behaviors/counter.lua: it was changed meanwhile");
    CHECK(again["mark"] == saved["mark"]);
    const Json versions = WebRig::answer(browser, edit("versions", 5, {{"file", "behaviors/counter.lua"}}));
    CHECK(versions["versions"].size() == 2);
    const Json old = WebRig::answer(browser, edit("version", 6, {{"file", "behaviors/counter.lua"}, {"number", 1}}));
    CHECK(old["content"] == counter_behavior);
}

TEST_CASE("a view-only browser can't read, check or save files, and can't run scenarios", "[web][editor]") {
    WebRig rig;
    RawBrowser browser = rig.open(rig.view_token);
    int id = 1;
    for (const Json& message :
         {edit("list", 1), edit("read", 2, {{"file", "behaviors/counter.lua"}}),
          edit("check", 3, {{"file", "behaviors/counter.lua"}, {"text", ""}}),
          edit("save", 4, {{"file", "behaviors/new.lua"}, {"text", "attack"}, {"mark", ""}}),
          edit("versions", 5, {{"file", "behaviors/counter.lua"}}), Json{{"do", "test"}, {"what", "run"}, {"id", 6}}}) {
        INFO(message.dump());
        const Json answer = WebRig::answer(browser, message);
        CHECK(answer["id"] == id++);
        CHECK(answer["ok"] == false);
        CHECK(answer["text"] == "this link is view-only");
    }
    CHECK_FALSE(std::filesystem::exists(rig.file.parent_path() / "behaviors/new.lua"));
}

TEST_CASE("a check gives the errors of nezumi check, or the reason if it fails", "[web][editor]") {
    const Scratch folder;
    EditorOptions options{
        .program = program(folder,
                           "text=$(cat)\n"
                           "[ \"$text\" = crash ] && { echo 'no memory' >&2; exit 2; }\n"
                           "echo \"[{\\\"file\\\":\\\"$5\\\",\\\"line\\\":3,\\\"message\\\":\\\"$text $*\\\"}]\"\n"
                           "exit 1\n")};
    WebRig rig(counter_system, {{"counter", counter_behavior}}, options);
    RawBrowser browser = rig.open();
    const auto check = [&](int id, const char* text) {
        return WebRig::answer(browser, edit("check", id, {{"file", "behaviors/counter.lua"}, {"text", text}}));
    };
    const Json found = check(1, "wrong");
    REQUIRE(found["ok"] == true);
    CHECK(found["findings"][0]["line"] == 3);
    CHECK(found["findings"][0]["file"] == found["shown"]);
    CHECK(found["findings"][0]["message"] == "wrong check - --json --name " + found["shown"].get<std::string>());
    const Json failed = check(2, "crash");
    CHECK(failed["ok"] == false);
    CHECK(failed["text"] == "not checked: no memory");
    CHECK(WebRig::answer(browser, edit("check", 3, {{"file", "../x.lua"}, {"text", ""}}))["ok"] == false);
}

TEST_CASE("a wrong request of an editor is refused with the reason", "[web][editor]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto text = [&](const Json& message) { return WebRig::answer(browser, message)["text"].get<std::string>(); };
    CHECK(text(edit("burn", 1)) == "'what' must be one of list, read, check, save, versions, version, words");
    CHECK(text(edit("read", 2)) == "'file' must be a string");
    CHECK(text(edit("save", 3, {{"file", "x.lua"}, {"text", "x"}})) == "'mark' must be a string");
    CHECK(text(edit("version", 4, {{"file", "x.lua"}, {"number", -1}})) == "'number' must be a whole number from 1");
    CHECK(text(edit("read", 5, {{"file", "nobody.lua"}})) == "nobody.lua: there is no such file");
    CHECK(text({{"do", "test"}, {"what", "fly"}, {"id", 6}}) ==
          "'what' must be one of list, run, stop, open, watch, recordings, judge");
    CHECK(text({{"do", "test"}, {"what", "run"}, {"id", 7}}) ==
          "this program can't run scenarios: use `nezumi test`, or the page of `nezumi run`");
}

TEST_CASE("scenarios run as processes whose report is sent while they run", "[web][scenarios]") {
    const Scratch folder;
    EditorOptions options{.program = program(folder,
                                             "case \"$*\" in\n"
                                             "*--list*) echo 'a scenario  tests/a_test.lua:1' ;;\n"
                                             "*--filter*) sleep 60 ;;\n"
                                             "*) echo 'TAP version 13'; echo 'ok 1 - tests/a_test.lua: a scenario' ;;\n"
                                             "esac\n")};
    WebRig rig(counter_system, {{"counter", counter_behavior}}, options);
    RawBrowser browser = rig.open();
    const auto test = [&](int id, const std::string& what, Json more = Json::object()) {
        more.update({{"do", "test"}, {"what", what}, {"id", id}});
        return WebRig::answer(browser, more);
    };
    CHECK(test(1, "list")["content"] == "a scenario  tests/a_test.lua:1\n");
    CHECK(test(2, "run")["ok"] == true);
    CHECK(Json::parse(browser.next_text("\"is\":\"tests\",\"text\""))["text"] ==
          "TAP version 13\nok 1 - tests/a_test.lua: a scenario\n");
    CHECK(Json::parse(browser.next_text("\"done\":true"))["problem"] == "");
    CHECK(test(3, "run", {{"file", "../a_test.lua"}})["ok"] == false);
    CHECK(test(8, "run", {{"file", "--hw.lua"}})["text"] == "'--hw.lua' begins with '-': rename it");
    CHECK(test(4, "open", {{"file", "nezumi-test/../../x"}})["text"] ==
          "'nezumi-test/../../x' is not the folder of a failed run");

    CHECK(test(5, "run", {{"name", "slow"}})["ok"] == true);
    CHECK(test(6, "run")["text"] == "scenarios are running already: stop them first");
    CHECK(test(7, "stop")["ok"] == true);
    CHECK(Json::parse(browser.next_text("\"done\":true"))["problem"] == "stopped");
}
