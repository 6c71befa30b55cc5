// Lists the fields once, for reading and writing.
#include "bindings/scenario/run_result.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "bindings/scenario/archive.hpp"

namespace nezumi {
namespace {

template <class Archive, class Result>
bool all_fields(Archive& archive, Result& result) {
    return archive(result.outcome) && archive(result.error.message) && archive(result.error.place.file) &&
           archive(result.error.place.line) && archive(result.error.place.column) && archive(result.error.kind) &&
           archive(result.component_failed) && archive(result.facts) && archive(result.margins) &&
           archive(result.printed) && archive(result.measures) && archive(result.drawn) && archive(result.goldens) &&
           archive(result.coverage) && archive(result.folder) && archive(result.files) && archive(result.reads) &&
           archive(result.seconds) && archive(result.wall_seconds) && archive(result.hash);
}

// Bytes of another machine may contain anything.
bool is_possible(const RunResult& result) {
    const bool known = result.outcome <= RunOutcome::could_not_run && result.error.kind >= Error::Kind::ordinary &&
                       result.error.kind <= Error::Kind::out_of_time;
    const auto is_finite = [](const Measure& measure) { return std::isfinite(measure.value); };
    const auto has_finite = [](const ConditionMargin& margin) {
        return std::isfinite(margin.margin.value_or(0)) && std::isfinite(margin.time) &&
               std::isfinite(margin.left.value_or(0));
    };
    return known && std::all_of(result.measures.begin(), result.measures.end(), is_finite) &&
           std::all_of(result.margins.begin(), result.margins.end(), has_finite);
}

}  // namespace

template <class Archive, class AnyMeasure>
requires std::is_same_v<std::remove_const_t<AnyMeasure>, Measure>
bool each_field(Archive& archive, AnyMeasure& measure) {
    return archive(measure.name) && archive(measure.value) && archive(measure.unit);
}

template <class Archive, class AnyMargin>
requires std::is_same_v<std::remove_const_t<AnyMargin>, ConditionMargin>
bool each_field(Archive& archive, AnyMargin& margin) {
    return archive(margin.kind) && archive(margin.condition) && archive(margin.margin) && archive(margin.unit) &&
           archive(margin.comparison) && archive(margin.time) && archive(margin.left) && archive(margin.why);
}

template <class Archive, class AnyUse>
requires std::is_same_v<std::remove_const_t<AnyUse>, GoldenUse>
bool each_field(Archive& archive, AnyUse& use) {
    return archive(use.file) && archive(use.place.file) && archive(use.place.line) && archive(use.place.column) &&
           archive(use.written);
}

template <class Archive, class AnyValue>
requires std::is_same_v<std::remove_const_t<AnyValue>, DrawnValue>
bool each_field(Archive& archive, AnyValue& value) {
    return archive(value.name) && archive(value.text) && archive(value.number) && archive(value.range.lo) &&
           archive(value.range.hi) && archive(value.range.step) && archive(value.range.whole) && archive(value.choices);
}

template <class Archive, class AnyLine>
requires std::is_same_v<std::remove_const_t<AnyLine>, CoveredLine>
bool each_field(Archive& archive, AnyLine& line) { return archive(line.line) && archive(line.ran); }

template <class Archive, class AnyBranch>
requires std::is_same_v<std::remove_const_t<AnyBranch>, CoveredBranch>
bool each_field(Archive& archive, AnyBranch& branch) {
    return archive(branch.line) && archive(branch.number) && archive(branch.way) && archive(branch.ran);
}

template <class Archive, class AnyFile>
requires std::is_same_v<std::remove_const_t<AnyFile>, FileCoverage>
bool each_field(Archive& archive, AnyFile& file) {
    return archive(file.file) && archive(file.hash) && archive(file.lines) && archive(file.branches);
}

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
