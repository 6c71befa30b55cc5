// Looks at every port after every tick, and copies what is new.
#include "bindings/console/history.hpp"

#include <type_traits>

#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

Series::Sample take_sample(const Port& port, std::vector<std::string>* labels) {
    Series::Sample sample{port.tm(), {}};
    std::visit(
        [&](const auto& value) {
            for_each_leaf(value, [&](const std::string& path, const auto& leaf) {
                if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(leaf)>>) {
                    if (sample.values.size() >= History::most_values) return;
                    sample.values.push_back(static_cast<double>(leaf));
                    if (labels != nullptr) labels->push_back(path);
                }
            });
        },
        port.value());
    return sample;
}

}  // namespace

void History::after_tick(const LiveSystem& live) {
    if (looked_for_ != followed_.size()) {
        entries_.clear();
        looked_for_ = followed_.size();
    }
    std::size_t count = 0;
    for (const auto& component : live.system().components())
        count += component->in_ports().size() + component->out_ports().size();
    if (entries_.size() != count) entries_.assign(count, {});
    std::size_t place = 0;
    for (const auto& component : live.system().components()) {
        for (const auto& port : component->in_ports()) look(*component, *port, place++, count <= most_ports);
        for (const auto& port : component->out_ports()) look(*component, *port, place++, count <= most_ports);
    }
}

void History::look(const Component& component, const Port& port, std::size_t place, bool all) {
    Entry& entry = entries_[place];
    if (entry.port != &port || port.count() < entry.count) {
        entry = {&port, component.name() + "." + port.name(), 0, nullptr};
        const bool carries_pictures = port.type() == type_index<CameraImage>();
        if ((all && !carries_pictures) || followed_.contains(entry.path)) entry.series = &series_[entry.path];
    }
    if (entry.series == nullptr || port.count() == entry.count) return;
    entry.count = port.count();
    Series& series = *entry.series;
    Series::Sample sample = take_sample(port, nullptr);
    if (!series.samples.empty() && sample.seconds < series.samples.back().seconds) series.samples.clear();  // a restart
    if (sample.values.size() > series.labels.size()) {
        series.labels.clear();
        take_sample(port, &series.labels);
    }
    series.samples.push_back(std::move(sample));
    if (series.samples.size() > most_samples) series.samples.pop_front();
}

const Series* History::find(const std::string& path) const {
    const auto found = series_.find(path);
    return found == series_.end() ? nullptr : &found->second;
}

}  // namespace nezumi
