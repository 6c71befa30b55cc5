// A branch stores only its own part; its parent has the time before.
#include "engine/time/remembered_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/robot/robot.hpp"
#include "engine/world/world.hpp"

namespace nezumi {
namespace {

std::size_t bytes_of(const RememberedRun::Row& row) {
    return sizeof row + row.robots.size() * sizeof(RememberedRun::Pose) +
           row.things.size() * sizeof(RememberedRun::MovedThing);
}

RememberedRun::Pose pose_of(const Robot& robot, const World* world) {
    if (world != nullptr && robot.has_body() && !robot.is_real()) {
        const auto [position, orientation] = world->pose(robot.id());
        return {static_cast<float>(position.x), static_cast<float>(position.y), static_cast<float>(orientation.y)};
    }
    const Pose2D& pose = robot.odometry().pose();
    return {static_cast<float>(pose.position.x), static_cast<float>(pose.position.y), static_cast<float>(pose.heading)};
}

// The branches from the first one to this one, each with the time up to which this branch shares its events.
std::vector<std::pair<std::size_t, ActTime>> lineage(const RunHistory& history, std::size_t branch) {
    std::vector<std::pair<std::size_t, ActTime>> line;
    ActTime until = history.branches()[branch].end;
    for (;;) {
        line.insert(line.begin(), {branch, until});
        if (branch == 0) return line;
        const ActTime left = history.branches()[branch].left;
        if (is_earlier(left, until)) until = left;
        branch = history.branches()[branch].parent;
    }
}

}  // namespace

void RememberedRun::note(std::size_t branch, const ActTime& now, int generation, const System& system) {
    while (branches_.size() <= branch) branches_.emplace_back();
    Branch& its = branches_[branch];
    const bool is_known = !is_earlier(its.noted, now);
    note_marks(its, now, !is_known && generation == generation_, system);
    generation_ = generation;
    if (is_known) return;
    its.noted = now;
    const auto period = static_cast<std::int64_t>(std::max(1.0, std::round(system.settings().rate / rate)));
    if (now.tick % period == 0) note_row(its, now, system);
}

void RememberedRun::note_row(Branch& branch, const ActTime& now, const System& system) {
    const auto& robots = system.robots();
    if (robots.empty()) return;
    Row row{now, {}, {}};
    row.robots.reserve(robots.size());
    for (const Robot* robot : robots) row.robots.push_back(pose_of(*robot, system.world()));
    if (system.world() != nullptr) note_things(branch, row, *system.world());
    bytes_ += bytes_of(row);
    branch.rows.push_back(std::move(row));
    if (bytes_ > most_bytes) drop_oldest();
}

void RememberedRun::note_things(Branch& branch, Row& row, const World& world) {
    const std::vector<ThingPose> things = world.things();
    const std::size_t known = things_.size();
    // After a restart or a seek, the earlier positions do not belong to the past of this row.
    const bool goes_on = std::exchange(things_generation_, generation_) == generation_ && !branch.rows.empty();
    things_.resize(things.size());
    for (std::size_t index = 0; index < things.size(); ++index) {
        const Pose3D before = std::exchange(things_[index], things[index].pose);
        if (index >= known || before == things_[index]) continue;
        row.things.push_back({index, things_[index]});
        if (!goes_on) continue;
        std::vector<MovedThing>& last = branch.rows.back().things;
        const auto is_it = [&](const MovedThing& each) { return each.index == index; };
        if (std::any_of(last.begin(), last.end(), is_it)) continue;
        last.push_back({index, before});
        bytes_ += sizeof(MovedThing);
    }
}

void RememberedRun::drop_oldest() {
    const auto fullest = std::max_element(branches_.begin(), branches_.end(), [](const Branch& a, const Branch& b) {
        return a.rows.size() < b.rows.size();
    });
    bytes_ -= bytes_of(fullest->rows.front());
    fullest->rows.pop_front();
}

void RememberedRun::note_marks(Branch& branch, const ActTime& now, bool is_new, const System& system) {
    const auto mark = [&](Mark::Kind kind, std::string text) {
        if (is_new && branch.marks.size() < most_marks) branch.marks.push_back({now, kind, std::move(text)});
    };
    const auto& robots = system.robots();
    touching_.resize(robots.size(), false);
    if (const World* world = system.world()) {
        for (std::size_t index = 0; index < robots.size(); ++index) {
            const Robot& robot = *robots[index];
            const bool touches = robot.has_body() && !robot.is_real() && world->collided(robot.id());
            if (touches && !touching_[index])
                mark(Mark::Kind::collision,
                     fmt::format("{} touches {}", robot.name(), world->collided_with(robot.id())));
            touching_[index] = touches;
        }
    }
    std::size_t index = 0;
    failed_.resize(system.components().size(), false);
    for (const Component* component : system.components()) {
        const bool failed = component->state() == LifeState::error;
        if (failed && !failed_[index])
            mark(Mark::Kind::error, fmt::format("{}: {}", component->name(), describe(component->last_error())));
        failed_[index++] = failed;
    }
}

std::vector<RememberedRun::Row> RememberedRun::rows(const RunHistory& history, std::size_t branch, int start,
                                                    std::size_t most) const {
    std::vector<const Row*> all;
    for (const auto& [each, until] : lineage(history, branch)) {
        if (each >= branches_.size()) continue;
        for (const Row& row : branches_[each].rows) {
            if (row.when.start == start && !is_earlier(until, row.when)) all.push_back(&row);
        }
    }
    const std::size_t step = most == 0 ? 1 : std::max<std::size_t>(1, (all.size() + most - 1) / most);
    std::vector<Row> some;
    std::vector<MovedThing> moved;  // movements in rows that are left out
    for (std::size_t index = 0; index < all.size(); ++index) {
        moved.insert(moved.end(), all[index]->things.begin(), all[index]->things.end());
        if (index % step != 0) continue;
        some.push_back({all[index]->when, all[index]->robots, std::exchange(moved, {})});
    }
    return some;
}

std::vector<RememberedRun::Mark> RememberedRun::marks(const RunHistory& history, std::size_t branch, int start) const {
    std::vector<Mark> all;
    for (const auto& [each, until] : lineage(history, branch)) {
        if (each >= branches_.size()) continue;
        for (const Mark& mark : branches_[each].marks) {
            if (mark.when.start == start && !is_earlier(until, mark.when)) all.push_back(mark);
        }
    }
    return all;
}

}  // namespace nezumi
