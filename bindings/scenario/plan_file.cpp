// Stores the plan of a session that runs in parts. Each part writes the same bytes to a separate file, so parts may
// share a folder.
#include "bindings/scenario/plan_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>
#include <type_traits>

#include "bindings/scenario/archive.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view plan_magic = "nezumi plan 3\n";
constexpr std::string_view prefix = "plan-";
constexpr std::size_t largest_plan = std::size_t{1} << 30;

// The values of a run as texts.
struct TextPoint {
    std::vector<std::string> names;
    std::vector<std::string> values;
};

template <class T, class Plain>
concept MaybeConst = std::is_same_v<std::remove_const_t<T>, Plain>;

}  // namespace

template <class Archive, MaybeConst<Scenario> T>
bool each_field(Archive& archive, T& scenario) {
    return archive(scenario.name) && archive(scenario.place) && archive(scenario.paired);
}

template <class Archive, MaybeConst<PlannedFile> T>
bool each_field(Archive& archive, T& file) {
    return archive(file.shown) && archive(file.scenarios) && archive(file.errors);
}

namespace {

TextPoint texts_of(const SweepPoint& point) {
    TextPoint texts;
    for (const auto& [name, value] : point) {
        texts.names.push_back(name);
        texts.values.push_back(value.text);
    }
    return texts;
}

void write_run(ArchiveWriter& writer, const PlannedRun& run) {
    writer(static_cast<std::uint64_t>(run.file));
    writer(static_cast<std::uint64_t>(run.scenario));
    writer(run.name);
    writer(run.drawn);
    writer(run.searched);
    writer(run.seed);
    writer(run.repetition.name);
    writer(run.repetition.seed.has_value());
    const TextPoint point = texts_of(run.point);
    writer(point.names);
    writer(point.values);
}

bool read_run(ArchiveReader& reader, const TestPlan& plan, PlannedRun& run) {
    std::uint64_t file = 0, scenario = 0;
    TextPoint point;
    bool has_given_seed = false;
    if (!reader(file) || !reader(scenario) || !reader(run.name) || !reader(run.drawn) || !reader(run.searched) ||
        !reader(run.seed) || !reader(run.repetition.name) || !reader(has_given_seed) || !reader(point.names) ||
        !reader(point.values))
        return false;
    if (has_given_seed) run.repetition.seed = run.seed;
    if (file >= plan.files.size() || scenario >= plan.files[static_cast<std::size_t>(file)].scenarios.size())
        return false;
    if (point.names.size() != point.values.size()) return false;
    run.file = static_cast<std::size_t>(file);
    run.scenario = static_cast<std::size_t>(scenario);
    for (std::size_t i = 0; i < point.names.size(); ++i)
        run.point.emplace_back(point.names[i], SweepValue{.data = {}, .text = point.values[i]});
    return true;
}

std::vector<fs::path> plans_in(const fs::path& folder) {
    std::error_code problem;
    std::vector<fs::path> plans;
    for (fs::directory_iterator entry(ResultStore::folder_in(folder), problem), end; !problem && entry != end;
         entry.increment(problem)) {
        const std::string name = entry->path().filename().string();
        // "plan-1-of-2.new" is not complete: its writer still writes it, or has died.
        if (name.starts_with(prefix) && !name.ends_with(".new")) plans.push_back(entry->path());
    }
    std::sort(plans.begin(), plans.end());
    return plans;
}

}  // namespace

std::string to_bytes(const KeptPlan& kept) {
    ArchiveWriter writer{std::string(plan_magic)};
    writer(kept.made_with);
    writer(kept.seed);
    writer(kept.repeat);
    writer(kept.shards);
    writer(kept.words);
    writer(kept.plan.files);
    writer(static_cast<std::uint64_t>(kept.plan.runs.size()));
    for (const PlannedRun& run : kept.plan.runs) write_run(writer, run);
    return std::move(writer.bytes);
}

std::optional<KeptPlan> plan_from_bytes(std::string_view bytes) {
    if (!bytes.starts_with(plan_magic)) return std::nullopt;
    ArchiveReader reader{bytes.substr(plan_magic.size())};
    KeptPlan kept;
    std::uint64_t runs = 0;
    if (!reader(kept.made_with) || !reader(kept.seed) || !reader(kept.repeat) || !reader(kept.shards) ||
        !reader(kept.words) || !reader(kept.plan.files) || !reader(runs))
        return std::nullopt;
    if (kept.repeat == 0 || kept.shards == 0) return std::nullopt;
    for (; runs > 0; --runs) {
        if (!read_run(reader, kept.plan, kept.plan.runs.emplace_back())) return std::nullopt;
    }
    return reader.bytes.empty() ? std::optional(std::move(kept)) : std::nullopt;
}

Expected<void> keep_plan(const fs::path& folder, const Shard& shard, const KeptPlan& plan) {
    const fs::path there = ResultStore::folder_in(folder);
    std::error_code problem;
    fs::create_directories(there, problem);
    if (problem) return failure(fmt::format("can't be made: {}", problem.message()), {.file = there.string()});
    const std::string bytes = to_bytes(plan);
    for (const fs::path& other : plans_in(folder)) {
        if (read_whole(other, other.string(), largest_plan).value_or("") != bytes) fs::remove(other, problem);
    }
    return write_whole(there / fmt::format("{}{}-of-{}", prefix, shard.index, shard.count), bytes);
}

Expected<KeptPlan> find_plan(const std::vector<fs::path>& folders) {
    std::string first;
    fs::path first_folder;
    std::set<fs::path> known;
    for (const fs::path& folder : folders) {
        std::error_code none;
        if (!known.insert(fs::weakly_canonical(folder, none)).second)
            return failure("is given twice: leave out one of them", {.file = folder.string()});
        const std::vector<fs::path> plans = plans_in(folder);
        if (plans.empty())
            return failure("has no results of nezumi test --shard: expected a folder that it wrote with -o",
                           {.file = folder.string()});
        for (const fs::path& plan : plans) {
            auto bytes = read_whole(plan, plan.string(), largest_plan);
            if (!bytes) return Unexpected(bytes.error());
            if (first.empty()) {
                first = std::move(*bytes);
                first_folder = folder;
            } else if (*bytes != first) {
                return failure(fmt::format("has other runs than {}: merge parts that the same version of nezumi made "
                                           "from the same files, with the same options",
                                           first_folder.string()),
                               {.file = folder.string()});
            }
        }
    }
    auto kept = plan_from_bytes(first);
    if (kept) return std::move(*kept);
    return failure("has no plan that this version of nezumi can read", {.file = first_folder.string()});
}

}  // namespace nezumi
