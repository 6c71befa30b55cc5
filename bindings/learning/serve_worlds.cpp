// Reads commands and writes answers.
#include "bindings/learning/serve_worlds.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <istream>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string_view>
#include <utility>

#include "bindings/learning/world_batch.hpp"
#include "engine/base/json_text.hpp"

namespace nezumi {
namespace {

using Json = nlohmann::ordered_json;

Json parts_to_json(const std::vector<SpacePart>& parts) {
    Json all = Json::array();
    for (const SpacePart& part : parts) {
        Json one{{"name", part.name}, {"count", part.count}};
        if (std::isfinite(part.min)) one["min"] = part.min;
        if (std::isfinite(part.max)) one["max"] = part.max;
        all.push_back(std::move(one));
    }
    return all;
}

Json description(const EnvironmentSpec& spec, const SharedArrays& arrays) {
    Json places = Json::object();
    for (const ArrayPlace& place : arrays.places()) {
        Json shape = Json::array({arrays.worlds()});
        if (place.columns > 0) shape.push_back(place.columns);
        places[place.name] = {{"type", place.type}, {"offset", place.offset}, {"shape", std::move(shape)}};
    }
    return {{"action", parts_to_json(spec.action)},
            {"observation", parts_to_json(spec.observation)},
            {"ticks", spec.ticks},
            {"limit", spec.limit},
            {"bytes", arrays.size()},
            {"arrays", std::move(places)}};
}

// A whole number, and the rest of the text after one space.
std::optional<std::uint64_t> take_number(std::string_view& text) {
    std::uint64_t number = 0;
    const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    const std::size_t used = static_cast<std::size_t>(rest - text.data());
    if (problem != std::errc() || (used < text.size() && text[used] != ' ')) return std::nullopt;
    text.remove_prefix(std::min(used + 1, text.size()));
    return number;
}

Expected<void> answer(std::string_view line, WorldBatch& batch, const std::string& version) {
    const std::string_view word = line.substr(0, line.find(' '));
    std::string_view rest = line.substr(std::min(line.size(), word.size() + 1));
    if (word == "step" && rest.empty()) return batch.step();
    if (word == "reload" && rest.empty()) return batch.reload();
    if (word == "reset" && rest.empty()) return batch.reset(std::nullopt);
    const auto number = take_number(rest);
    if (word == "reset" && number && rest.empty()) return batch.reset(number);
    if (word == "save" && number && !rest.empty()) return batch.save(*number, rest, version);
    return failure(fmt::format("expected step, reset [SEED], reload or save WORLD FILE, got '{}'", shown(line)));
}

}  // namespace

Expected<void> serve_worlds(const EpisodePlan& plan, const ServedWorlds& served, std::istream& in, std::ostream& out) {
    const auto file = EnvironmentFile::read(plan.source, plan.project, 0, plan.print);
    if (!file) return Unexpected(file.error());
    const auto arrays = SharedArrays::map(served.memory, (*file)->spec(), served.worlds);
    if (!arrays) return Unexpected(arrays.error());
    WorldBatch batch(plan, *arrays, served.first, served.count);
    out << json_text(description((*file)->spec(), *arrays)) << std::endl;
    for (std::string line; std::getline(in, line);) {
        const auto done = answer(line, batch, served.version);
        out << (done ? "{}" : json_text(Json{{"error", describe(done.error())}})) << std::endl;
    }
    return {};
}

}  // namespace nezumi
