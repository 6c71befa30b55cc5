// The command that plots recent values.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/console_fields.hpp"
#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/watchdog.hpp"

namespace nezumi {
namespace {

constexpr double usual_seconds = 10;
constexpr double shortest_period = 0.1;  // [s] of simulated time between two drawings

Expected<double> positive(const Value& value, std::string_view what) {
    const auto number = number_of(value);
    if (!number) return failure(fmt::format("expected {}, got {}", what, kind_of(value)));
    if (!(*number > 0)) return failure(fmt::format("expected {} greater than 0, got {}", what, *number));
    return *number;
}

// Whether a value is a translated argument { m, ".truth.pose" }, as of `m.truth.pose`.
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
    auto theirs = path_of_host(L, -2, path);
    const auto component = objects.to_component(L, -2);
    const auto port = objects.to_port(L, -2);
    const std::string_view kind = luaL_typename(L, -2);
    lua_pop(L, 2);
    if (theirs) return std::move(*theirs);
    if (component) return component->component->name() + path;
    if (port) return port->path() + path;
    return failure(fmt::format("expected a component or a port before {}, got {}", shown(path), kind));
}

// Names come first, then the seconds, then options.
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
            return failure("expected ports, then seconds, then options: plot(port, ..., seconds, { every = 1 })");
        } else if (type == LUA_TSTRING) {
            plot.names.push_back(*value->get_if<std::string>());
        } else if (names_a_path) {
            const auto path = read_path(*parts.objects, arguments.lua, index);
            if (!path) return Unexpected(path.error());
            plot.names.push_back(*path);
        } else if (auto theirs = port_of_host(arguments.lua, index)) {
            plot.names.push_back(std::move(*theirs));
        } else {
            const auto port = parts.objects->to_port(arguments.lua, index);
            if (!port) return Unexpected(port.error());
            plot.names.push_back(port->path());
        }
    }
    if (plot.names.empty()) return failure("expected a port or \"name.port\", got nothing");
    const TreeNode tree = parts.live.tree();
    for (const std::string& name : plot.names) {
        if (!is_remote(name) || tree.find(name)) continue;
        if (const auto host = find_host(tree.system(), host_of(name)); !host) return Unexpected(host.error());
        plot.elsewhere.try_emplace(name);
    }
    return plot;
}

// The question for the curves of "ev3/vehicle.current_vel.vx", to its host "ev3".
Question question_of(std::string_view name, double seconds) {
    std::string_view part = without_host(name);
    const std::string_view component = take_step(part);
    return {.host = std::string(host_of(name)),
            .component = std::string(component),
            .what = Question::What::curves,
            .name = std::string(part),
            .values = {.values = {seconds}, .tables = {}}};
}

Expected<void> take_answer(PlotRequest::Elsewhere& elsewhere, const Expected<PlainData>& answer) {
    auto recent = answer ? read_curves(*answer) : Unexpected(answer.error());
    if (!recent) return Unexpected(recent.error());
    elsewhere.recent = std::move(*recent);
    return {};
}

// The name of a curve: "controller.out" with "vx" or "[1]"; "value" means the whole port and adds nothing.
std::string full_name(const std::string& whole, const std::string& label) {
    return label == "value" ? whole : join_path(whole, label);
}

constexpr std::string_view marks = "*o+x#%@&";

// Begins to compute the values of a plot that are not in the trace. Null if the trace has all of them.
Expected<std::unique_ptr<PastValues>> begin_earlier(RunningSystem& live, const PlotRequest& plot) {
    const double now = live.system().now().seconds, from = std::max(0.0, now - plot.seconds);
    std::vector<std::string> names;
    bool has_all = true;
    for (const std::string& name : plot.names) {
        if (plot.elsewhere.contains(name)) continue;
        const auto found = live.trace().remember_part(name);
        if (!found) return Unexpected(found.error());
        has_all = has_all && live.trace().has_since(found->name, from);
        names.push_back(found->name);
    }
    if (has_all) return nullptr;
    return PastValues::begin(live, std::move(names), from, now);
}

}  // namespace

Expected<std::string> name_of_value(Session::Parts& parts, const Arguments& arguments, int position) {
    const int index = arguments.index(position);
    if (is_path(arguments.lua, index)) return read_path(*parts.objects, arguments.lua, index);
    if (lua_type(arguments.lua, index) == LUA_TSTRING) return arguments.text(position, "a value");
    if (!arguments.has(position)) return failure("expected a value, as in controller.out.vx, got nothing");
    const auto port = parts.objects->to_port(arguments.lua, index);
    if (!port) return Unexpected(port.error());
    return port->path();
}

Expected<PlotCurves> look_at_plot(RunningSystem& live, const PlotRequest& plot, PastValues* past) {
    const RunningSystem& then = past != nullptr ? past->run().system() : live;
    Trace& trace = past != nullptr ? past->trace() : live.trace();
    PlotCurves looked{.plot = plot, .to = then.system().now().seconds};
    double first = looked.to;
    std::vector<RecentCurves> all;
    for (std::string& name : looked.plot.names) {
        const auto elsewhere = plot.elsewhere.find(name);
        auto recent = elsewhere != plot.elsewhere.end()
                          ? Expected<RecentCurves>(elsewhere->second.recent.value_or(RecentCurves{}))
                          : recent_curves(trace, name, plot.seconds, looked.to);
        if (!recent) return Unexpected(recent.error());
        if (elsewhere == plot.elsewhere.end()) name = join_path(recent->whole, recent->part);
        // Times of other hosts are converted to the time of this system.
        const double ahead = looked.to - recent->now;
        for (Curve& curve : recent->curves) {
            for (auto& point : curve.points) point.first += ahead;
        }
        first = std::min(first, recent->first + ahead);
        all.push_back(std::move(*recent));
    }
    looked.from = std::max(first, looked.to - plot.seconds);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string& name = looked.plot.names[i];
        if (all[i].curves.empty()) looked.silent.push_back(name);
        for (Curve& curve : all[i].curves) {
            if (all.size() > 1) curve.name = full_name(all[i].whole, curve.name);
            looked.curves.push_back(std::move(curve));
        }
    }
    return looked;
}

std::string to_text(PlotCurves looked) {
    const auto names = fmt::format("{}", fmt::join(looked.plot.names, ", "));
    if (looked.curves.empty()) return names + " carried nothing in this time that can be drawn";
    if (looked.plot.names.size() == 1) return names + "\n" + braille_plot(looked.curves, looked.from, looked.to);
    // Several ports are drawn together, with one scale.
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
        texts += fmt::format("{}{} carried nothing in this time", texts.empty() ? "" : "\n", name);
    std::string text = fmt::format("{}", fmt::join(plain_plot(drawn, {.rows = 10}), "\n"));
    return text + (text.empty() || texts.empty() ? "" : "\n") + texts;
}

bool draw_again(Session::Parts& parts, PlotRequest& plot) {
    const double now = parts.live.system().now().seconds;
    if (now < plot.next - plot.every) plot.next = now;  // time has gone back, by a restart or a seek
    if (now < plot.next) return true;
    Expected<void> answered{};
    for (auto& [name, each] : plot.elsewhere) {
        if (each.recent) continue;
        const auto answer = go_on(parts.live.system(), question_of(name, plot.seconds), each.open);
        if (!answer) return true;
        if (answered = take_answer(each, *answer); !answered) break;
    }
    plot.next = now + plot.every;
    auto looked = answered ? look_at_plot(parts.live, plot) : Unexpected(answered.error());
    for (auto& [name, each] : plot.elsewhere) each.recent.reset();
    if (looked) {
        parts.show_in_place(to_text(std::move(*looked)));
    } else {
        parts.show(looked.error().message + ": no longer drawn");
    }
    return looked.has_value();
}

Expected<CommandEnd> command_plot(Session::Parts& parts, const Arguments& arguments) {
    auto plot = parts.at_system([&] { return read(parts, arguments); });
    if (!plot) return Unexpected(plot.error());
    for (auto& [name, each] : plot->elsewhere) {
        const auto answer = ask_host(*parts.objects, parts.live, question_of(name, plot->seconds));
        if (auto taken = take_answer(each, answer); !taken) return Unexpected(taken.error());
    }
    // Draws a copy of the data, because drawing takes longer than copying. A repeated plot never computes earlier
    // values.
    Expected<std::unique_ptr<PastValues>> earlier = nullptr;
    auto looked = parts.at_system([&]() -> Expected<PlotCurves> {
        auto curves = look_at_plot(parts.live, *plot);
        if (curves && plot->every > 0) {
            PlotRequest& again = parts.plots.emplace_back(std::move(*plot));
            again.next = curves->to + again.every;
            for (auto& [name, each] : again.elsewhere) each.recent.reset();
        } else if (curves) {
            earlier = begin_earlier(parts.live, *plot);
        }
        return curves;
    });
    if (!looked) return Unexpected(looked.error());
    bool in_place = looked->plot.every > 0;
    if (earlier && *earlier != nullptr) {
        const CallPause pause;  // this time must not count as time of the user's script
        const auto computed = compute_past(parts, (*earlier)->run(), "computing earlier values");
        if (computed) {
            in_place = *computed;
            auto all = parts.at_system([&] { return look_at_plot(parts.live, *plot, earlier->get()); });
            if (all) looked = std::move(all);
        } else if (computed.error().message == "interrupted") {
            return Unexpected(computed.error());
        } else {
            earlier = Unexpected(computed.error());
        }
    }
    std::string text = to_text(std::move(*looked));
    if (!earlier) text += "\nearlier values are not remembered: " + earlier.error().message;
    if (in_place) {
        parts.show_in_place(text);
    } else {
        parts.show(text);
    }
    return CommandEnd::done;
}

}  // namespace nezumi
