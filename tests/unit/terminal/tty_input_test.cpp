// What terminals send for keys and characters.
#include "bindings/terminal/tty_input.hpp"

#include <catch2/catch.hpp>

using namespace nezumi;

namespace {

// The key at the front and how many bytes it took.
std::pair<int, std::size_t> key_of(std::string_view typed, bool alone = false) {
    const TypedKey key = next_key(typed, alone);
    return {key.key ? static_cast<int>(*key.key) : key.interrupt ? -2 : -1, key.size};
}
std::pair<int, std::size_t> took(Key key, std::size_t size) { return {static_cast<int>(key), size}; }
constexpr int other = -1;
constexpr int interrupt = -2;

}  // namespace

TEST_CASE("arrow keys are recognised in both modes of a terminal, also with Shift", "[console][tty]") {
    CHECK(key_of("\x1b[A") == took(Key::up, 3));
    CHECK(key_of("\x1bOB") == took(Key::down, 3));
    CHECK(key_of("\x1b[1;2Cx") == took(Key::right, 6));
    CHECK(key_of("\x1b[D\x1b[D") == took(Key::left, 3));
    CHECK(key_of(" ") == took(Key::space, 1));
    CHECK(key_of("+") == took(Key::faster, 1));
    CHECK(key_of("-") == took(Key::slower, 1));
    CHECK(key_of("x") == std::pair{other, std::size_t{1}});
    CHECK(key_of("\x1b[3~") == std::pair{other, std::size_t{4}});
    CHECK(key_of("\x03") == std::pair{interrupt, std::size_t{1}});
}

TEST_CASE("an Escape is a key of its own only when nothing follows it", "[console][tty]") {
    CHECK(key_of("\x1b").second == 0);
    CHECK(key_of("\x1b[").second == 0);
    CHECK(key_of("\x1bO").second == 0);
    CHECK(key_of("\x1b", true) == took(Key::escape, 1));
    CHECK(key_of("\x1b\x1b[A") == took(Key::escape, 1));
}

TEST_CASE("characters are decoded from bytes that come one by one", "[console][tty]") {
    std::string typed = "\xE2\x86";
    CHECK_FALSE(take_character(typed));
    typed += "\x92z";
    CHECK(take_character(typed) == wchar_t{0x2192});
    CHECK(take_character(typed) == L'z');
    CHECK_FALSE(take_character(typed));
}

TEST_CASE("invalid UTF-8 becomes a replacement character, and the following text is kept", "[console][tty]") {
    CHECK(to_wide("\xFF\xC3z") == L"\xFFFD\xFFFDz");
    CHECK(to_wide("\xC0\xAF") == L"\xFFFD\xFFFD");
    CHECK(to_wide("\xED\xA0\x80") == L"\xFFFD");
    CHECK(to_wide("a\xE2\x86") == L"a\xFFFD");
    CHECK(to_utf8(to_wide("\xF0\x9F\x90\xAD mouse \xC3\xBC \xE2\x86\x92")) ==
          "\xF0\x9F\x90\xAD mouse \xC3\xBC \xE2\x86\x92");
}
