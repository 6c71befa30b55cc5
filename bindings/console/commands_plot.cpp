// The command that draws what was carried lately.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/console_fields.hpp"
#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/live/object_core.hpp"

namespace nezumi {
namespace {

constexpr double usual_seconds = 10;
constexpr double shortest_period = 0.1;  // [s] of simulated time between two drawings

Expected<double> positive(const Value& value, std::string_view what) {
    const auto number = number_of(value);
    if (!number) return failure(fmt::format("expected {}, got {}", what, kind_of(value)));
    if (!(*number > 0)) return failure(fmt::format("expected {}, more than 0, got {}", what, *number));
    return *number;
}

// What an argument `m.truth.pose` has become, { m, ".truth.pose" }.
bool is_path(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TTABLE || lua_checkstack(L, 2) == 0) return false;
    const bool is_one = lua_rawgeti(L, index, 2) == LUA_TSTRING && lua_rawlen(L, index) == 2;
    lua_pop(L, 1);
    return is_one;
}

Expected<std::string> read_path(const Objects& objects, lua_State* L, int index) {
    lua_rawgeti(L, index, 1);
    lua_rawgeti(L, index, 2);
    const std::string path(text_at(L, -1));
    const auto component = objects.to_component(L, -2);
    const auto port = objects.to_port(L, -2);
    const std::string_view kind = luaL_typename(L, -2);
    lua_pop(L, 2);
    if (component) return component->component->name() + path;
    if (port) return port->path() + path;
    return failure(fmt::format("expected a component or a port before {}, got {}", shown(path), kind));
}

// Names first, then how many seconds, then options.
Expected<PlotRequest> read(const Session::Parts& parts, const Arguments& arguments) {
    PlotRequest plot{.seconds = usual_seconds};
    bool has_seconds = false, has_options = false;
    for (int i = 1; i <= arguments.count(); ++i) {
        const int index = arguments.index(i);
        const int type = lua_type(arguments.lua, index);
        const bool names_a_path = is_path(arguments.lua, index);
        const auto value = read_file_value(arguments.lua, index);
        if (type == LUA_TTABLE && !names_a_path && !plot.names.empty() && !std::exchange(has_options, true)) {
            auto check = FieldCheck::of_options(fmt::format("{}", fmt::join(plot.names, ", ")));
            if (auto ok = read_options(arguments.lua, index, std::move(check), plot); !ok)
                return Unexpected(ok.error());
            if (plot.every > 0) plot.every = std::max(plot.every, shortest_period);
        } else if (type == LUA_TNUMBER && !has_options && !std::exchange(has_seconds, true)) {
            const auto seconds = positive(*value, "seconds");
            if (!seconds) return Unexpected(seconds.error());
            plot.seconds = *seconds;
        } else if (has_seconds || has_options) {
            return failure(
                "expected what to draw, then seconds, then options: plot(port, ..., seconds, { every = 1 })");
        } else if (type == LUA_TSTRING) {
            plot.names.push_back(*value->get_if<std::string>());
        } else if (names_a_path) {
            const auto path = read_path(*parts.objects, arguments.lua, index);
            if (!path) return Unexpected(path.error());
            plot.names.push_back(*path);
        } else {
            const auto port = parts.objects->to_port(arguments.lua, index);
            if (!port) return Unexpected(port.error());
            plot.names.push_back(port->path());
        }
    }
    if (plot.names.empty()) return failure("expected a port or \"name.port\", got nothing");
    return plot;
}

// "controller.out" with "vx", "[1]" or "value": what a leaf is called.
std::string full_name(const std::string& whole, const std::string& label) {
    return label == "value" ? whole : join_path(whole, label);
}

constexpr std::string_view marks = "*o+x#%@&";

}  // namespace

Expected<PlotCurves> look_at_plot(RunningSystem& live, const PlotRequest& plot) {
    PlotCurves looked{.plot = plot, .to = live.system().now().seconds};
    double first = looked.to;
    std::vector<Trace::Remembered> all;
    for (std::string& name : looked.plot.names) {
        auto found = live.trace().remember_part(name);
        if (!found) return Unexpected(found.error());
        name = join_path(found->whole, found->part);
        if (found->series->size() > 0) first = std::min(first, found->series->seconds(0));
        const auto& labels = found->series->labels();
        const auto has_part = [&](const std::string& label) { return is_within(label, found->part); };
        if (!labels.empty() && std::none_of(labels.begin(), labels.end(), has_part))
            return failure(fmt::format("{} has no '{}'{}", found->whole, shown(found->part),
                                       did_you_mean(found->part, {labels.begin(), labels.end()})));
        all.push_back(std::move(*found));
    }
    looked.from = std::max(first, looked.to - plot.seconds);
    for (const auto& each : all) {
        auto curves = curves_of(*each.series, each.part, looked.from, looked.to, each.holds);
        if (curves.empty()) looked.silent.push_back(full_name(each.whole, each.part));
        for (Curve& curve : curves) {
            if (plot.names.size() > 1) curve.name = full_name(each.whole, curve.name);
            looked.curves.push_back(std::move(curve));
        }
    }
    return looked;
}

std::string to_text(PlotCurves looked) {
    const auto names = fmt::format("{}", fmt::join(looked.plot.names, ", "));
    if (looked.curves.empty()) return names + " has carried nothing in this time that can be drawn";
    if (looked.plot.names.size() == 1) return names + "\n" + braille_plot(looked.curves, looked.from, looked.to);
    // Several share a drawing, and so a scale.
    std::vector<Curve> drawn;
    std::string texts;
    for (Curve& curve : looked.curves) {
        if (!curve.texts.empty()) {
            texts += (texts.empty() ? "" : "\n") + text_line(curve);
            continue;
        }
        curve.mark = marks[drawn.size() % marks.size()];
        drawn.push_back(std::move(curve));
    }
    for (const std::string& name : looked.silent)
        texts += fmt::format("{}{} has carried nothing in this time", texts.empty() ? "" : "\n", name);
    std::string text = fmt::format("{}", fmt::join(plain_plot(drawn, {.rows = 10}), "\n"));
    return text + (text.empty() || texts.empty() ? "" : "\n") + texts;
}

Expected<CommandEnd> command_plot(Session::Parts& parts, const Arguments& arguments) {
    // What is drawn is a copy: drawing takes longer than a look.
    auto looked = parts.at_system([&]() -> Expected<PlotCurves> {
        const auto plot = read(parts, arguments);
        if (!plot) return Unexpected(plot.error());
        auto curves = look_at_plot(parts.live, *plot);
        if (curves && plot->every > 0) {
            parts.plots.push_back(*plot);
            parts.plots.back().next = curves->to + plot->every;
        }
        return curves;
    });
    if (!looked) return Unexpected(looked.error());
    const bool again = looked->plot.every > 0;
    const std::string text = to_text(std::move(*looked));
    if (again) {
        parts.show_in_place(text);
    } else {
        parts.show(text);
    }
    return CommandEnd::done;
}

}  // namespace nezumi
