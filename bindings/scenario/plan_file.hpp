// The plan of a session in parts, beside their results: what all of them together make, for whoever merges them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/scenario/result_store.hpp"
#include "bindings/scenario/test_plan.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

struct KeptPlan {
    /// All runs, of all parts. Of scenarios only their names, places and `paired` are there, of values only their
    /// texts.
    TestPlan plan;
    std::uint64_t made_with = 0;  ///< `fingerprint`
    std::uint64_t seed = 0;
    std::uint64_t repeat = 1;
    std::uint64_t shards = 1;
    std::string words;  ///< options that repeating a run needs besides its name and seed
};

/// As bytes, and back; nothing when `to_bytes` did not make them.
std::string to_bytes(const KeptPlan& kept);
std::optional<KeptPlan> plan_from_bytes(std::string_view bytes);

/// Writes the plan beside the results of this part. A plan of other runs that is there is of another time, and goes.
Expected<void> keep_plan(const std::filesystem::path& folder, const Shard& shard, const KeptPlan& plan);

/// The plan that all these folders are parts of. An error names a folder that has none, one of other
/// runs, or one that is given twice.
Expected<KeptPlan> find_plan(const std::vector<std::filesystem::path>& folders);

}  // namespace nezumi
