// The console's protocol: written lines can be read again; every other input gives an error message and does nothing
// else.
#include "bindings/console/protocol.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace nezumi;

namespace {

std::string refusal(std::string_view line) {
    const auto request = read_request(line);
    return request ? "none" : request.error().message;
}

// What a reader makes of pieces: lines, and "!" before a message.
std::vector<std::string> lines_of(const std::vector<std::string>& pieces, std::size_t limit) {
    LineReader reader(limit);
    std::vector<std::string> lines;
    for (const std::string& piece : pieces) {
        reader.feed(piece);
        while (const auto line = reader.next())
            lines.push_back(line->has_value() ? **line : "!" + line->error().message);
    }
    return lines;
}

}  // namespace

TEST_CASE("a request is written as one line and read back", "[console][protocol]") {
    for (const Request& request :
         {Request{.kind = Request::Kind::eval, .id = 7, .text = "for i = 1, 3 do\n  print \"\xC3\xBC\\\"\"\nend"},
          Request{.kind = Request::Kind::complete, .id = 8, .text = "mouse.", .cursor = 6},
          Request{.kind = Request::Kind::hello, .id = 1, .text = {}, .log = true, .keys = true},
          Request{.kind = Request::Kind::key, .text = "up"}}) {
        const std::string line = to_line(request);
        CHECK(line.find('\n') == line.size() - 1);
        REQUIRE(read_request(line));
        CHECK(*read_request(line) == request);
    }
}

TEST_CASE("an event is written as one line and read back", "[console][protocol]") {
    for (const Event& event :
         {Event{.kind = Event::Kind::answer, .id = 7, .ok = false, .text = {}},
          Event{.kind = Event::Kind::completions, .id = 8, .text = {}, .from = 6, .items = {"in", "out"}},
          Event{.kind = Event::Kind::log, .text = "two\nlines", .level = "warn"},
          Event{.kind = Event::Kind::lost, .text = {}, .count = 12}}) {
        const std::string line = to_line(event);
        CHECK(line.find('\n') == line.size() - 1);
        REQUIRE(read_event(line));
        CHECK(*read_event(line) == event);
    }
    CHECK(to_line(Event{.kind = Event::Kind::answer, .id = 1, .text = {}}) ==
          "{\"id\":1,\"is\":\"answer\",\"ok\":true}\n");
}

TEST_CASE("bytes that are not UTF-8 do not damage a line", "[console][protocol]") {
    const auto event = read_event(to_line(Event{.kind = Event::Kind::output, .text = "a\xFFz"}));
    REQUIRE(event);
    CHECK(event->text == "a\xEF\xBF\xBDz");
}

TEST_CASE("a line that is not a request is refused with one line", "[console][protocol]") {
    CHECK(refusal("") == "expected one JSON object on a line, got ");
    CHECK(refusal("GET / HTTP/1.1\r") == "expected one JSON object on a line, got GET / HTTP/1.1\\x0d");
    CHECK(refusal("[1, 2]") == "expected one JSON object on a line, got [1, 2]");
    CHECK(refusal("{\"do\":\"eval\"") == "expected one JSON object on a line, got {\"do\":\"eval\"");
    CHECK(refusal("{}") == "'do' must be one of hello eval complete is_complete interrupt key");
    CHECK(refusal("{\"do\":\"evil\"}") == "'do' must be one of hello eval complete is_complete interrupt key");
    CHECK(refusal("{\"do\":3}") == "'do' must be a string");
    CHECK(refusal("{\"do\":\"eval\",\"text\":{}}") == "'text' must be a string");
    CHECK(refusal("{\"do\":\"eval\",\"id\":\"1\"}") == "'id' must be a whole number");
    CHECK(refusal("{\"do\":\"eval\",\"id\":1.5}") == "'id' must be a whole number");
    CHECK(refusal("{\"do\":\"eval\",\"id\":18446744073709551615}") == "'id' must be a whole number");
    CHECK(refusal("{\"do\":\"complete\",\"cursor\":-1}") == "'cursor' must be a number that is not negative");
    CHECK(refusal("{\"do\":\"complete\",\"text\":\"ab\",\"cursor\":3}") == "'cursor' lies behind the end of 'text'");
    CHECK(refusal("{\"do\":\"hello\",\"log\":1}") == "'log' must be true or false");
    CHECK(refusal(std::string(100000, '[')).size() < 200);
}

TEST_CASE("a completion without a cursor is at the end of the text", "[console][protocol]") {
    CHECK(read_request("{\"do\":\"complete\",\"text\":\"mou\"}")->cursor == 3);
    const Request at_begin{.kind = Request::Kind::complete, .id = 1, .text = "mou"};
    CHECK(read_request(to_line(at_begin))->cursor == 0);
}

TEST_CASE("unknown fields are ignored", "[console][protocol]") {
    CHECK(refusal("{\"do\":\"eval\",\"text\":\"1\",\"colour\":true}") == "none");
}

TEST_CASE("lines are complete, even if they arrive in pieces", "[console][protocol]") {
    CHECK(lines_of({"one\ntwo\nth", "r", "ee\n", "four"}, 100) == std::vector<std::string>{"one", "two", "three"});
    CHECK(lines_of({"\n\n"}, 100) == std::vector<std::string>{"", ""});
}

TEST_CASE("a line that is too long is refused, and the next one is read", "[console][protocol]") {
    CHECK(lines_of({"12345\n123456\n12345\n"}, 5) ==
          std::vector<std::string>{"12345", "!a line of more than 5 bytes was left out", "12345"});
    CHECK(lines_of({"1234", "5678", "9", "0\nok\n"}, 5) ==
          std::vector<std::string>{"!a line of more than 5 bytes was left out", "ok"});
}
