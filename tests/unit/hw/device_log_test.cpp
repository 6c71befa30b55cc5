// Device logs: writing, reading, errors, and comparison of writes.
#include "hw/log/device_log.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <limits>

#include "hw/log/write_comparison.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

using Kind = DeviceCall::Kind;

constexpr double never = std::numeric_limits<double>::infinity();

std::string with_header(const std::string& lines) { return device_log_header() + lines; }

std::string refused(const std::string& text) {
    const auto log = read_device_log(text, "x.log");
    return log ? "read" : describe(log.error());
}

WriteComparison comparison(std::vector<WriteComparison::Write> logged, double start = 0, double end = 10) {
    return {"x.log", {{"/dev/m", std::move(logged)}}, start, end};
}

}  // namespace

TEST_CASE("each kind of call is a line of a device log, and is read again", "[hw][log]") {
    const auto [call, line] = GENERATE(table<DeviceCall, std::string>({
        {{.kind = Kind::open_write, .path = "/dev/rtled0", .begin = 0.5, .took = 0.001},
         "0.500000 0.001000 open-write /dev/rtled0 = ok\n"},
        {{.kind = Kind::open_read, .path = "/dev/rtled0", .begin = 0.5, .took = 0.001, .error = EACCES},
         "0.500000 0.001000 open-read /dev/rtled0 = EACCES\n"},
        {{.kind = Kind::read, .path = "/dev/rtlightsensor0", .begin = 1, .took = 0.0025, .text = "1 2 3 4\n"},
         "1.000000 0.002500 read /dev/rtlightsensor0 = \"1 2 3 4\\n\"\n"},
        {{.kind = Kind::write, .path = "/dev/rtmotor_raw_l0", .begin = 1, .took = 0, .text = "-400", .bytes = 4},
         "1.000000 0.000000 write /dev/rtmotor_raw_l0 \"-400\" = 4\n"},
        {{.kind = Kind::write, .path = "/dev/x", .begin = 1, .took = 0, .error = ENODEV, .text = "\"\\\x01\xff"},
         "1.000000 0.000000 write /dev/x \"\\\"\\\\\\x01\\xff\" = ENODEV\n"},
        {{.kind = Kind::write, .path = "/dev/x", .begin = 1, .took = never, .text = "5"},
         "1.000000 never write /dev/x \"5\" =\n"},
        {{.kind = Kind::list, .path = "/sys/class/tacho-motor", .begin = 1, .took = 0, .text = "motor0\nmotor1\n"},
         "1.000000 0.000000 list /sys/class/tacho-motor = \"motor0\\nmotor1\\n\"\n"},
        {{.kind = Kind::keys, .path = "/dev/input/a b", .begin = 1, .took = 0, .text = std::string(1, '\0')},
         "1.000000 0.000000 keys \"/dev/input/a b\" = \"\\x00\"\n"},
    }));
    CHECK(to_line(call) == line);
    const auto log = read_device_log(with_header(line), "x.log");
    REQUIRE(log);
    REQUIRE(log->calls.size() == 1);
    DeviceCall expected = call;
    expected.line = 2;
    CHECK(log->calls[0] == expected);
}

TEST_CASE("a device log says when the ticks began and ended, and a torn last line is left out", "[hw][log]") {
    const std::string open = "0.100000 0.000000 open-write /dev/rtled0 = ok\n";
    auto log = read_device_log(with_header(open + start_line(0.25) + end_line(3.5) + open), "x.log");
    REQUIRE(log);
    CHECK(log->start == 0.25);
    CHECK(log->length == 3.5);
    CHECK(log->calls.size() == 2);
    CHECK_FALSE(log->is_torn);
    log = read_device_log(with_header(open + "0.2000"), "x.log");
    REQUIRE(log);
    CHECK(log->is_torn);
    CHECK(log->calls.size() == 1);
    CHECK(log->start == 0);
    CHECK(log->length == Approx(0.1));  // of an interrupted run: its last call
}

TEST_CASE("a file that is not a device log is refused with line, content and expectation", "[hw][log]") {
    CHECK(refused("") == "x.log:1: is empty: expected a device log of nezumi run --device-log");
    CHECK(refused("{\"journal\":1}\n") ==
          "x.log:1: is not a device log (written by nezumi run --device-log): expected 'nezumi device log 1', got "
          "'{\"journal\":1}'");
    const auto [line, why] = GENERATE(table<std::string, std::string>({
        {"", "expected a time [s], got ''"},
        {"soon 0 read /dev/x = \"1\"", "expected a time [s], got 'soon'"},
        {"-1 0 read /dev/x = \"1\"", "expected a time [s], got '-1'"},
        {"nan 0 read /dev/x = \"1\"", "expected a time [s], got 'nan'"},
        {"1 long read /dev/x = \"1\"", "expected a duration [s], got 'long'"},
        {"1 0 peek /dev/x = \"1\"", "expected open-read, open-write, read, write, list or keys, got 'peek'"},
        {"1 0 read /etc/passwd = \"1\"", "expected a path in /dev or /sys, got '/etc/passwd = \"1\"'"},
        {"1 0 write /dev/x 400 = 3", "expected what was written, in quotes, got '400 = 3'"},
        {"1 0 write /dev/x \"400 = 3", "expected what was written, in quotes, got '\"400 = 3'"},
        {"1 0 write /dev/x \"4\" = three",
         "expected the number of written bytes, or an error such as EIO, got 'three'"},
        {"1 0 read /dev/x \"1\"", "expected =, got '\"1\"'"},
        {"1 0 read /dev/x = ENOSUCH", "expected a string in quotes, or an error such as EIO, got 'ENOSUCH'"},
        {"1 0 read /dev/x = \"\\q\"", "expected a string in quotes, or an error such as EIO, got '\"\\q\"'"},
        {"1 0 read /dev/x = \"1\" 2", "expected a string in quotes, or an error such as EIO, got '\"1\" 2'"},
        {"1 0 open-read /dev/x = 3", "expected ok or an error such as EIO, got '3'"},
        {"1 never read /dev/x = \"1\"", "expected the end of the line, got '\"1\"'"},
        {"late end", "expected exactly one line 'TIME start' and one line 'TIME end', got 'late end'"},
    }));
    CHECK(refused(with_header(line + "\n")) == "x.log:2: " + why);
    CHECK(refused(with_header("1 end\n2 end\n")) ==
          "x.log:3: expected exactly one line 'TIME start' and one line 'TIME end', got '2 end'");
    CHECK(refused(with_header("2 start\n1 end\n")) == "x.log:3: ends at 1 s, before it starts at 2 s");
}

TEST_CASE("a long written text is logged as its length and a fingerprint", "[hw][log]") {
    CHECK(fingerprint("") == "#0:cbf29ce484222325");  // FNV-1a's offset basis
    CHECK(fingerprint("a") == "#1:af63dc4c8601ec8c");
}

TEST_CASE("equal writes at about the same time match", "[hw][log]") {
    auto it = comparison({{1, "run", 5}, {3, "stop", 6}});
    it.wrote("/dev/m", 1.1, "run");
    it.wrote("/dev/m", 2.0, "run");  // again: the value is in force
    it.wrote("/dev/m", 2.9, "stop");
    CHECK(it.compare(10).empty());
    CHECK(it.compared() == 5);
    CHECK(it.differences() == 0);
}

TEST_CASE("ramps with different steps match", "[hw][log]") {
    auto it = comparison({{1.00, "20", 5}, {1.02, "60", 6}, {1.04, "100", 7}, {1.06, "400", 8}});
    it.wrote("/dev/m", 1.01, "33");
    it.wrote("/dev/m", 1.03, "80");
    it.wrote("/dev/m", 1.05, "396");  // within a tenth
    CHECK(it.compare(10).empty());
}

TEST_CASE("a difference between two runs is reported once until they agree again", "[hw][log]") {
    auto it = comparison({{1, "400", 5}, {5, "0", 6}});
    it.wrote("/dev/m", 1, "400");
    it.wrote("/dev/m", 2, "100");
    it.wrote("/dev/m", 3, "90");
    CHECK(it.compare(2.1).empty());  // the log may have it a moment later
    CHECK(it.compare(3.5) ==
          std::vector<std::string>{"x.log: at 2.000 s '100' is written to /dev/m, and the log has '400' (line 5)"});
    it.wrote("/dev/m", 5, "0");
    it.wrote("/dev/m", 6, "50");
    CHECK(it.compare(8) ==
          std::vector<std::string>{"x.log: at 6.000 s '50' is written to /dev/m, and the log has '0' (line 6)"});
    CHECK(it.differences() == 2);
}

TEST_CASE("a write that is missing is reported with the log's line", "[hw][log]") {
    auto it = comparison({{1, "400", 5}, {2, "0", 6}});
    it.wrote("/dev/m", 1, "400");
    CHECK(it.compare(8) == std::vector<std::string>{"x.log:6: at 2.000 s '0' was written to /dev/m, but now it has "
                                                    "'400'"});
    WriteComparison silent{"x.log", {{"/dev/led", {{1, "1", 7}}}}, 0, 10};
    silent.wrote("/dev/other", 1, "1");
    CHECK(silent.compare(8) ==
          std::vector<std::string>{"x.log:7: at 1.000 s '1' was written to /dev/led, but now it has nothing",
                                   "x.log: at 1.000 s '1' is written to /dev/other, and the log has nothing"});
}

TEST_CASE("only writes between the start and the end of a log are compared", "[hw][log]") {
    auto it = comparison({{0.5, "1", 5}, {3, "2", 6}, {9.9, "3", 7}, {11, "4", 8}}, 2, 10);
    it.wrote("/dev/m", 1, "7");
    it.wrote("/dev/m", 3, "2");
    CHECK(it.compare(20).empty());
    CHECK(it.compared() == 2);
}

TEST_CASE("setting the clock moves the times of earlier writes", "[hw][log]") {
    auto it = comparison({{3, "on", 5}});
    it.wrote("/dev/m", 1, "on");
    it.move_written(2);
    CHECK(it.compare(10).empty());
    CHECK(it.compared() == 2);
}
