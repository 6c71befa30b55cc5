// Matches Lua's patterns with a limited number of steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nezumi {

/// A capture of a pattern: a part of the subject, or a position in it.
struct PatternCapture {
    const char* start = nullptr;
    std::size_t length = 0;
    enum class Kind : unsigned char { text, position, open } kind = Kind::open;
};

/// One subject and one pattern. Backtracks like Lua's own matcher, so results and errors are the same. Every step is
/// counted, because backtracking can take very long. Calls no Lua and raises no error.
class PatternMatcher {
public:
    static constexpr int captures_limit = 32;
    static constexpr int depth_limit = 200;

    /// `steps` is counted down. The texts must outlive the matcher. A '^' at the start must have been removed.
    PatternMatcher(std::string_view subject, std::string_view pattern, std::int64_t& steps)
        : subject_(subject), pattern_(pattern), steps_(steps) {}

    /// Matches at exactly this place in the subject. Returns the end of the match, or null; then `error` may have the
    /// reason.
    const char* match_at(const char* place);

    int capture_count() const { return capture_count_; }
    const PatternCapture& capture(int index) const {
        return captures_[index];
    }  ///< index from 0, below `capture_count`

    /// Null if nothing is wrong; otherwise a text for luaL_error with at most one %d, for `error_number`.
    const char* error() const { return error_; }
    int error_number() const { return error_number_; }

    const char* subject_begin() const { return subject_.data(); }
    const char* subject_end() const { return subject_.data() + subject_.size(); }

private:
    const char* pattern_end() const { return pattern_.data() + pattern_.size(); }
    const char* fail(const char* error, int number = 0);
    const char* match(const char* s, const char* p);
    const char* match_items(const char* s, const char* p);
    const char* match_special(const char* s, const char* p);
    const char* match_longest(const char* s, const char* p, const char* after, std::ptrdiff_t at_least);
    const char* match_shortest(const char* s, const char* p, const char* after);
    const char* match_balance(const char* s, const char* p);
    const char* match_frontier(const char* s, const char* p);
    const char* match_repeat(const char* s, const char* p);
    const char* open_capture(const char* s, const char* p, PatternCapture::Kind kind);
    const char* close_capture(const char* s, const char* p);
    const char* item_end(const char* p);
    bool item_matches(const char* s, const char* p, const char* after) const;
    bool take_steps(std::int64_t count);

    std::string_view subject_;
    std::string_view pattern_;
    std::int64_t& steps_;
    int depth_ = 0;
    int capture_count_ = 0;
    const char* error_ = nullptr;
    int error_number_ = 0;
    PatternCapture captures_[captures_limit];
};

}  // namespace nezumi
