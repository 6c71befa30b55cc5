// A part is written as a fraction.
#include "bindings/cli/test/parts.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

namespace nezumi::cli {

Expected<Shard> read_shard(const std::string& text) {
    Shard shard;
    if (text.empty()) return shard;
    constexpr std::size_t most = 1'000'000;
    const char* const last = text.data() + text.size();
    const auto [slash, first_problem] = std::from_chars(text.data(), last, shard.index);
    bool fits = first_problem == std::errc() && slash != last && *slash == '/';
    if (fits) {
        const auto [end, problem] = std::from_chars(slash + 1, last, shard.count);
        fits = problem == std::errc() && end == last;
    }
    if (fits && shard.index >= 1 && shard.index <= shard.count && shard.count <= most) return shard;
    return failure(
        fmt::format("--shard: expected a part K/N with K from 1 to N, as in 2/5, got '{}'", nezumi::shown(text)));
}

Expected<void> refuse_given(const GivenOptions& options, std::string_view why) {
    for (const auto& [option, given] : options) {
        if (given) return failure(fmt::format("{}: leave out {}", why, option));
    }
    return {};
}

}  // namespace nezumi::cli
