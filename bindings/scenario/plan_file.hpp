// The plan of a session in parts, stored beside the results: it lists all runs of all parts, for merging.
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
    /// All runs of all parts. Scenarios have only their names, locations and `paired`; values only their texts.
    TestPlan plan;
    std::uint64_t made_with = 0;  ///< `fingerprint`
    std::uint64_t seed = 0;
    std::uint64_t repeat = 1;
    std::uint64_t shards = 1;
    std::string words;  ///< options that are needed to repeat a run, besides its name and seed
};

/// Convert a plan to bytes and back. `plan_from_bytes` returns nothing for bytes that `to_bytes` did not make.
std::string to_bytes(const KeptPlan& kept);
std::optional<KeptPlan> plan_from_bytes(std::string_view bytes);

/// Writes the plan beside the results of this part. Removes an old plan with other runs.
Expected<void> keep_plan(const std::filesystem::path& folder, const Shard& shard, const KeptPlan& plan);

/// The common plan of all these folders. The error names a folder without a plan, with another plan, or one that is
/// given twice.
Expected<KeptPlan> find_plan(const std::vector<std::filesystem::path>& folders);

}  // namespace nezumi
