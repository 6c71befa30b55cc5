// Tasks and probes as plain data, which consoles, pages and recordings read.
#include "engine/components/inside.hpp"

#include <algorithm>
#include <utility>

namespace nezumi {
namespace {

// A table of all parts by name, sorted like every table; `entry_of(part, data)` returns the entry of a part.
template <class Part, class Entry>
PlainData table_of(std::span<const Part> parts, const Entry& entry_of) {
    PlainData data = PlainData::empty_table();
    for (const Part& part : parts) {
        Value entry = entry_of(part, data);
        data.tables.front().push_back({part.name, std::move(entry)});
    }
    std::sort(data.tables.front().begin(), data.tables.front().end(), [](const auto& a, const auto& b) {
        return a[0].template get<std::string>() < b[0].template get<std::string>();
    });
    return data;
}

// Returns a probe's value; if it is a table, adds it to `data`.
Value value_in(const Probe& probe, PlainData& data) {
    if (probe.value.tables.empty()) return probe.value.values.front();
    return data.add(probe.value.tables.front());
}

}  // namespace

Value add_frames(const ErrorFrames& frames, PlainData& data) {
    PlainData::Table list;
    for (const ErrorFrames::Frame& frame : frames.all) {
        PlainData::Table locals;
        for (const ErrorFrames::Variable& each : frame.locals) {
            if (!each.value.is_nothing()) locals.push_back({each.name, each.value});
        }
        PlainData::Table fields{{"file", frame.file}, {"line", std::int64_t{frame.line}}};
        fields.push_back({"locals", data.add(std::move(locals))});
        if (!frame.name.empty()) fields.push_back({"name", frame.name});
        list.push_back({static_cast<std::int64_t>(list.size()) + 1, data.add(std::move(fields))});
    }
    return data.add(std::move(list));
}

PlainData describe(std::span<const TaskStatus> tasks) {
    return table_of(tasks, [](const TaskStatus& task, PlainData& data) {
        PlainData::Table fields;
        if (!task.waiting.empty()) fields.push_back({"line", std::int64_t{task.line}});
        fields.push_back({"since", task.since});
        fields.push_back({"status", task.status});
        if (!task.waiting.empty()) fields.push_back({"waiting", task.waiting});
        return data.add(std::move(fields));
    });
}

PlainData describe(std::span<const Probe> probes, double now) {
    return table_of(probes, [now](const Probe& probe, PlainData& data) {
        Value value = value_in(probe, data);
        return data.add({{"age", now - probe.tm}, {"tm", probe.tm}, {"value", std::move(value)}});
    });
}

PlainData values_of(std::span<const Probe> probes) { return table_of(probes, value_in); }

}  // namespace nezumi
