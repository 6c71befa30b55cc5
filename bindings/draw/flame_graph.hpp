// Flame graphs: what took how long, by what called it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nezumi::draw {

/// A box of a flame graph.
struct FlameBox {
    std::size_t parent = 0;  ///< index of an earlier box; the first box is the root, its own parent
    std::string name{};
    double own = 0;  ///< [s] without its children
};

/// A drawing as SVG, whose boxes show their time when the pointer is on them.
std::string flame_svg(const std::vector<FlameBox>& boxes, const std::string& title);

/// The drawing as JSON of trace events, which speedscope and Perfetto open: one event for each box, as long as it took
/// in all.
std::string flame_json(const std::vector<FlameBox>& boxes);

}  // namespace nezumi::draw
