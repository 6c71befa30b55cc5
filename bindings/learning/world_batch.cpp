// Seeds, truncation and automatic resets of worlds. To save an episode, the batch repeats it with a journal.
#include "bindings/learning/world_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/journal/journal.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {
namespace {

// The seed of a world's next episode. It has 53 bits, which Python, JSON and Lua keep exactly.
std::uint64_t seed_after(std::uint64_t seed) { return mix(seed, "the next episode") >> 11U; }

// Keeps the action within the limits of its parts. An error for a value that is not a number.
Expected<void> limit(std::span<float> action, const std::vector<SpacePart>& parts) {
    std::size_t next = 0;
    for (const SpacePart& part : parts) {
        for (std::size_t i = 0; i < part.count; ++i, ++next) {
            float& value = action[next];
            if (std::isnan(value)) return failure(fmt::format("action '{}' is NaN", part.name));
            value = std::clamp(value, static_cast<float>(part.min), static_cast<float>(part.max));
        }
    }
    return {};
}

}  // namespace

WorldBatch::WorldBatch(EpisodePlan plan, const SharedArrays& arrays, std::size_t first, std::size_t count)
    : plan_(std::make_shared<const EpisodePlan>(std::move(plan))), arrays_(arrays), first_(first), worlds_(count) {}

Expected<void> WorldBatch::each(Expected<void> (WorldBatch::*act)(std::size_t)) {
    Expected<void> result;
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
        auto done = (this->*act)(i);
        if (done) continue;
        World& world = worlds_[i];
        world.over = true;
        world.error = done.error();
        if (result) result = failure(fmt::format("world {}: {}", first_ + i, describe(done.error())));
    }
    return result;
}

Expected<void> WorldBatch::reset(std::optional<std::uint64_t> seed) {
    for (std::size_t i = 0; i < worlds_.size(); ++i)
        worlds_[i].seed = seed ? *seed + first_ + i : seed_after(worlds_[i].seed);
    return each(&WorldBatch::begin);
}

Expected<void> WorldBatch::begin(std::size_t index) {
    World& world = worlds_[index];
    world.episode.reset();
    world.steps = 0;
    world.error.reset();
    world.actions.clear();
    world.plan = plan_;
    const std::size_t at = first_ + index;
    arrays_.seed(at) = world.seed;
    arrays_.reward(at) = 0;
    arrays_.terminated(at) = arrays_.truncated(at) = 0;
    auto episode = Episode::begin(*world.plan, world.seed);
    if (!episode) return Unexpected(episode.error());
    world.episode = std::move(*episode);
    world.over = false;
    return world.episode->observe(arrays_.observation(at));
}

Expected<void> WorldBatch::step() { return each(&WorldBatch::step); }

Expected<void> WorldBatch::step(std::size_t index) {
    World& world = worlds_[index];
    if (world.over) {
        world.seed = seed_after(world.seed);
        return begin(index);
    }
    const std::size_t at = first_ + index;
    const std::span<float> action = arrays_.action(at);
    const EnvironmentSpec& spec = world.episode->spec();
    if (auto ok = limit(action, spec.action); !ok) return ok;
    world.actions.insert(world.actions.end(), action.begin(), action.end());
    const auto result = world.episode->step(action, arrays_.observation(at));
    if (!result) return Unexpected(result.error());
    ++world.steps;
    const bool truncated = spec.limit > 0 && world.steps >= spec.limit && !result->terminated;
    arrays_.reward(at) = result->reward;
    arrays_.terminated(at) = result->terminated ? 1 : 0;
    arrays_.truncated(at) = truncated ? 1 : 0;
    world.over = result->terminated || truncated;
    return {};
}

Expected<void> WorldBatch::reload() {
    const SourceText& now = plan_->source;
    auto text = read_whole(now.path, now.shown);
    if (!text) return Unexpected(text.error());
    auto next = std::make_shared<EpisodePlan>(*plan_);
    next->source.text = std::move(*text);
    const auto read = EnvironmentFile::read(next->source, next->project, 0, next->print);
    if (!read) return Unexpected(read.error());
    const auto before = EnvironmentFile::read(plan_->source, plan_->project, 0, {});
    const auto same = [](const std::vector<SpacePart>& one, const std::vector<SpacePart>& other) {
        return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                          [](const SpacePart& a, const SpacePart& b) {
                              return a.name == b.name && a.count == b.count && a.min == b.min && a.max == b.max;
                          });
    };
    const EnvironmentSpec& spec = (*read)->spec();
    if (!before || !same((*before)->spec().action, spec.action) ||
        !same((*before)->spec().observation, spec.observation))
        return failure(
            "environment: actions and observations can't change while worlds use them: make the environment again",
            spec.place);
    plan_ = std::move(next);
    return {};
}

Expected<void> WorldBatch::save(std::size_t index, const std::filesystem::path& file,
                                const std::string& version) const {
    if (index < first_ || index - first_ >= worlds_.size())
        return failure(fmt::format("this process has no world {}", index));
    const World& world = worlds_[index - first_];
    if (world.episode == nullptr) return failure(fmt::format("world {} has no episode yet", index));
    auto journal = Journal::create(file);
    if (!journal) return Unexpected(journal.error());
    auto again =
        Episode::begin(*world.plan, world.seed, [&](RunningSystem& live) { (*journal)->begin(live, version, false); });
    if (!again) return Unexpected(again.error());
    const EnvironmentSpec& spec = (*again)->spec();
    const std::size_t width = width_of(spec.action);
    std::vector<float> observation(width_of(spec.observation));
    for (std::size_t at = 0; at < world.actions.size(); at += width) {
        const auto result = (*again)->step({world.actions.data() + at, width}, observation);
        if (!result) break;
        (*journal)->serve();
    }
    RunningSystem& live = (*again)->live();
    if (live.trace_hash() != world.episode->live().trace_hash())
        return failure("the episode can't be repeated: files have changed since it began", spec.place);
    (*journal)->end(world.error ? RunEnd::error : RunEnd::duration, world.error ? world.error->message : "",
                    live.when(), live.trace_hash());
    if ((*journal)->error()) return Unexpected(*(*journal)->error());
    return {};
}

}  // namespace nezumi
