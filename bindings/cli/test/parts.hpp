// What `nezumi test` is told in two numbers, as parts and seeds, and options that don't go together.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/scenario/result_store.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// Of "2/5"; the whole where it is empty.
Expected<Shard> read_shard(const std::string& text);

/// Of "1..250"; nothing where it is empty.
Expected<std::optional<SeedRange>> read_seeds(const std::string& text);

/// Options that were given, or not.
using GivenOptions = std::vector<std::pair<std::string_view, bool>>;

/// An error that begins with `why` and names the first of these that was given.
Expected<void> refuse_given(const GivenOptions& options, std::string_view why);

}  // namespace nezumi::cli
