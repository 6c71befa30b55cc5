// Parses two integers with a separator.
#include "bindings/cli/test/parts.hpp"

#include <fmt/format.h>

#include "engine/base/number_in.hpp"

namespace nezumi::cli {
namespace {

template <class Number>
bool read_two(std::string_view text, std::string_view between, Number& first, Number& second) {
    const auto at = text.find(between);
    if (at == std::string_view::npos) return false;
    const auto one = number_in<Number>(text.substr(0, at));
    const auto other = number_in<Number>(text.substr(at + between.size()));
    if (!one || !other) return false;
    first = *one;
    second = *other;
    return true;
}

}  // namespace

Expected<Shard> read_shard(const std::string& text) {
    Shard shard;
    if (text.empty()) return shard;
    constexpr std::size_t most = 1'000'000;
    const bool fits = read_two(text, "/", shard.index, shard.count);
    if (fits && shard.index >= 1 && shard.index <= shard.count && shard.count <= most) return shard;
    return failure(
        fmt::format("--shard: expected a part K/N with K from 1 to N, as in 2/5, got '{}'", nezumi::shown(text)));
}

Expected<std::optional<SeedRange>> read_seeds(const std::string& text) {
    SeedRange seeds;
    if (text.empty()) return std::nullopt;
    if (read_two(text, "..", seeds.first, seeds.last) && seeds.first <= seeds.last &&
        seeds.last - seeds.first < most_runs)
        return seeds;
    return failure(fmt::format("--seeds: expected the first and the last of at most {} seeds, as in 1..250, got '{}'",
                               most_runs, nezumi::shown(text)));
}

Expected<void> refuse_given(const GivenOptions& options, std::string_view why) {
    for (const auto& [option, given] : options) {
        if (given) return failure(fmt::format("{}: leave out {}", why, option));
    }
    return {};
}

}  // namespace nezumi::cli
