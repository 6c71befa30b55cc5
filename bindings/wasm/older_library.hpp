// Parts of C++20 (libc++ 13) and of Linux that emscripten's libraries lack. Included before every file of the web
// build.
#pragma once

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>
#include <system_error>
#include <type_traits>

#define RENAME_NOREPLACE 1
extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags);

namespace std {

template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>) To
    bit_cast(const From& from)
noexcept {
    To to;
    memcpy(&to, &from, sizeof to);
    return to;
}

/// As the standard's `from_chars` with `chars_format::general`: decimal, no space, no plus sign.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const char* begin = first;
    if (begin != last && *begin == '-') ++begin;
    const bool is_word = begin != last && (*begin == 'i' || *begin == 'I' || *begin == 'n' || *begin == 'N');
    if (begin == last || !(is_word || *begin == '.' || (*begin >= '0' && *begin <= '9')))
        return {first, errc::invalid_argument};
    string text(first, last);
    if (const size_t hex = text.find_first_of("xX"); hex != string::npos) text.resize(hex);
    char* end = nullptr;
    errno = 0;
    const double read = strtod(text.c_str(), &end);
    if (end == text.c_str()) return {first, errc::invalid_argument};
    const char* stop = first + (end - text.c_str());
    if (errno == ERANGE) return {stop, errc::result_out_of_range};
    value = read;
    return {stop, errc()};
}

/// The algorithms that nezumi uses, without projections.
namespace ranges {

template <class Range, class Predicate>
bool any_of(const Range& range, Predicate predicate) {
    return std::any_of(std::begin(range), std::end(range), predicate);
}
template <class One, class Other, class Predicate>
bool equal(const One& one, const Other& other, Predicate predicate) {
    return std::equal(std::begin(one), std::end(one), std::begin(other), std::end(other), predicate);
}
template <class Range, class Value>
auto find(Range& range, const Value& value) {
    return std::find(std::begin(range), std::end(range), value);
}
template <class Range, class Out>
void copy(const Range& range, Out out) {
    std::copy(std::begin(range), std::end(range), out);
}
template <class Range, class Out>
void move(Range& range, Out out) {
    std::move(std::begin(range), std::end(range), out);
}

}  // namespace ranges

}  // namespace std
