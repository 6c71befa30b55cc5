// The rover's firmware, compiled for this computer: its pins are numbers, its clock is the test's.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <string>

#include "tests/unit/file_text.hpp"

namespace rover_firmware {
namespace {

// What the sketch uses of Arduino's library.
// NOLINTBEGIN: its names, and global variables as a sketch has them
using byte = unsigned char;
constexpr int A0 = 14, HIGH = 1, LOW = 0, OUTPUT = 1, INPUT_PULLUP = 2, CHANGE = 1;
constexpr double steps_per_volt = 1023 / 5.0 / 2;

unsigned long time_now = 0, echo_length = 0;  // [ms], [us]
int battery_steps = 0;
std::map<int, int> levels, powers;
std::map<int, void (*)()> interrupt_functions;
std::string to_board, from_board;

unsigned long millis() { return time_now; }
void delayMicroseconds(int /*time*/) {}
void pinMode(int /*pin*/, int /*mode*/) {}
void digitalWrite(int pin, int level) { levels[pin] = level; }
int digitalRead(int pin) { return levels[pin]; }
void analogWrite(int pin, int power) { powers[pin] = power; }
int analogRead(int /*pin*/) { return battery_steps; }
unsigned long pulseIn(int /*pin*/, int /*level*/, unsigned long /*longest*/) { return echo_length; }
int digitalPinToInterrupt(int pin) { return pin; }
void attachInterrupt(int number, void (*function)(), int /*mode*/) { interrupt_functions[number] = function; }
void noInterrupts() {}
void interrupts() {}
double constrain(double value, double least, double most) { return std::fmin(std::fmax(value, least), most); }

struct {
    void begin(long /*baud*/) {}
    int available() { return static_cast<int>(to_board.size()); }
    char read() {
        const char first = to_board.front();
        to_board.erase(0, 1);
        return first;
    }
    void print(const char* text) { from_board += text; }
    void print(char text) { from_board += text; }
    void print(long number) { from_board += std::to_string(number); }
    void println(long number) { from_board += std::to_string(number) + "\r\n"; }
    void println(double number, int digits) {
        char text[32];
        std::snprintf(text, sizeof text, "%.*f\r\n", digits, number);
        from_board += text;
    }
} Serial;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#include "hw/rover/rover.ino"
#pragma GCC diagnostic pop
// NOLINTEND

// At 0.2 m/s and wheels that stand: a third of full power, and 200 for each m/s that is still missing, rounded down.
constexpr int ahead = 124;

// The sketch, switched on. Its variables are those of the program, so the clock only goes on.
struct Board {
    Board() {
        setup();
        run(1000);
        from_board.clear();
    }
    static void run(int milliseconds) {
        for (; milliseconds > 0; --milliseconds) {
            ++time_now;
            loop();
        }
    }
    static void say(const std::string& text) { to_board += text; }
    // Power of the left wheel, backward negative.
    static int left() { return powers[left_pwm] * (levels[left_ahead] - levels[left_back]); }
    static int right() { return powers[right_pwm] * (levels[right_ahead] - levels[right_back]); }
    static long lines(char kind) {
        long count = 0;
        for (const std::string& said : nezumi::lines_of(from_board)) count += said.starts_with(kind) ? 1 : 0;
        return count;
    }
    static bool said(const std::string& text) {
        return ("\n" + from_board).find("\n" + text + "\r\n") != std::string::npos;
    }
};

}  // namespace

TEST_CASE("the rover's firmware drives by a line, and stands 0.3 s after the last one",
          "[hw][wire][firmware][safety]") {
    Board board;
    Board::say("v 0.200 0.000\n");
    Board::run(25);
    CHECK(Board::left() == ahead);
    CHECK(Board::right() == Board::left());
    Board::run(270);
    CHECK(Board::left() == ahead);
    Board::run(30);
    CHECK(Board::left() == 0);
    CHECK(Board::right() == 0);
    Board::say("v 0.000 1.000\n");
    Board::run(25);
    CHECK(Board::left() < 0);
    CHECK(Board::right() == -Board::left());
    Board::say("v 0 0\n");  // its safe bytes
    Board::run(20);
    CHECK(Board::left() == 0);
    CHECK(Board::right() == 0);
}

TEST_CASE("the rover's firmware ignores empty, torn, unknown and endless lines, and none of them keeps it driving",
          "[hw][wire][firmware][safety]") {
    const std::string wrong = GENERATE(
        "\n", "v 0.2\n", "v 0.2 \n", "v 0.2 0.0 1\n", "v 0.2 0.0x\n", "v  0.2\n", "w 0.2 0.0\n", " v 0.2 0.0\n",
        "v x 0.0\n", "v 0.2 0.0 0123456789012345678901234567890\n", "0123456789012345678901234567890v 0.2 0.0\n");
    Board board;
    CAPTURE(wrong);
    Board::say(wrong);
    Board::run(40);
    CHECK(Board::left() == 0);
    Board::say("v 0.200 0.000\n");
    Board::run(40);
    CHECK(Board::left() == ahead);
    for (int i = 0; i < 7; ++i) {
        Board::say(wrong);
        Board::run(40);
    }
    CHECK(Board::left() == 0);
}

TEST_CASE("the rover's firmware reports its encoders, its range and its battery unasked", "[hw][wire][firmware]") {
    Board board;
    echo_length = 3102;
    battery_steps = static_cast<int>(std::lround(7.41 * steps_per_volt));
    const auto turn = [](int a, int b, bool ahead_is_unlike) {
        levels[a] ^= 1;
        levels[b] = ahead_is_unlike ? levels[a] ^ 1 : levels[a];
        interrupt_functions.at(a)();
    };
    for (int i = 0; i < 120; ++i) turn(left_a, left_b, true);
    for (int i = 0; i < 118; ++i) turn(right_a, right_b, false);
    Board::run(1000);
    CHECK(Board::lines('e') == 50);
    CHECK(Board::lines('r') == 20);
    CHECK(Board::lines('b') == 1);
    CHECK(Board::said("e 120 118"));
    CHECK(Board::said("r 0.532"));
    CHECK(Board::said("b 7.41"));
    echo_length = 0;
    Board::run(100);
    CHECK(Board::said("r 2.000"));
}

}  // namespace rover_firmware
