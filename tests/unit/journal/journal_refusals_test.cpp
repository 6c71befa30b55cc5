// What a journal that can't be replayed says.
#include <catch2/catch.hpp>

#include "bindings/journal/journal.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/journal/small_run.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;

TEST_CASE("a journal says which line can't be replayed, and why", "[journal]") {
    SmallRun it(counter);
    it.tick(3);
    REQUIRE(it.live->act(SetParameter{"it", "step", std::int64_t{2}}, {Actor::Kind::console}));
    it.tick(3);
    it.end();
    const std::string act = R"({"at":[1,3,0],"who":"console","do":"SetParameter","with":)";
    CHECK_THAT(text_of_file(it.file), Contains(act + R"({"component":"it","parameter":"step","value":2}})"));
    CHECK(it.error_with(2, "no line at all") == "J:2: expected a JSON object");
    CHECK(it.error_with(2, R"({"at":[1,3],"hash":"0"})") ==
          "J:2: 'at' must be the start's number, the tick and the act's number");
    CHECK(it.error_with(2, act + R"({"component":"it","parameter":"step"}})") ==
          "J:2: SetParameter: 'value' is missing");
    CHECK(it.error_with(2, act + R"({"component":"it","parameter":"step","value":2,"more":1}})") ==
          "J:2: SetParameter: it has an unknown field");
    CHECK(it.error_with(2, act + R"({"component":"it","parameter":"stop","value":2}})") ==
          "J:2: SetParameter succeeded in the original run, but fails now: unknown parameter 'stop' (did you mean "
          "'step'?)");
    CHECK(it.error_with(2, R"({"at":[1,3,0],"who":"console","do":"Set","with":{}})") ==
          "J:2: there is no act (change of the running system) 'Set'");
    CHECK(it.error_with(2, R"({"at":[1,3,0],"who":"somebody","do":"Stop","with":{}})")
              .starts_with("J:2: 'somebody' is not a kind of actor: expected one of run, console"));
    CHECK(it.error_with(2, R"({"at":[2,3,0],"who":"console","do":"Stop","with":{}})") ==
          "J:3: 'at' must not go back, but tick 6 of start 1 comes after tick 3 of start 2");
    CHECK(it.error_with(2, R"({"at":[1,4,0],"hash":"0000000000000000"})")
              .starts_with("J:2: this run differs from the journal's run: its hash at tick 4 of start 1 was "
                           "0000000000000000, not "));
    CHECK(it.error_with(1, "[]") == "J:1: is not a journal of nezumi run --journal");
    CHECK(it.error_with(1, R"({"journal":2,"version":"0.0"})") ==
          "J is a journal of nezumi 0.0 in the format 2: this is nezumi test, which reads only format 1");
    CHECK(it.error_with(1, R"({"journal":2,"version":"\u001b\n"})") ==
          R"(J is a journal of nezumi \x1b\x0a in the format 2: this is nezumi test, which reads only format 1)");
    CHECK(it.error_with(1, R"({"journal":1,"version":"test","hardware":true})") ==
          "J is the journal of a run on hardware: it is only a record, and can't be replayed");
    CHECK(replay(it.folder.path("none")).error == it.folder.path("none").string() + ": there is no such file");
    CHECK(replay(it.folder.path("")).error == it.folder.path("").string() + ": is a folder, expected a file");
}

TEST_CASE("a journal of another version is replayed, and where the run differs both versions are named", "[journal]") {
    SmallRun it(counter);
    it.tick(6);
    it.end();
    std::string text = text_of_file(it.file);
    const std::string ours = R"("version":")" + std::string(journal_version) + '"';
    REQUIRE(text.find(ours) != std::string::npos);
    text.replace(text.find(ours), ours.size(), R"("version":"0.0")");
    const auto other = Replay::of_text(text, "J", journal_version);
    REQUIRE(other);
    CHECK((*other)->other_version() == "0.0");
    CHECK(replay(it.folder.write("other.journal", text)).error.empty());
    text.replace(text.find('\n') + 1, text.npos,
                 R"({"at":[1,4,0],"hash":"0000000000000000"})"
                 "\n");
    CHECK_THAT(replay(it.folder.write("other.journal", text)).error,
               Contains("; the journal is of nezumi 0.0, this is test"));
}

TEST_CASE("a journal whose lines are not those of a run is refused at the line", "[journal]") {
    SmallRun it(counter);
    it.tick(3);
    REQUIRE(it.live->act(SetParameter{"it", "step", std::int64_t{2}}, {Actor::Kind::console}));
    it.tick(3);
    it.end();
    CHECK(it.error_with(2, R"({"at":[1,3,0],"who":"console","do":"Rearm","with":{},"failed":true})").empty());
    CHECK(it.error_with(2, R"({"at":[1,3,0],"who":"console","do":"Stop","with":{},"failed":true})") ==
          "J:2: Stop failed in the original run, but not now");
    CHECK(it.error_with(2, R"({"at":[1,3,0],"who":"console","do":"Stop"})") == "J:2: an act must have do and with");
    CHECK(it.error_with(2, R"({"at":[1,3,0],"out_of_time":5})") ==
          "J:2: 'out_of_time' must have component, call and message");
    CHECK(it.error_with(2, R"({"at":[1,3,0],"out_of_time":{"component":"it","call":1,"message":"m","state":5}})") ==
          "J:2: state: expected values and tables, got 5");
    CHECK(it.error_with(2, R"({"at":[1,3,0],"end":"stopped","hash":"0000000000000000"})") ==
          "J:3: this line is after the end: 'end' must be the last line");
    CHECK(it.error_with(3, R"({"at":[1,6,1],"end":"soon","hash":"0000000000000000"})") ==
          "J:3: 'end' must be duration, stopped or error");
    CHECK(it.error_with(3, R"({"at":[2,0,1],"end":"stopped","hash":"0000000000000000"})") ==
          "J:3: this entry is for tick 0 of start 2, which the run never reaches: it is at tick 3 of start 1");
    CHECK(it.error_with(1, R"({"journal":1,"version":"test"})") ==
          "J:1: expected system, working_folder, installed, seed, seed_wins and files");
    CHECK(it.error_with(1, R"({"journal":1,"version":"test","system":"s","working_folder":"w","seed":0,)"
                           R"("seed_wins":false,"installed":[1]})") == "J:1: 'installed' must be a list of folders");
    const std::filesystem::path cut = it.folder.write("cut.journal", "{");
    CHECK(replay(cut).error == cut.string() + ":1: is not a journal: its first line is incomplete");
}
