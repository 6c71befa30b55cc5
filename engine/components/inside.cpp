// Tasks and probes as plain data, which consoles, pages and recordings read.
#include "engine/components/inside.hpp"

#include <algorithm>
#include <utility>

namespace nezumi {
namespace {

// A table of all by name, sorted as every table; `entry_of(part, data)` gives each its entry.
template <class Part, class Entry>
PlainData table_of(std::span<const Part> parts, const Entry& entry_of) {
    PlainData data = PlainData::empty_table();
    for (const Part& part : parts) {
        PlainData::Value entry = entry_of(part, data);
        data.tables.front().emplace_back(part.name, std::move(entry));
    }
    std::sort(data.tables.front().begin(), data.tables.front().end(), [](const auto& a, const auto& b) {
        return std::get<std::string>(a.first) < std::get<std::string>(b.first);
    });
    return data;
}

PlainData::Value add_table(PlainData& data, PlainData::Table table) {
    data.tables.push_back(std::move(table));
    return PlainData::TableRef{data.tables.size() - 1};
}

// The value of a probe, its table put among those of `data`.
PlainData::Value value_in(const Probe& probe, PlainData& data) {
    return probe.value.tables.empty() ? probe.value.values.front() : add_table(data, probe.value.tables.front());
}

}  // namespace

PlainData describe(std::span<const TaskStatus> tasks) {
    return table_of(tasks, [](const TaskStatus& task, PlainData& data) {
        PlainData::Table fields;
        if (!task.waiting.empty()) fields.emplace_back("line", std::int64_t{task.line});
        fields.emplace_back("since", task.since);
        fields.emplace_back("status", task.status);
        if (!task.waiting.empty()) fields.emplace_back("waiting", task.waiting);
        return add_table(data, std::move(fields));
    });
}

PlainData describe(std::span<const Probe> probes, double now) {
    return table_of(probes, [now](const Probe& probe, PlainData& data) {
        PlainData::Value value = value_in(probe, data);
        PlainData::Table fields;
        fields.emplace_back("age", now - probe.tm);
        fields.emplace_back("tm", probe.tm);
        fields.emplace_back("value", std::move(value));
        return add_table(data, std::move(fields));
    });
}

PlainData values_of(std::span<const Probe> probes) { return table_of(probes, value_in); }

}  // namespace nezumi
