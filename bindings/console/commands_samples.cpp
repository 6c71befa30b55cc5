// The command `samples`: gives recent values as a table, for programs.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "engine/trace/series.hpp"

namespace nezumi {

/// The result of `samples`.
struct PortSamples {
    static constexpr std::string_view type_name = "samples";
    std::vector<std::string> labels;        ///< of the values: "vx", "[1]", "" for a single one
    std::vector<std::string> texts;         ///< all texts; in `rows`, a text is its index in this list, from 1
    std::vector<bool> are_texts;            ///< for each label: its values are texts
    std::vector<std::vector<double>> rows;  ///< stamp [s] and values, the oldest first
};

namespace {

// At most the last `most` samples after `since` [s].
PortSamples samples_of(const Series& series, double since, std::size_t most) {
    PortSamples samples{.labels = series.labels(), .texts = series.texts(), .are_texts = {}, .rows = {}};
    for (std::size_t label = 0; label < samples.labels.size(); ++label)
        samples.are_texts.push_back(series.is_text(label));
    std::size_t first = series.size();
    while (first > 0 && series.size() - first < most && series.seconds(first - 1) > since) --first;
    for (std::size_t sample = first; sample < series.size(); ++sample) {
        std::vector<double> row{series.seconds(sample)};
        for (std::size_t label = 0; label < samples.labels.size(); ++label)
            row.push_back(series.value(sample, label) + (samples.are_texts[label] ? 1 : 0));
        samples.rows.push_back(std::move(row));
    }
    return samples;
}

}  // namespace

Expected<CommandEnd> command_samples(Session::Parts& parts, const Arguments& arguments) {
    if (arguments.count() < 1) return failure("expected a port or \"name.port\", got nothing");
    std::string name;
    if (const auto text = arguments.text(1, "a port"); text) {
        name = *text;
    } else {
        const auto port = parts.objects->to_port(arguments.lua, 1);
        if (!port) return Unexpected(port.error());
        name = port->path();
    }
    const auto since = arguments.has(2) ? arguments.number(2, "seconds") : -std::numeric_limits<double>::infinity();
    if (!since) return Unexpected(since.error());
    const auto most =
        arguments.has(3) ? arguments.number(3, "a number of samples") : std::numeric_limits<double>::infinity();
    if (!most) return Unexpected(most.error());
    if (!(*most >= 1)) return failure("expected at least 1 sample");
    const auto found = parts.live.trace().remember_part(name);
    if (!found) return Unexpected(found.error());
    const auto all = static_cast<double>(found->series->most_samples());
    parts.value = samples_of(*found->series, *since, static_cast<std::size_t>(std::min(*most, all)));
    return CommandEnd::value;
}

}  // namespace nezumi
