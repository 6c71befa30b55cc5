// Keeps the file small: numbers are rounded to what a screen can show, and unchanged values are not written again.
#include "bindings/web/light_run.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bindings/journal/base64.hpp"
#include "bindings/web/remembered_json.hpp"
#include "bindings/web/system_json.hpp"
#include "bindings/web/types_json.hpp"
#include "engine/base/json_text.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/values/walk.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_floor = std::size_t{200} << 10;  // [bytes] of the picture file of the floor

// Rounds a pose's number to 0.1 mm, or about 0.006 degrees.
double on_screen(double value) { return std::round(value * 1e4) / 1e4; }

// Rounds to five significant digits.
double shortened(double value) {
    if (value == 0 || !std::isfinite(value)) return value;
    const double factor = std::pow(10, 4 - std::floor(std::log10(std::abs(value))));
    return std::isfinite(factor) ? std::round(value * factor) / factor : value;
}

std::vector<double> numbers_of(const Pose3D& pose) {
    const auto& [place, turn] = pose;
    return {on_screen(place.x), on_screen(place.y), on_screen(place.z),
            on_screen(turn.r),  on_screen(turn.p),  on_screen(turn.y)};
}

// If only one of `step` frames is kept: the index of the first kept frame that shows something that began at `frame`.
std::size_t seen_at(std::size_t frame, std::size_t step) { return (frame + step - 1) / step; }

// Rows as [[frame, number, ...], ...], with the indices of kept frames.
template <class Rows>
Json rows_to_json(const Rows& rows, std::size_t step) {
    Json all = Json::array();
    for (const auto& [frame, numbers] : rows) {
        const std::size_t seen = seen_at(frame, step);
        Json row = Json::array({seen});
        for (const double number : numbers) row.push_back(number);
        if (!all.empty() && all.back()[0] == seen) {
            all.back() = std::move(row);
        } else {
            all.push_back(std::move(row));
        }
    }
    return all;
}

template <class Tracks>
Json tracks_to_json(const Tracks& tracks, std::size_t step) {
    Json json = Json::object();
    for (const auto& [name, track] : tracks) {
        if (track.leaves.empty()) {
            json[name] = rows_to_json(track.rows, step);
        } else {
            json[name] = {{"leaves", track.leaves}, {"rows", rows_to_json(track.rows, step)}};
        }
    }
    return json;
}

// The times of one of `step` frames, and the last time.
Json times_to_json(const std::vector<double>& times, std::size_t step) {
    Json all = Json::array();
    for (std::size_t frame = 0; frame < times.size(); frame += step) all.push_back(on_screen(times[frame]));
    if (!times.empty() && (times.size() - 1) % step != 0) all.push_back(on_screen(times.back()));
    return all;
}

Json line_to_json(const LogLine& line) {
    return {{"is", "log"},
            {"level", to_text(line.level)},
            {"component", line.component},
            {"text", line.text},
            {"at", line.seconds}};
}

}  // namespace

bool LightRun::Track::add(std::size_t frame, std::vector<double> numbers) {
    if (!rows.empty() && rows.back().second == numbers) return false;
    rows.emplace_back(frame, std::move(numbers));
    return true;
}

void LightRun::Track::cut(std::size_t frame) {
    std::erase_if(rows, [&](const auto& row) { return row.first >= frame; });
}

LightRun::LightRun(RunningSystem& live, const ClockControl& clock) : live_(live), reader_(live, clock) {}

void LightRun::log(const LogLine& line) { lines_.push_back(line); }

// Removes what was noted from this time on: it belongs to another branch.
void LightRun::go_back(double seconds) {
    const auto from = std::lower_bound(times_.begin(), times_.end(), seconds - 1e-9);
    const auto frame = static_cast<std::size_t>(std::distance(times_.begin(), from));
    times_.erase(from, times_.end());
    std::erase_if(systems_, [&](const auto& each) { return each.first >= frame; });
    std::erase_if(lines_, [&](const LogLine& line) { return line.start == starts_ && line.seconds > seconds + 1e-9; });
    for (Tracks* tracks : {&robots_, &things_, &markers_, &rays_, &values_}) {
        for (auto& [name, track] : *tracks) track.cut(frame);
    }
}

void LightRun::look_for_names() {
    const System& system = live_.system();
    ports_.clear();
    members_.clear();
    for (const Component* component : system.components()) {
        const auto add = [&](const Port& port) {
            if (port.type() != message_of<CameraImage>())
                ports_.emplace_back(component->name() + "." + port.name(), &port);
        };
        for (const Port* port : component->in_ports()) add(*port);
        for (const Port* port : component->out_ports()) add(*port);
    }
    const TreeNode tree = live_.tree();
    for (const std::string& name : tree.children()) {
        for (const std::string& member : changing_members(*tree.child(name))) {
            auto channel = Channel::find(system, join_path(name, member));
            if (channel && !channel->is_port()) members_.push_back(std::move(*channel));
        }
    }
    std::size_t rays = 0;
    for (const Robot* robot : system.robots()) {
        if (system.world() != nullptr && robot->has_body() && !robot->is_real())
            rays += system.world()->rays(robot->id()).size();
    }
    with_rays_ = rays <= most_rays;
}

void LightRun::note() {
    const System& system = live_.system();
    const double now = system.now().seconds;
    if (starts_ != live_.starts()) {
        starts_ = live_.starts();
        go_back(0);
        std::erase_if(lines_, [&](const LogLine& line) { return line.start != starts_; });
    }
    const bool is_new = generation_ != live_.generation() || layout_ != system.layout();
    if (!times_.empty() && now < times_.back() - 1e-9) go_back(now);
    if (!is_new && !times_.empty() && now < times_.back() + period - 1e-9) return;
    if (is_new) {
        generation_ = live_.generation();
        layout_ = system.layout();
        look_for_names();
    }
    if (times_.empty() || now > times_.back() + 1e-9) times_.push_back(now);
    const std::size_t frame = times_.size() - 1;
    if (const std::uint64_t fingerprint = system_fingerprint(live_);
        is_new || systems_.empty() || fingerprint != fingerprint_) {
        fingerprint_ = fingerprint;
        systems_.emplace_back(frame, json_text(system_to_json(live_)));
    }
    note_world(frame);
    note_values(frame);
}

void LightRun::note_world(std::size_t frame) {
    const auto state = reader_.at(nullptr, {.truth = true, .rays = with_rays_}, 0);
    for (const WebRobot& robot : state->now.robots) {
        const std::size_t touched =
            robot.touches.empty() ? 0 : touched_.try_emplace(robot.touches, touched_.size() + 1).first->second;
        robots_[std::to_string(robot.index)].add(
            frame,
            {on_screen(robot.x), on_screen(robot.y), on_screen(robot.z), on_screen(robot.yaw), on_screen(robot.pitch),
             on_screen(robot.roll), robot.collided ? 1.0 : 0.0, static_cast<double>(touched)});
    }
    for (const WebThing& thing : state->now.things)
        things_[std::to_string(thing.index)].add(frame, numbers_of(thing.pose));
    for (const WebMarker& marker : state->now.markers)
        markers_[std::to_string(marker.index)].add(frame, numbers_of(marker.pose));
    std::map<std::uint32_t, std::vector<double>> rays;
    for (const WebRay& ray : state->now.rays) {
        std::vector<double>& of_robot = rays[ray.robot];
        for (const Point3D& end : {ray.from, ray.to})
            of_robot.insert(of_robot.end(), {on_screen(end.x), on_screen(end.y), on_screen(end.z)});
        of_robot.insert(of_robot.end(), {ray.hit ? 1.0 : 0.0, static_cast<double>(ray.distance)});
    }
    for (auto& [robot, numbers] : rays) rays_[std::to_string(robot)].add(frame, std::move(numbers));
}

void LightRun::note_values(std::size_t frame) {
    std::vector<std::string> leaves;
    std::vector<double> numbers;
    const auto take = [&](const LeafPath& path, const ValueView& leaf) {
        if (leaf.type->kind == Type::Kind::text || leaves.size() > most_numbers) return;
        leaves.push_back(path.text());
        numbers.push_back(
            visit_number(leaf, [](const auto& number) { return shortened(static_cast<double>(number)); }));
    };
    const auto add = [&](const std::string& name) {
        Track& track = values_[name];
        if (leaves.size() <= most_numbers && !leaves.empty()) {
            if (leaves.size() >= track.leaves.size()) track.leaves = leaves;
            if (track.add(frame, numbers)) numbers_ += numbers.size();
        }
        leaves.clear();
        numbers.clear();
    };
    for (const auto& [name, port] : ports_) {
        if (port->count() == 0) continue;
        visit_leaves(port->value(), take);
        add(name);
    }
    for (Channel& channel : members_) {
        channel.latch(live_.system().now().tick);
        channel.visit_latest(take);
        add(channel.name());
    }
}

std::string LightRun::text(const std::string& version, std::size_t step) {
    const System& system = live_.system();
    std::erase_if(values_, [](const auto& each) { return each.second.rows.empty(); });
    std::vector<std::string> touched(touched_.size() + 1);
    for (const auto& [name, number] : touched_) touched[number] = name;
    const auto& branch = live_.history().branches()[live_.history().current()].name;
    const auto remembered = remembered_to_json(live_, branch, false);
    Json lines = Json::array();
    for (const LogLine& line : lines_) lines.push_back(line_to_json(line));
    Json systems = Json::array();
    for (const auto& [frame, each] : systems_)
        systems.push_back({{"frame", seen_at(frame, step)}, {"system", Json::parse(each)}});
    Json json{{"hello",
               {{"is", "hello"},
                {"version", version},
                {"real", system.settings().real_time},
                {"view_only", true},
                {"callbacks", Json::array()},
                {"types", types_to_json()}}},
              {"systems", std::move(systems)},
              {"log", std::move(lines)},
              {"marks", remembered ? (*remembered)["marks"] : Json::array()},
              {"times", times_to_json(times_, step)},
              {"touched", touched},
              {"robots", tracks_to_json(robots_, step)},
              {"things", tracks_to_json(things_, step)},
              {"markers", tracks_to_json(markers_, step)},
              {"rays", tracks_to_json(rays_, step)},
              {"values", tracks_to_json(values_, step)}};
    if (const auto& floor = live_.spec().arena.floor; floor && system.world() != nullptr) {
        if (const auto picture = read_whole(floor->image, floor->image, largest_floor))
            json["floor"] = to_base64(*picture);
    }
    return json_text(json);
}

}  // namespace nezumi::web
