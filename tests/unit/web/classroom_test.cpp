// A class without browsers: names and codes, exercises, frames between processes, results.
#include "bindings/web/classroom/classroom.hpp"

#include <sys/socket.h>
#include <sys/stat.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>
#include <string>

#include "bindings/web/classroom/check_work.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

namespace fs = std::filesystem;

std::string why_not(const Expected<Pupil*>& joined) { return joined ? "" : joined.error().message; }

}  // namespace

TEST_CASE("a pupil's name is never part of a path", "[web][class]") {
    const Scratch scratch;
    auto pupils = Pupils::load(scratch.path());
    REQUIRE(pupils);
    for (const char* name : {"../../outside", "/etc", ".", "..", "花子", "a/b", "C:\\x", "-rf"}) {
        auto pupil = pupils->join(name);
        REQUIRE(pupil);
        (*pupil)->exercise = "drive";
        CHECK((*pupil)->name == name);
        CHECK(pupils->work_of(**pupil).parent_path().parent_path().parent_path() == scratch.path("pupils"));
    }
    std::set<std::string> there;
    for (const auto& entry : fs::directory_iterator(scratch.path("pupils"))) there.insert(entry.path().filename());
    CHECK(there == std::set<std::string>{"01", "02", "03", "04", "05", "06", "07", "08"});
}

TEST_CASE("a name that can't be shown, is empty, too long or taken is refused", "[web][class]") {
    const Scratch scratch;
    auto pupils = Pupils::load(scratch.path());
    REQUIRE(pupils);
    CHECK(why_not(pupils->join("  ")) == "enter a name");
    CHECK(why_not(pupils->join(std::string(121, 'a'))) == "the name is too long");
    for (const char* name : {"a\nb", "a\tb", "a\x1b[31m", "\xff\xfe", "\u202eabc"})
        CHECK(why_not(pupils->join(name)) == "the name has characters that can't be shown");
    CHECK(pupils->join(" Taro "));
    CHECK(why_not(pupils->join("Taro")) ==
          "this name is already used: use your code to come back, or add a letter to the name");
}

TEST_CASE("a pupil comes back by the code after the class was opened again", "[web][class]") {
    const Scratch scratch;
    std::string code, token;
    {
        auto pupils = Pupils::load(scratch.path());
        REQUIRE(pupils);
        auto pupil = pupils->join("花子");
        REQUIRE(pupil);
        (*pupil)->hints = {"look at the sensor"};
        (*pupil)->mark = "A";
        REQUIRE(pupils->save(**pupil));
        code = (*pupil)->code;
        token = (*pupil)->token;
        CHECK(code.size() == Pupils::code_length);
        CHECK(token.size() == 32);
    }
    auto pupils = Pupils::load(scratch.path());
    REQUIRE(pupils);
    const Pupil* pupil = pupils->find_code(code);
    REQUIRE(pupil != nullptr);
    CHECK(pupil->name == "花子");
    CHECK(pupil->token == token);
    CHECK(pupil->hints == std::vector<std::string>{"look at the sensor"});
    CHECK(pupil->mark == "A");
    std::string typed = code.substr(0, 3) + "-" + code.substr(3);
    for (char& each : typed) each = static_cast<char>(std::toupper(each));
    CHECK(pupils->find_code(typed) == pupil);
    CHECK(pupils->find_code("") == nullptr);
    CHECK(pupils->find_code(code + "2") == nullptr);
    // Only the owner of the folder reads names and codes.
    struct stat status {};
    REQUIRE(lstat(scratch.path("pupils").c_str(), &status) == 0);
    CHECK((status.st_mode & 077) == 0);
}

TEST_CASE("a new code replaces the old one", "[web][class]") {
    const Scratch scratch;
    auto pupils = Pupils::load(scratch.path());
    REQUIRE(pupils);
    auto pupil = pupils->join("Taro");
    REQUIRE(pupil);
    const Pupil before = **pupil;
    REQUIRE(pupils->renew(**pupil));
    CHECK(pupils->find_code(before.code) == nullptr);
    CHECK(pupils->find_code((*pupil)->code) == *pupil);
    CHECK((*pupil)->token != before.token);
}

TEST_CASE("a damaged file of a pupil is named", "[web][class]") {
    const Scratch scratch;
    scratch.write("pupils/01/pupil.json", "{ \"name\": 3 }");
    const auto pupils = Pupils::load(scratch.path());
    REQUIRE_FALSE(pupils);
    CHECK(describe(pupils.error()) == scratch.path("pupils/01/pupil.json").string() + ": is not the file of a pupil");
}

TEST_CASE("wrong codes are limited for one address and for all", "[web][class]") {
    Tries tries;
    const auto now = Tries::Clock::now();
    for (std::size_t i = 0; i < Tries::most_of_source; ++i) {
        REQUIRE(tries.may_try("10.0.0.1", now));
        tries.was_wrong("10.0.0.1", now);
    }
    CHECK_FALSE(tries.may_try("10.0.0.1", now));
    CHECK(tries.may_try("10.0.0.2", now));
    CHECK(tries.may_try("10.0.0.1", now + Tries::span + std::chrono::seconds(1)));
    for (std::size_t i = 0; i < Tries::most; ++i) tries.was_wrong(std::to_string(i), now);
    CHECK_FALSE(tries.may_try("10.0.0.3", now));
}

TEST_CASE("frames between processes arrive whole, in any pieces", "[web][class]") {
    std::string bytes;
    append_frame(bytes, {.kind = RelayFrame::Kind::message, .client = 3, .bytes = "hello"});
    append_frame(bytes, {.kind = RelayFrame::Kind::closed, .client = 1ULL << 40U});
    RelayReader reader;
    std::vector<RelayFrame> frames;
    for (const char each : bytes) {
        reader.add({&each, 1});
        while (auto frame = reader.next()) frames.push_back(*frame);
    }
    REQUIRE(frames.size() == 2);
    CHECK(frames[0].client == 3);
    CHECK(frames[0].bytes == "hello");
    CHECK(frames[1].kind == RelayFrame::Kind::closed);
    CHECK(frames[1].client == 1ULL << 40U);
    CHECK_FALSE(reader.is_broken());
}

TEST_CASE("a frame of an unknown kind or of too many bytes ends the exchange", "[web][class]") {
    for (const std::string& head :
         {std::string(1, '\x20') + std::string(12, '\0'), '\5' + std::string(8, '\0') + "\xff\xff\xff\x7f"}) {
        RelayReader reader;
        reader.add(head);
        CHECK_FALSE(reader.next());
        CHECK(reader.is_broken());
        reader.add(std::string(100, '\0'));
        CHECK_FALSE(reader.next());
    }
}

TEST_CASE("files are copied without links and hidden names", "[web][class]") {
    const Scratch scratch;
    scratch.write("secret.lua", "return 1");
    scratch.write("from/behaviors/a.lua", "new");
    scratch.write("from/.nezumi/versions/x", "old");
    fs::create_symlink(scratch.path("secret.lua"), scratch.path("from/behaviors/link.lua"));
    fs::create_directory_symlink(scratch.path(), scratch.path("from/up"));
    scratch.write("to/behaviors/a.lua", "mine");
    REQUIRE(copy_files(scratch.path("from"), scratch.path("to"), false));
    CHECK(text_of_file(scratch.path("to/behaviors/a.lua")) == "mine");
    REQUIRE(copy_files(scratch.path("from"), scratch.path("to"), true));
    CHECK(text_of_file(scratch.path("to/behaviors/a.lua")) == "new");
    CHECK_FALSE(fs::exists(fs::symlink_status(scratch.path("to/behaviors/link.lua"))));
    CHECK_FALSE(fs::exists(fs::symlink_status(scratch.path("to/up"))));
    CHECK_FALSE(fs::exists(scratch.path("to/.nezumi")));
}

TEST_CASE("three exercises ship, each in English and Japanese", "[web][class]") {
    const auto exercises = find_exercises({fs::path(source_root()) / "behaviors/exercises"});
    REQUIRE(exercises.size() == 3);
    for (const Exercise& each : exercises) {
        INFO(each.name);
        CHECK(each.text.starts_with("# "));
        CHECK(each.text_ja.starts_with("# "));
        CHECK(fs::exists(each.start() / "tests"));
        CHECK(fs::exists(each.hidden() / "tests"));
    }
}

TEST_CASE("a folder whose name is not an identifier, or that has no system file, is not an exercise", "[web][class]") {
    const Scratch scratch;
    for (const char* name : {"good", "not good", "bare"}) {
        const std::string folder = name;
        scratch.write(folder + "/text.md", "# Title\n");
        if (folder != "bare") scratch.write(folder + "/start/behaviors/systems/" + folder + ".lua", "arena {}");
    }
    const auto exercises = find_exercises({scratch.path(), scratch.path("nowhere")});
    REQUIRE(exercises.size() == 1);
    CHECK(exercises[0].name == "good");
}

TEST_CASE("results of scenarios are read, hidden ones by their files", "[web][class]") {
    const Scratch scratch;
    scratch.write("tests/b_test.lua", "");
    const auto checked = read_tap(
        "TAP version 13\n1..3\nok 1 - x/tests/a_test.lua: drives\n# a margin\nnot ok 2 - x/tests/b_test.lua: stops - "
        "at once\n",
        scratch.path());
    REQUIRE(checked.size() == 2);
    CHECK(checked[0].name == "drives");
    CHECK(checked[0].passed);
    CHECK_FALSE(checked[0].hidden);
    CHECK(checked[1].name == "stops - at once");
    CHECK_FALSE(checked[1].passed);
    CHECK(checked[1].hidden);
}

TEST_CASE("names and comments can't become formulas of a spreadsheet or elements of the results", "[web][class]") {
    const std::vector<PupilResult> results{{.number = 1,
                                            .name = "=HYPERLINK(\"x\")",
                                            .exercise = "drive",
                                            .comment = "good, go on",
                                            .checked = {{"<a> & \"b\"", true, false}, {"c", false, true}}}};
    CHECK(results_csv(results) ==
          "number,name,exercise,passed,scenarios,problem,mark,comment\n"
          "01,\"'=HYPERLINK(\"\"x\"\")\",drive,1,2,,,\"good, go on\"\n");
    const std::string xml = results_junit(results);
    CHECK(xml.find("<testsuite name=\"=HYPERLINK(&quot;x&quot;)\" tests=\"2\" failures=\"1\" errors=\"0\">") !=
          std::string::npos);
    CHECK(xml.find("name=\"&lt;a&gt; &amp; &quot;b&quot;\"/>") != std::string::npos);
    CHECK(xml.find("name=\"c\"><failure/></testcase>") != std::string::npos);
}

TEST_CASE("a tile shows the first error of a system, and since when", "[web][class]") {
    SeatView view;
    CHECK(view.state() == "starting");
    const auto text = [&](const std::string& bytes) {
        view.take({.kind = RelayFrame::Kind::text, .client = 0, .bytes = bytes});
    };
    text(R"({"is":"system","stopped":false,"components":[{"state":"ACTIVE"}]})");
    CHECK(view.state() == "runs");
    CHECK(view.error_since() == 0);
    text(R"({"is":"system","stopped":false,"components":[{"state":"ERROR","error":"controller.lua:3: no"}]})");
    CHECK(view.state() == "error");
    CHECK(view.error() == "controller.lua:3: no");
    CHECK(view.error_since() > 0);
    text(R"({"is":"system","stopped":true,"components":[]})");
    CHECK(view.state() == "stopped");
    // A process that is not trusted sends anything.
    for (const char* wrong :
         {R"({"is":"system")", R"({"is":"system","components":3})", R"({"is":"system","components":[3,{"state":[]}]})"})
        text(wrong);
    CHECK(view.state() == "runs");
}
