// The width of a box is its time. Its children are above it, the widest first.
#include "bindings/draw/flame_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "engine/base/json_text.hpp"
#include "engine/base/xml_text.hpp"

namespace nezumi::draw {
namespace {

constexpr double flame_width = 1200, flame_row = 18, flame_margin = 10;  // px
constexpr double letter = 7;                                             // px, width of a letter of the font
constexpr double least = 0.3;                                            // px: narrower boxes are left out

struct Placed {
    std::size_t box;
    int depth;
    double from, time;  // [s]
};

// Places the boxes that have a time, parents first.
std::vector<Placed> place(const std::vector<FlameBox>& boxes) {
    if (boxes.empty()) return {};
    std::vector<double> whole(boxes.size());
    std::vector<std::vector<std::size_t>> children(boxes.size());
    for (std::size_t i = boxes.size(); i-- > 0;) {
        whole[i] += boxes[i].own;
        if (i == 0) break;
        whole[boxes[i].parent] += whole[i];
        children[boxes[i].parent].push_back(i);
    }
    std::vector<Placed> placed;
    const std::function<void(std::size_t, int, double)> add = [&](std::size_t i, int depth, double from) {
        if (whole[i] <= 0) return;
        placed.push_back({i, depth, from, whole[i]});
        std::stable_sort(children[i].begin(), children[i].end(),
                         [&](std::size_t a, std::size_t b) { return whole[a] > whole[b]; });
        for (const std::size_t child : children[i]) {
            add(child, depth + 1, from);
            from += whole[child];
        }
    };
    add(0, 0, 0);
    return placed;
}

std::string flame_time(double seconds) {
    return seconds < 1e-3 ? fmt::format("{:.1f} us", seconds * 1e6) : fmt::format("{:.2f} ms", seconds * 1e3);
}

}  // namespace

std::string flame_svg(const std::vector<FlameBox>& boxes, const std::string& title) {
    const auto placed = place(boxes);
    int deepest = 0;
    for (const Placed& each : placed) deepest = std::max(deepest, each.depth);
    const double height = 2 * flame_margin + flame_row * (deepest + 2);
    const double all = placed.empty() ? 1 : placed.front().time;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"monospace\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        "<text x=\"{2}\" y=\"{3}\">{4}</text>\n",
        flame_width + 2 * flame_margin, height, flame_margin, flame_margin + 12, xml_text(title));
    for (const Placed& each : placed) {
        const double wide = flame_width * each.time / all;
        if (wide < least) continue;
        const double x = flame_margin + flame_width * each.from / all,
                     y = height - flame_margin - flame_row * (each.depth + 1);
        const std::string name = xml_text(boxes[each.box].name);
        const auto letters = static_cast<std::size_t>(std::max(0.0, (wide - 6) / letter));
        const std::string& plain = boxes[each.box].name;
        const std::string shown = letters < 3 ? "" : xml_text(plain.substr(0, letters));
        svg += fmt::format(
            "<g><title>{}: {}, {:.1f} %</title><rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{}\" "
            "fill=\"hsl({},80%,70%)\" stroke=\"white\"/><text x=\"{:.2f}\" y=\"{:.1f}\">{}</text></g>\n",
            name, flame_time(each.time), 100 * each.time / all, x, y, wide, flame_row, 20 + (each.box * 37) % 40, x + 3,
            y + 13, shown);
    }
    return svg + "</svg>\n";
}

std::string flame_json(const std::vector<FlameBox>& boxes) {
    std::string json = "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[";
    bool is_first = true;
    for (const Placed& each : place(boxes)) {
        json += fmt::format("{}\n{{\"name\":{},\"ph\":\"X\",\"pid\":1,\"tid\":1,\"ts\":{:.3f},\"dur\":{:.3f}}}",
                            is_first ? "" : ",", json_text(nlohmann::json(boxes[each.box].name)), each.from * 1e6,
                            each.time * 1e6);
        is_first = false;
    }
    return json + "\n]}\n";
}

}  // namespace nezumi::draw
