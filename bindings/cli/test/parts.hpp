// Parses options of `nezumi test` with two numbers, such as shards and seeds, and checks combinations of options.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/scenario/result_store.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// Parses "2/5"; an empty text stands for all runs.
Expected<Shard> read_shard(const std::string& text);

/// Parses "1..250"; nothing if empty.
Expected<std::optional<SeedRange>> read_seeds(const std::string& text);

/// Options, and whether each was given.
using GivenOptions = std::vector<std::pair<std::string_view, bool>>;

/// Fails if one of these was given; the error begins with `why` and names the first one.
Expected<void> refuse_given(const GivenOptions& options, std::string_view why);

}  // namespace nezumi::cli
