// How a long session tells how far it has come.
#include "bindings/cli/test/progress.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace nezumi::cli;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

struct Told {
    explicit Told(bool live) : progress([this](std::string_view more) { text += more; }, live, began) {}

    // What is said when so many are done, so long after the beginning.
    std::string at(milliseconds after, std::size_t done, std::size_t all = 100) {
        text.clear();
        progress.update(done, all, began + after);
        return text;
    }

    SweepProgress::Clock::time_point began = SweepProgress::Clock::now();
    std::string text;
    SweepProgress progress;
};

}  // namespace

TEST_CASE("on a terminal one line says how many runs are over and how long the rest takes", "[cli][test]") {
    Told told(true);
    CHECK(told.at(milliseconds(1999), 10).empty());
    CHECK(told.at(seconds(4), 10) == "\r\x1b[K10 of 100 runs, 36 s left");
    CHECK(told.at(milliseconds(4100), 11).empty());
    CHECK(told.at(seconds(400), 50) == "\r\x1b[K50 of 100 runs, 6 min 40 s left");
    told.text.clear();
    told.progress.clear();
    CHECK(told.text == "\r\x1b[K");
    told.text.clear();
    told.progress.clear();
    CHECK(told.text.empty());
    CHECK(told.at(seconds(800), 100).empty());  // nothing is left
}

TEST_CASE("without a terminal, progress is printed once a minute, and not at all in a short session", "[cli][test]") {
    Told told(false);
    CHECK(told.at(seconds(59), 10).empty());
    CHECK(told.at(seconds(60), 10) == "10 of 100 runs, 9 min 0 s left\n");
    CHECK(told.at(seconds(119), 12).empty());
    CHECK(told.at(seconds(3600), 50) == "50 of 100 runs, 1 h 0 min left\n");
    told.text.clear();
    told.progress.clear();
    CHECK(told.text.empty());
}
