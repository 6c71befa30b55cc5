// Columns from left to right in the direction of data flow; backward connections are below all boxes.
#include "bindings/draw/wiring_graph.hpp"

#include <algorithm>
#include <utility>

#include "bindings/draw/canvas.hpp"

namespace nezumi::draw {
namespace {

// [px]
constexpr double margin = 24, row = 18, padding = 10, between_columns = 90, between_boxes = 24, lane = 12;
constexpr double name_size = 14, text_size = 11;

struct Box {
    double x = 0, y = 0, width = 0, height = 0;

    double head() const { return 2 * row + padding / 2; }
    double port_y(std::size_t index) const { return y + head() + (static_cast<double>(index) + 0.5) * row; }
};

Box size_of(const WiringOf::Node& node, Canvas& canvas) {
    const auto width = [&](const std::string& text, double size, bool bold = false) {
        return canvas.text_width(text, size, bold);
    };
    double in = 0, out = 0;
    for (const auto& port : node.ins) in = std::max(in, width(port.name, text_size));
    for (const auto& port : node.outs) out = std::max(out, width(port.name, text_size));
    Box box;
    box.width = std::max({width(node.name, name_size, true), width(node.type + "  " + node.status, text_size),
                          in + out + 2 * padding}) +
                2 * padding;
    box.height = box.head() + static_cast<double>(std::max(node.ins.size(), node.outs.size())) * row + padding / 2;
    return box;
}

// The positions and sizes of the boxes.
std::vector<Box> place(const WiringOf& wiring, Canvas& canvas) {
    const std::vector<std::size_t> columns = columns_of(wiring);
    std::vector<Box> boxes;
    for (const auto& node : wiring.nodes) boxes.push_back(size_of(node, canvas));
    const std::size_t count = columns.empty() ? 0 : *std::max_element(columns.begin(), columns.end()) + 1;
    double x = margin;
    for (std::size_t column = 0; column < count; ++column) {
        double y = margin + 2 * row, widest = 0;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (columns[i] != column) continue;
            boxes[i].x = x;
            boxes[i].y = y;
            y += boxes[i].height + between_boxes;
            widest = std::max(widest, boxes[i].width);
        }
        x += widest + between_columns;
    }
    return boxes;
}

Colour colour_of_status(const std::string& status) {
    if (status == "ERROR") return colour_of("#d6453d");
    return status == "ACTIVE" ? colour_of("#3568c4") : ink::faint;
}

void draw_box(Canvas& canvas, const WiringOf::Node& node, const Box& box) {
    cairo_t* const context = canvas.context();
    const Colour colour = colour_of_status(node.status);
    cairo_rectangle(context, box.x, box.y, box.width, box.height);
    canvas.set(colour.with_alpha(0.07));
    cairo_fill_preserve(context);
    canvas.set(colour);
    cairo_set_line_width(context, 1.5);
    cairo_stroke(context);
    canvas.text(box.x + padding, box.y + row, node.name, name_size, ink::text, 0, true);
    canvas.text(box.x + padding, box.y + row * 1.8, node.type + "  " + node.status, text_size, colour);
    const auto draw_ports = [&](const std::vector<WiringOf::PortOf>& ports, double x, double inwards, double anchor) {
        for (std::size_t i = 0; i < ports.size(); ++i) {
            const Colour ink = ports[i].connected ? ink::text : ink::faint;
            canvas.set(ink);
            cairo_arc(context, x, box.port_y(i), 3, 0, 6.2832);
            cairo_fill(context);
            canvas.text(x + inwards, box.port_y(i) + text_size * 0.35, ports[i].name, text_size, ink, anchor);
        }
    };
    draw_ports(node.ins, box.x, padding, 0);
    draw_ports(node.outs, box.x + box.width, -padding, 1);
}

}  // namespace

WiringOf wiring_of(const RunningSystem& live, std::string title) {
    const System& system = live.system();
    WiringOf wiring{.title = std::move(title)};
    for (const auto& component : system.components()) {
        WiringOf::Node node{.name = component->name(),
                            .type = std::string(component->type()),
                            .status = std::string(to_text(component->state()))};
        for (const auto& port : component->in_ports()) node.ins.push_back({port->name(), !system.peers(*port).empty()});
        for (const auto& port : component->out_ports())
            node.outs.push_back({port->name(), !system.peers(*port).empty()});
        wiring.nodes.push_back(std::move(node));
    }
    // Finds the node and the port of "name.port".
    const auto find = [&](const std::string& path, auto ports) {
        const std::size_t dot = path.find('.');
        std::size_t node = 0, port = 0;
        while (wiring.nodes[node].name != path.substr(0, dot)) ++node;
        while ((wiring.nodes[node].*ports)[port].name != path.substr(dot + 1)) ++port;
        return std::pair{node, port};
    };
    for (const ConnectionSpec& connection : system.connections()) {
        const auto [from, out] = find(connection.from, &WiringOf::Node::outs);
        const auto [to, in] = find(connection.to, &WiringOf::Node::ins);
        wiring.edges.push_back({from, out, to, in});
    }
    return wiring;
}

std::vector<std::size_t> columns_of(const WiringOf& wiring) {
    const std::size_t count = wiring.nodes.size();
    std::vector<std::vector<std::size_t>> next(count);
    for (const auto& edge : wiring.edges) next[edge.from].push_back(edge.to);
    // Depth-first search in the system's order: a connection to a node that was entered and not left yet is a backward
    // one. A node is left after all nodes behind it, so the reverse order of leaving is the order of columns.
    enum class Seen : unsigned char { no, entered, left };
    std::vector<Seen> seen(count, Seen::no);
    std::vector<std::size_t> leaving;
    std::vector<std::vector<std::size_t>> ahead(count);
    struct Step {
        std::size_t node;
        std::size_t tried = 0;
    };
    for (std::size_t start = 0; start < count; ++start) {
        if (seen[start] != Seen::no) continue;
        std::vector<Step> path{{start}};
        seen[start] = Seen::entered;
        while (!path.empty()) {
            Step& step = path.back();
            if (step.tried == next[step.node].size()) {
                seen[step.node] = Seen::left;
                leaving.push_back(step.node);
                path.pop_back();
                continue;
            }
            const std::size_t to = next[step.node][step.tried++];
            if (seen[to] == Seen::entered) continue;
            ahead[step.node].push_back(to);
            if (seen[to] == Seen::no) {
                seen[to] = Seen::entered;
                path.push_back({to});
            }
        }
    }
    std::vector<std::size_t> columns(count, 0);
    for (auto node = leaving.rbegin(); node != leaving.rend(); ++node) {
        for (const std::size_t to : ahead[*node]) columns[to] = std::max(columns[to], columns[*node] + 1);
    }
    return columns;
}

Expected<void> draw_wiring(const WiringOf& wiring, const std::string& file) {
    Canvas measure(file, 1, 1);
    const std::vector<Box> boxes = place(wiring, measure);
    double right = 400, bottom = margin + 2 * row;
    for (const Box& box : boxes) {
        right = std::max(right, box.x + box.width);
        bottom = std::max(bottom, box.y + box.height);
    }
    const auto leads_back = [&](const WiringOf::Edge& edge) { return boxes[edge.to].x <= boxes[edge.from].x; };
    const auto back = std::count_if(wiring.edges.begin(), wiring.edges.end(), leads_back);
    Canvas canvas(file, right + margin + between_columns / 2, bottom + margin + lane * static_cast<double>(back + 1));
    canvas.text(margin, margin + name_size, wiring.title, name_size, ink::text, 0, true);
    for (std::size_t i = 0; i < boxes.size(); ++i) draw_box(canvas, wiring.nodes[i], boxes[i]);

    cairo_t* const context = canvas.context();
    cairo_set_line_width(context, 1.5);
    double below = bottom;
    for (std::size_t i = 0; i < wiring.edges.size(); ++i) {
        const auto& edge = wiring.edges[i];
        const Box &from = boxes[edge.from], &to = boxes[edge.to];
        const double x1 = from.x + from.width, y1 = from.port_y(edge.out), x2 = to.x, y2 = to.port_y(edge.in);
        constexpr double bend = between_columns / 2;
        canvas.set(series_colour(i));
        cairo_move_to(context, x1, y1);
        if (leads_back(edge)) {
            below += lane;
            cairo_curve_to(context, x1 + bend, y1, x1 + bend, below, x1, below);
            cairo_line_to(context, x2, below);
            cairo_curve_to(context, x2 - bend, below, x2 - bend, y2, x2, y2);
        } else {
            cairo_curve_to(context, x1 + bend, y1, x2 - bend, y2, x2, y2);
        }
        cairo_stroke(context);
    }
    return canvas.write();
}

}  // namespace nezumi::draw
