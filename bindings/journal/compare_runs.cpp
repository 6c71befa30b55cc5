// Both runs are performed tick by tick. The values are compared only in the tick in which the trace hashes become
// different.
#include "bindings/journal/compare_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "engine/values/value_text.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {
namespace {

constexpr std::size_t most_values = 20;  // largest number of values in a difference

struct Leaf {
    std::string text;
    std::optional<double> number;
};
using Leaves = std::map<std::string, Leaf>;

Leaves leaves_of(const Value* value) {
    Leaves leaves;
    if (value == nullptr) return leaves;
    visit_leaves(*value, [&](const LeafPath& path, const ValueView& leaf) {
        Leaf& made = leaves[path.text()];
        if (leaf.type->is_number())
            made.number = visit_number(leaf, [](const auto& number) { return static_cast<double>(number); });
        made.text = lua_text(leaf);
    });
    if (leaves.empty()) leaves[""].text = short_text(*value);
    return leaves;
}

// The value that a port published in this tick; nothing if it published nothing.
std::optional<Value> published_in(const Port* port, std::int64_t tick) {
    const auto* out = dynamic_cast<const OutPortBase*>(port);
    if (out == nullptr || out->latched_tick() != tick) return std::nullopt;
    return out->value();
}

}  // namespace

std::vector<DifferingValue> differing_values(const std::string& port, const Value* first, const Value* second,
                                             double tolerance) {
    std::vector<DifferingValue> found;
    if (first != nullptr && second != nullptr && is_equal(*first, *second)) return found;
    const Leaves a = leaves_of(first), b = leaves_of(second);
    std::set<std::string> parts;
    for (const Leaves* each : {&a, &b}) {
        for (const auto& [part, leaf] : *each) parts.insert(part);
    }
    bool all_same = true;
    for (const std::string& part : parts) {
        const auto in_a = a.find(part), in_b = b.find(part);
        DifferingValue value{.name = fmt::format("{}{}{}", port, part.empty() || part.front() == '[' ? "" : ".", part),
                             .first = in_a != a.end() ? in_a->second.text : "nothing",
                             .second = in_b != b.end() ? in_b->second.text : "nothing",
                             .by = {}};
        if (value.first == value.second) continue;
        all_same = false;
        if (in_a != a.end() && in_b != b.end() && in_a->second.number && in_b->second.number)
            value.by = std::abs(*in_a->second.number - *in_b->second.number);
        if (value.by && *value.by <= tolerance) continue;
        found.push_back(std::move(value));
    }
    // Bytes, such as pixels, are not leaves: if all leaves are equal, they differ.
    if (all_same && first != nullptr && second != nullptr)
        found.push_back({port, short_text(*first), short_text(*second), {}});
    return found;
}

namespace {

class Comparison {
public:
    Comparison(const RunningSystem& first, const RunningSystem& second, RunDifference& found)
        : first_(first.system()), second_(second.system()), found_(found) {}

    void compare() {
        std::set<std::string> names;
        for (const System* system : {&first_, &second_}) {
            for (const auto& component : system->components()) {
                for (const auto& port : std::as_const(*component).out_ports()) {
                    const std::string name = path(*component, *port);
                    if (names.insert(name).second && differs(name) && found_.component.empty() &&
                        component->script_file() != nullptr)
                        found_.component = component->name();
                }
            }
        }
    }

private:
    // The port with this name; null if there is none.
    static const Port* find(const System& system, const std::string& name) {
        const auto port = system.port(name);
        return port ? *port : nullptr;
    }

    bool differs(const std::string& port) {
        const auto first = published_in(find(first_, port), found_.when.tick);
        const auto second = published_in(find(second_, port), found_.second_when.tick);
        std::vector<DifferingValue> values =
            differing_values(port, first ? &*first : nullptr, second ? &*second : nullptr, 0);
        for (DifferingValue& each : values) add(std::move(each));
        return !values.empty();
    }

    void add(DifferingValue value) {
        if (found_.values.size() < most_values) {
            found_.values.push_back(std::move(value));
        } else {
            ++found_.more_values;
        }
    }

    const System& first_;
    const System& second_;
    RunDifference& found_;
};

std::vector<std::string> lines_of(const TracedLines& traced) {
    std::vector<std::string> lines;
    for (const TracedLines::Line& line : traced.lines) {
        std::string text = fmt::format("{}:{}  {}", line.file, line.line, line.text);
        for (const TracedLines::Value& value : line.values) text += fmt::format("   {} = {}", value.name, value.text);
        lines.push_back(std::move(text));
    }
    return lines;
}

}  // namespace

Expected<std::vector<std::string>> traced_lines(RunningSystem& live, const ActTime& before,
                                                const std::string& component) {
    if (auto there = live.act(Seek{.branch = {}, .tick = before.tick, .start = before.start}, {}); !there)
        return Unexpected(there.error());
    live.repeat_known();  // the component may have been added just before this tick
    return lines_of_next_tick(live, component);
}

Expected<std::vector<std::string>> lines_of_next_tick(RunningSystem& live, const std::string& component) {
    const auto number = live.explain_next(component);
    if (!number) return Unexpected(number.error());
    live.tick();
    const auto explanation = live.explanation(component, *number);
    if (!explanation) return Unexpected(explanation.error());
    return *explanation ? lines_of((*explanation)->traced) : std::vector<std::string>();
}

std::vector<DifferingLine> differing_lines(const std::vector<std::string>& first,
                                           const std::vector<std::string>& second) {
    const auto [a, b] = std::mismatch(first.begin(), first.end(), second.begin(), second.end());
    const auto [a_end, b_end] =
        std::mismatch(first.rbegin(), std::make_reverse_iterator(a), second.rbegin(), std::make_reverse_iterator(b));
    std::vector<DifferingLine> lines;
    for (auto each = a; each != a_end.base(); ++each) lines.push_back({true, *each});
    for (auto each = b; each != b_end.base(); ++each) lines.push_back({false, *each});
    return lines;
}

namespace {

// The files with different texts; a file that only one of the runs has read is one of them.
std::vector<std::string> differing_files(const RunningSystem& first, const RunningSystem& second) {
    std::map<std::string, std::pair<std::optional<std::string>, std::optional<std::string>>> texts;
    for (const auto& [path, seen] : first.history().files()) {
        if (seen.text) texts[first.project().shown(path)].first = seen.text;
    }
    for (const auto& [path, seen] : second.history().files()) {
        if (seen.text) texts[second.project().shown(path)].second = seen.text;
    }
    std::vector<std::string> differ;
    for (const auto& [name, text] : texts) {
        if (text.first != text.second) differ.push_back(name);
    }
    return differ;
}

}  // namespace

Expected<RunComparison> compare_runs(Replay& first, RunningSystem& of_first, Replay& second, RunningSystem& of_second) {
    RunComparison comparison{.files = differing_files(of_first, of_second)};
    of_first.activate();
    of_second.activate();
    for (;;) {
        const auto first_goes_on = first.before_tick(of_first);
        if (!first_goes_on) return Unexpected(first_goes_on.error());
        const auto second_goes_on = second.before_tick(of_second);
        if (!second_goes_on) return Unexpected(second_goes_on.error());
        if (!*first_goes_on || !*second_goes_on) {
            for (auto [replay, live, goes_on] :
                 {std::tuple(&first, &of_first, *first_goes_on), std::tuple(&second, &of_second, *second_goes_on)}) {
                while (goes_on) {
                    live->tick();
                    const auto more = replay->before_tick(*live);
                    if (!more) return Unexpected(more.error());
                    goes_on = *more;
                }
            }
            comparison.first_end = of_first.system().now().seconds;
            comparison.second_end = of_second.system().now().seconds;
            return comparison;
        }
        const RunDifference here{
            .when = of_first.when(), .second_when = of_second.when(), .seconds = of_first.system().now().seconds};
        of_first.tick();
        of_second.tick();
        if (of_first.trace_hash() == of_second.trace_hash()) continue;
        RunDifference& found = comparison.difference.emplace(here);
        Comparison(of_first, of_second, found).compare();
        if (found.component.empty()) return comparison;
        const auto lines = traced_lines(of_first, found.when, found.component);
        const auto other_lines = traced_lines(of_second, found.second_when, found.component);
        if (lines && other_lines) found.lines = differing_lines(*lines, *other_lines);
        return comparison;
    }
}

}  // namespace nezumi
