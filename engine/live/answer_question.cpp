// Answers requests of other hosts: looks up names by the rules of the console, and performs all requests except reads
// as acts.
#include "engine/live/answer_question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "engine/live/help_text.hpp"
#include "engine/live/live_text.hpp"
#include "engine/trace/recent_curves.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

// The largest number of followed channels, so that other hosts can't make a large system remember everything.
constexpr std::size_t most_followed = 2 * Trace::most_ports;
constexpr double longest_curves = 600;  // [s]

// Finds a name in the tree as the console does; `plotted`: also by the shorter names of plots.
Expected<TreeNode> node_at(const TreeNode& tree, const Question& question, bool plotted) {
    Expected<TreeNode> node = tree.child(question.component);
    for (std::string_view rest = question.name; node && !rest.empty();) {
        const std::string_view step = take_step(rest);
        node = plotted ? node->step(step) : node->child(step);
    }
    if (node && plotted && node->kind() == TreeNode::Kind::port) node = node->child("value");
    return node;
}

Expected<PlainData> look_at(const TreeNode& node) {
    using Kind = TreeNode::Kind;
    PlainSnapshot seen;
    Value value;
    switch (node.kind()) {
        case Kind::config: {
            PlainData::Table table;
            std::vector<std::string> names = node.children();
            std::sort(names.begin(), names.end());
            for (std::string& name : names) {
                Value set = to_plain(node.child(name)->parameter()->value, seen.data);
                table.push_back({std::move(name), std::move(set)});
            }
            value = seen.data.add(std::move(table));
            break;
        }
        case Kind::parameter:
        case Kind::truth:
        case Kind::data:
        case Kind::value: {
            auto held = node.value();
            if (!held) return Unexpected(held.error());
            if (auto* plain = std::get_if<PlainSnapshot>(&*held)) {
                seen = std::move(*plain);
                if (!seen.data.values.empty()) value = seen.data.values.front();
            } else if (const auto* typed = std::get_if<Value>(&*held)) {
                value = to_plain(*typed, seen.data);
            }
            break;
        }
        default: break;
    }
    if (seen.whole == 0) seen.whole = seen.data.tables.size();
    seen.data.values = {static_cast<std::int64_t>(node.kind()), static_cast<std::int64_t>(seen.whole),
                        std::move(value)};
    return std::move(seen.data);
}

Expected<PlainData> port_of(const System& system, const std::string& path) {
    const auto port = system.port(path);
    if (!port) return Unexpected(port.error());
    const Value value = (*port)->value();
    return PlainData{
        .values = {(*port)->tm(), static_cast<std::int64_t>((*port)->count()), short_text(value, watch_width)},
        .tables = {}};
}

Expected<PlainData> curves_of(const AskedSystem& asked, const Question& question) {
    const auto& values = question.values.values;
    const auto* seconds = values.size() == 1 ? values.front().get_if<double>() : nullptr;
    if (seconds == nullptr || !(*seconds > 0)) return failure("curves: expected seconds, more than 0");
    if (asked.trace.followed() >= most_followed)
        return failure(fmt::format("curves: this host remembers {} values already, which is the limit", most_followed));
    const auto recent = recent_curves(asked.trace, join_path(question.component, question.name),
                                      std::min(*seconds, longest_curves), asked.tree.system().now().seconds);
    return recent ? Expected<PlainData>(to_plain(*recent)) : Unexpected(recent.error());
}

// The answer of a request that needs no act; nothing for other requests.
std::optional<Expected<PlainData>> seen(const AskedSystem& asked, const Question& question) {
    using What = Question::What;
    const auto with_node = [&](bool plotted, const auto& tell) -> Expected<PlainData> {
        const auto node = node_at(asked.tree, question, plotted);
        if (!node) return Unexpected(node.error());
        return tell(*node);
    };
    const auto text = [](std::string all) { return PlainData{.values = {std::move(all)}, .tables = {}}; };
    switch (question.what) {
        case What::look: return with_node(false, look_at);
        case What::show: return with_node(false, [&](const TreeNode& node) { return text(node_text(node)); });
        case What::help: return with_node(false, [&](const TreeNode& node) { return text(help_text(node)); });
        case What::names:
            return with_node(!question.values.values.empty(), [](const TreeNode& node) {
                return PlainData{.values = {node.children(TreeNode::Called::no), node.children(TreeNode::Called::yes)},
                                 .tables = {}};
            });
        case What::port: return port_of(asked.tree.system(), join_path(question.component, question.name));
        case What::curves: return curves_of(asked, question);
        default: return std::nullopt;
    }
}

// The other port of a connection, by its name on this host.
Expected<std::string> other_port(const Question& question) {
    const auto& values = question.values.values;
    const auto* port = values.size() == 1 ? values.front().get_if<std::string>() : nullptr;
    if (port == nullptr) return failure("expected the name of a port");
    return std::string(host_of(*port) == question.host ? without_host(*port) : *port);
}

Expected<Act> act_of(const Question& question) {
    using What = Question::What;
    const std::string& own = question.component;
    switch (question.what) {
        case What::activate: return Activate{own};
        case What::deactivate: return Deactivate{own};
        case What::reset: return Reset{own};
        case What::use: return Use{own, question.name};
        case What::command: return Command{own, question.name, question.values};
        case What::set: {
            if (question.values.values.size() != 1)
                return failure(fmt::format("parameter '{}': expected one value", shown(question.name)));
            return SetParameter{own, question.name, question.values.values.front()};
        }
        case What::connect:
        case What::disconnect: {
            auto from = other_port(question);
            if (!from) return Unexpected(from.error());
            std::string to = join_path(own, question.name);
            if (question.what == What::connect) return Connect{std::move(*from), std::move(to)};
            return Disconnect{std::move(*from), std::move(to)};
        }
        default: break;
    }
    return failure("unknown request: this host has another version of nezumi");
}

}  // namespace

Expected<PlainData> answer_question(const AskedSystem& asked, const Question& question, bool writable,
                                    const Actor& who) {
    using What = Question::What;
    const System& system = asked.tree.system();
    if (is_remote(question.component)) return failure("expected a component of this host");
    if (const auto component = system.component(question.component); !component) return Unexpected(component.error());
    if (auto answer = seen(asked, question)) return std::move(*answer);
    if (!writable)
        return failure("other hosts can only read: write secret or open = true in network { ... } to let them write");
    const auto wanted = act_of(question);
    if (!wanted) return Unexpected(wanted.error());
    auto done = asked.act(*wanted, who);
    if (!done) return Unexpected(done.error());
    // Answers like the methods of a local component: a command returns its results, `use` the set in use, and a change
    // of the life cycle the new state.
    if (question.what == What::command) return std::move(done->values);
    PlainData after;
    const Component* is_there = system.find(question.component);
    const bool has_text =
        question.what != What::set && question.what != What::connect && question.what != What::disconnect;
    if (is_there == nullptr || !has_text) return after;
    after.values.emplace_back(question.what == What::use ? std::string_view(is_there->set_in_use())
                                                         : to_text(is_there->state()));
    return after;
}

Expected<NodeSnapshot> read_snapshot(PlainData data) {
    const auto& values = data.values;
    const auto* kind = values.size() == 3 ? values[0].get_if<std::int64_t>() : nullptr;
    const auto* whole = values.size() == 3 ? values[1].get_if<std::int64_t>() : nullptr;
    if (kind == nullptr || whole == nullptr || *kind < 0 || *kind > static_cast<int>(TreeNode::Kind::command) ||
        *whole < 0)
        return failure("malformed snapshot");
    NodeSnapshot look{.kind = static_cast<TreeNode::Kind>(*kind),
                      .value = {std::move(data), static_cast<std::size_t>(*whole)}};
    auto& held = look.value.data.values;
    held.erase(held.begin(), held.begin() + 2);
    return look;
}

}  // namespace nezumi
