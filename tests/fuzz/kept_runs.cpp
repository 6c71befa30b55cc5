// Results and plans as other machines have kept them: read whole or not at all, and written again as they were.
#include <cstdint>
#include <string_view>

#include "bindings/scenario/plan_file.hpp"
#include "bindings/scenario/run_result.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (const auto result = from_bytes(bytes)) {
        require(result->outcome <= RunOutcome::could_not_run);
        require(to_bytes(*result) == bytes);
    }
    if (const auto plan = plan_from_bytes(bytes)) {
        require(plan->repeat > 0 && plan->shards > 0);
        for (const PlannedRun& run : plan->plan.runs) {
            require(run.file < plan->plan.files.size());
            require(run.scenario < plan->plan.files[run.file].scenarios.size());
        }
        require(to_bytes(*plan) == bytes);
    }
    return 0;
}
