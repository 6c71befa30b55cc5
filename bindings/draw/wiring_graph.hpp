// A drawing of a system's wiring: a box for each component, a line for each connection.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::draw {

/// The contents of a graph: copied from a system at one moment, so it may be drawn later.
struct WiringOf {
    struct PortOf {
        std::string name;
        bool connected = false;
    };
    struct Node {
        std::string name;
        std::string type;
        std::string status;  ///< "ACTIVE"
        std::vector<PortOf> ins, outs;
    };
    struct Edge {
        std::size_t from = 0;  ///< index of the component that sends
        std::size_t out = 0;   ///< index of its out-port
        std::size_t to = 0;
        std::size_t in = 0;
    };

    std::string title;
    std::vector<Node> nodes;  ///< in the system's order
    std::vector<Edge> edges;
};

WiringOf wiring_of(const RunningSystem& live, std::string title);

/// The column of each box, from the left. A box is right of all its sources. Only a connection that closes a cycle goes
/// back.
std::vector<std::size_t> columns_of(const WiringOf& wiring);

/// Draws the wiring to a file that ends in .png or .svg. The error says why the file can't be written; then there is no
/// file.
Expected<void> draw_wiring(const WiringOf& wiring, const std::string& file);

}  // namespace nezumi::draw
