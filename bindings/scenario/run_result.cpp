// Lists the fields once, for reading and writing.
#include "bindings/scenario/run_result.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/scenario/archive.hpp"

namespace nezumi {
namespace {

template <class Archive, class Result>
bool all_fields(Archive& archive, Result& result) {
    return archive(result.outcome) && archive(result.error) && archive(result.component_failed) &&
           archive(result.facts) && archive(result.margins) && archive(result.printed) && archive(result.measures) &&
           archive(result.drawn) && archive(result.goldens) && archive(result.coverage) && archive(result.folder) &&
           archive(result.files) && archive(result.reads) && archive(result.seconds) && archive(result.wall_seconds) &&
           archive(result.hash);
}

// Checks values, because bytes from another machine may contain anything.
bool is_possible(const RunResult& result) {
    const auto is_finite = [](const Measure& measure) { return std::isfinite(measure.value); };
    const auto has_finite = [](const ConditionMargin& margin) {
        return std::isfinite(margin.margin.value_or(0)) && std::isfinite(margin.time) &&
               std::isfinite(margin.left.value_or(0));
    };
    return result.outcome <= RunOutcome::could_not_run &&
           std::all_of(result.measures.begin(), result.measures.end(), is_finite) &&
           std::all_of(result.margins.begin(), result.margins.end(), has_finite);
}

}  // namespace

std::string to_bytes(const RunResult& result) {
    ArchiveWriter writer;
    all_fields(writer, result);
    return std::move(writer.bytes);
}

Expected<RunResult> from_bytes(std::string_view bytes) {
    RunResult result;
    ArchiveReader reader{bytes};
    if (!all_fields(reader, result) || !reader.bytes.empty() || !is_possible(result))
        return failure("the run's result is incomplete");
    return result;
}

}  // namespace nezumi
