// A backtracking matcher for Lua's patterns.
#include "bindings/lua/sandbox/pattern.hpp"

#include <cstring>

namespace nezumi {
namespace {

bool is_between(unsigned char c, unsigned char low, unsigned char high) { return c >= low && c <= high; }
bool is_lower(unsigned char c) { return is_between(c, 'a', 'z'); }
bool is_upper(unsigned char c) { return is_between(c, 'A', 'Z'); }
bool is_digit(unsigned char c) { return is_between(c, '0', '9'); }
bool is_letter(unsigned char c) { return is_lower(c) || is_upper(c); }
unsigned char to_lower(unsigned char c) { return is_upper(c) ? static_cast<unsigned char>(c + ('a' - 'A')) : c; }

// Whether `c` belongs to the class %name. Only ASCII, because a match must not depend on the language of the machine.
bool class_matches(unsigned char c, unsigned char name) {
    bool belongs = false;
    switch (to_lower(name)) {
        case 'a': belongs = is_letter(c); break;
        case 'c': belongs = c < 32 || c == 127; break;
        case 'd': belongs = is_digit(c); break;
        case 'g': belongs = is_between(c, 33, 126); break;
        case 'l': belongs = is_lower(c); break;
        case 'p': belongs = is_between(c, 33, 126) && !is_letter(c) && !is_digit(c); break;
        case 's': belongs = c == ' ' || is_between(c, '\t', '\r'); break;
        case 'u': belongs = is_upper(c); break;
        case 'w': belongs = is_letter(c) || is_digit(c); break;
        case 'x': belongs = is_digit(c) || is_between(to_lower(c), 'a', 'f'); break;
        case 'z': belongs = c == 0; break;  // undocumented, but Lua still has it
        default: return c == name;
    }
    return is_upper(name) ? !belongs : belongs;
}

// Whether `c` is in the set [...] that begins at `p` and ends with ']' at `close`.
bool set_matches(unsigned char c, const char* p, const char* close) {
    bool found = true;
    ++p;
    if (*p == '^') {
        found = false;
        ++p;
    }
    while (p < close) {
        if (*p == '%') {
            if (class_matches(c, static_cast<unsigned char>(p[1]))) return found;
            p += 2;
        } else if (p[1] == '-' && p + 2 < close) {
            if (is_between(c, static_cast<unsigned char>(p[0]), static_cast<unsigned char>(p[2]))) return found;
            p += 3;
        } else {
            if (static_cast<unsigned char>(*p) == c) return found;
            ++p;
        }
    }
    return !found;
}

// Number of steps for comparing one character with the item from `p` to `after`; a long set takes more.
std::int64_t item_cost(const char* p, const char* after) { return 1 + (after - p) / 4; }

}  // namespace

const char* PatternMatcher::match_at(const char* place) {
    capture_count_ = 0;
    depth_ = 0;
    return match(place, pattern_.data());
}

const char* PatternMatcher::fail(const char* error, int number) {
    if (error_ == nullptr) {
        error_ = error;
        error_number_ = number;
    }
    return nullptr;
}

bool PatternMatcher::take_steps(std::int64_t count) {
    steps_ -= count;
    if (steps_ >= 0) return true;
    fail("pattern too complex: it takes too many steps");
    return false;
}

const char* PatternMatcher::match(const char* s, const char* p) {
    if (depth_ == depth_limit) return fail("pattern too complex");
    ++depth_;
    const char* end = match_items(s, p);
    --depth_;
    return end;
}

// Single characters without a repetition need no backtracking, so this loops over them; other items recurse.
const char* PatternMatcher::match_items(const char* s, const char* p) {
    for (;;) {
        if (error_ != nullptr || !take_steps(1)) return nullptr;
        if (p == pattern_end()) return s;
        switch (*p) {
            case '(':
            case ')': return match_special(s, p);
            case '$':
                if (p + 1 == pattern_end()) return s == subject_end() ? s : nullptr;
                break;
            case '%':
                if (p + 1 < pattern_end() &&
                    (p[1] == 'b' || p[1] == 'f' || is_digit(static_cast<unsigned char>(p[1])))) {
                    return match_special(s, p);
                }
                break;
            default: break;
        }
        const char* after = item_end(p);
        if (after == nullptr || !take_steps(item_cost(p, after))) return nullptr;
        const bool matches = item_matches(s, p, after);
        switch (after < pattern_end() ? *after : '\0') {
            case '?': {
                if (matches) {
                    const char* end = match(s + 1, after + 1);
                    if (end != nullptr || error_ != nullptr) return end;
                }
                p = after + 1;
                break;
            }
            case '+': return matches ? match_longest(s, p, after, 1) : nullptr;
            case '*': return match_longest(s, p, after, 0);
            case '-': return match_shortest(s, p, after);
            default:
                if (!matches) return nullptr;
                ++s;
                p = after;
        }
    }
}

const char* PatternMatcher::match_special(const char* s, const char* p) {
    if (*p == ')') return close_capture(s, p + 1);
    if (*p == '(') {
        if (p + 1 < pattern_end() && p[1] == ')') return open_capture(s, p + 2, PatternCapture::Kind::position);
        return open_capture(s, p + 1, PatternCapture::Kind::open);
    }
    if (p[1] == 'b') return match_balance(s, p + 2);
    if (p[1] == 'f') return match_frontier(s, p + 2);
    return match_repeat(s, p);
}

const char* PatternMatcher::match_longest(const char* s, const char* p, const char* after, std::ptrdiff_t at_least) {
    const std::int64_t cost = item_cost(p, after);
    std::ptrdiff_t count = 0;
    while (item_matches(s + count, p, after)) {
        if (!take_steps(cost)) return nullptr;
        ++count;
    }
    for (; count >= at_least; --count) {
        const char* end = match(s + count, after + 1);
        if (end != nullptr || error_ != nullptr) return end;
    }
    return nullptr;
}

const char* PatternMatcher::match_shortest(const char* s, const char* p, const char* after) {
    const std::int64_t cost = item_cost(p, after);
    for (;; ++s) {
        if (!take_steps(cost)) return nullptr;
        const char* end = match(s, after + 1);
        if (end != nullptr || error_ != nullptr) return end;
        if (!item_matches(s, p, after)) return nullptr;
    }
}

// %bxy: from an x to the matching y.
const char* PatternMatcher::match_balance(const char* s, const char* p) {
    if (p + 1 >= pattern_end()) return fail("malformed pattern (missing arguments to '%%b')");
    if (s == subject_end() || *s != p[0]) return nullptr;
    std::int64_t open = 0;
    for (const char* at = s; at < subject_end(); ++at) {
        if (*at == p[1] && open > 0) {
            if (--open == 0) return take_steps(at - s) ? match(at + 1, p + 2) : nullptr;
        } else if (*at == p[0]) {
            ++open;
        }
    }
    take_steps(subject_end() - s);
    return nullptr;
}

// %f[set]: between a character outside of the set and one in the set; the ends of the subject count as '\0'.
const char* PatternMatcher::match_frontier(const char* s, const char* p) {
    if (p >= pattern_end() || *p != '[') return fail("missing '[' after '%%f' in pattern");
    const char* after = item_end(p);
    if (after == nullptr) return nullptr;
    const auto before = static_cast<unsigned char>(s == subject_begin() ? '\0' : s[-1]);
    const auto here = static_cast<unsigned char>(s == subject_end() ? '\0' : *s);
    if (set_matches(before, p, after - 1) || !set_matches(here, p, after - 1)) return nullptr;
    return match(s, after);
}

// %1 to %9: the text of a capture again.
const char* PatternMatcher::match_repeat(const char* s, const char* p) {
    const int index = p[1] - '1';
    if (index < 0 || index >= capture_count_ || captures_[index].kind == PatternCapture::Kind::open) {
        return fail("invalid capture index %%%d", index + 1);
    }
    const PatternCapture& again = captures_[index];
    // A captured position has no text; as in Lua, it never matches.
    if (again.kind == PatternCapture::Kind::position) return nullptr;
    if (static_cast<std::size_t>(subject_end() - s) < again.length) return nullptr;
    if (!take_steps(static_cast<std::int64_t>(again.length))) return nullptr;
    if (std::memcmp(again.start, s, again.length) != 0) return nullptr;
    return match(s + again.length, p + 2);
}

const char* PatternMatcher::open_capture(const char* s, const char* p, PatternCapture::Kind kind) {
    if (capture_count_ >= captures_limit) return fail("too many captures");
    captures_[capture_count_++] = {s, 0, kind};
    const char* end = match(s, p);
    if (end == nullptr) --capture_count_;
    return end;
}

const char* PatternMatcher::close_capture(const char* s, const char* p) {
    int index = capture_count_ - 1;
    while (index >= 0 && captures_[index].kind != PatternCapture::Kind::open) --index;
    if (index < 0) return fail("invalid pattern capture");
    captures_[index].kind = PatternCapture::Kind::text;
    captures_[index].length = static_cast<std::size_t>(s - captures_[index].start);
    const char* end = match(s, p);
    if (end == nullptr) captures_[index].kind = PatternCapture::Kind::open;
    return end;
}

// The end of the single-character item at `p`, without its repetition.
const char* PatternMatcher::item_end(const char* p) {
    const char first = *p++;
    if (first == '%') {
        if (p == pattern_end()) return fail("malformed pattern (ends with '%%')");
        return p + 1;
    }
    if (first != '[') return p;
    if (p < pattern_end() && *p == '^') ++p;
    do {  // a ']' in the first place is a normal character
        if (p == pattern_end()) return fail("malformed pattern (missing ']')");
        if (*p++ == '%' && p < pattern_end()) ++p;
    } while (p == pattern_end() || *p != ']');
    return p + 1;
}

bool PatternMatcher::item_matches(const char* s, const char* p, const char* after) const {
    if (s >= subject_end()) return false;
    const auto c = static_cast<unsigned char>(*s);
    switch (*p) {
        case '.': return true;
        case '%': return class_matches(c, static_cast<unsigned char>(p[1]));
        case '[': return set_matches(c, p, after - 1);
        default: return static_cast<unsigned char>(*p) == c;
    }
}

}  // namespace nezumi
