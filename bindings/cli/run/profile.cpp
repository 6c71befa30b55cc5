// Components are searched again when the system has changed.
#include "bindings/cli/run/profile.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "bindings/console/profile_text.hpp"
#include "bindings/draw/flame_graph.hpp"
#include "bindings/lua/script/script_component.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

std::string name_of_box(const LineCosts::Node& node) {
    std::string place = fmt::format("{}:{}", node.file, node.line);
    if (node.is_line) return place;
    return node.name.empty() ? place : fmt::format("{} ({})", node.name, place);
}

std::vector<draw::FlameBox> boxes_of(const std::map<std::string, ExecutionProfile>& components) {
    std::vector<draw::FlameBox> boxes{{.parent = 0, .name = "behaviours"}};
    for (const auto& [name, profile] : components) {
        // The root of a component's lines becomes the box of the component.
        const std::size_t first = boxes.size();
        for (const LineCosts::Node& node : profile.lines.nodes()) {
            const bool is_root = boxes.size() == first;
            boxes.push_back({.parent = is_root ? 0 : first + node.parent,
                             .name = is_root ? name : name_of_box(node),
                             .own = static_cast<double>(node.nanoseconds) * 1e-9});
        }
    }
    return boxes;
}

}  // namespace

void RunProfile::measure(const RunningSystem& live) {
    const auto& components = live.system().components();
    if (live.generation() == generation_ && components.size() == count_) return;
    generation_ = live.generation();
    count_ = components.size();
    for (const Component* component : components) {
        const auto* script = dynamic_cast<const ScriptComponent*>(component);
        if (script == nullptr) {
            component->measure_ticks(&natives_[component->name()]);
            continue;
        }
        ExecutionProfile& profile = components_[script->name()];
        profile.by_line = true;
        script->measure_with(&profile);
    }
}

void RunProfile::follow(RunLoop& loop) {
    measure(loop.live());
    loop.before_tick([this, &loop] { measure(std::as_const(loop).live()); });
}

Expected<std::string> RunProfile::finish(const RunningSystem& live) {
    for (const Component* component : live.system().components()) {
        component->measure_ticks(nullptr);
        if (const auto* script = dynamic_cast<const ScriptComponent*>(component)) script->measure_with(nullptr);
    }
    const auto boxes = boxes_of(components_);
    const std::string text =
        file_.ends_with(".json") ? draw::flame_json(boxes) : draw::flame_svg(boxes, "CPU time of behaviours by line");
    if (auto written = write_whole(file_, text); !written) return Unexpected(written.error());
    return cost_table(components_, natives_, live.system().settings().rate);
}

}  // namespace nezumi::cli
