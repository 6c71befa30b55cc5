// The wiring of a system, drawn to a file: a box for each component, a line for each connection.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::draw {

/// What a graph shows: taken from a system at one moment, drawn whenever.
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
        std::size_t from = 0;  ///< node
        std::size_t out = 0;   ///< its port
        std::size_t to = 0;
        std::size_t in = 0;
    };

    std::string title;
    std::vector<Node> nodes;  ///< in the system's order
    std::vector<Edge> edges;
};

WiringOf wiring_of(const RunningSystem& live, std::string title);

/// In which column from the left each node stands: right of all that feed it, but for connections that close a circle,
/// which lead back.
std::vector<std::size_t> columns_of(const WiringOf& wiring);

/// Draws it to a file that ends in .png or .svg. An error says why it can't be written; then there is no file.
Expected<void> draw_wiring(const WiringOf& wiring, const std::string& file);

}  // namespace nezumi::draw
