// Everything that may be refused is checked before the first file is changed.
#include "bindings/push/receive.hpp"

#include <iterator>
#include <string>
#include <utility>

#include "bindings/push/destination.hpp"
#include "bindings/push/messages.hpp"
#include "bindings/push/pushed_folder.hpp"
#include "engine/base/error.hpp"

namespace nezumi::push {
namespace {

// Time [s] to wait for another process that has locked the folder: an interrupted push, or the start of a run.
constexpr double wait_for_folder = 2;

struct Order {
    std::string folder;
    bool only_shows = false;
    FileList project;
};

Expected<Order> take_order(const PushConnection& connection) {
    auto folder = connection.take();
    if (!folder) return Unexpected(folder.error());
    const auto word = connection.take();
    if (!word) return Unexpected(word.error());
    const auto text = connection.take();
    if (!text) return Unexpected(text.error());
    auto project = read_file_list(*text);
    if (!project) return Unexpected(project.error());
    return Order{std::move(*folder), *word == say_show, std::move(*project)};
}

Expected<void> put_plan(const PushConnection& connection, bool has_finished, const Destination& to,
                        const PushPlan& plan) {
    auto put = connection.put(say_plan);
    if (put) put = connection.put(to.folder.string());
    if (put) put = connection.put(has_finished ? say_finished : "");
    if (put) put = connection.put(to.copy_before.string());
    return put ? put_changes(connection, plan.changes) : put;
}

Expected<void> show_plan(const PushConnection& connection, const Order& order, const Destination& to) {
    const auto there = OpenFolder::open(to.folder);
    if (!there) return put_plan(connection, false, to, plan_push({}, order.project, nullptr));
    if (is_committed_to(*there))
        return failure(
            "a push to this folder was interrupted while its files were put in place: the next push finishes it");
    const auto pushed = to.copy_before.empty() ? pushed_list(*there) : to.brought_before;
    return pushed ? put_plan(connection, false, to, plan_push(*pushed, order.project, &*there))
                  : Unexpected(pushed.error());
}

Expected<void> stage_files(const PushConnection& connection, PushedFolder& folder, const FileList& project,
                           const PushPlan& plan) {
    for (const FileChange& change : plan.changes) {
        if (auto can = folder.can_change(change.name); !can && is_change(change.what)) return can;
    }
    for (const std::string& name : names_to_send(plan.changes, project)) {
        const auto listed = plan.next.find(name);
        const auto number = static_cast<std::size_t>(std::distance(plan.next.begin(), listed));
        if (auto staged = folder.stage(number, name, listed->second, [&] { return connection.take(); }); !staged)
            return staged;
    }
    const auto word = connection.take();
    if (!word) return Unexpected(word.error());
    return *word == say_commit ? Expected<void>() : failure("expected the end of the project");
}

Expected<void> receive(const PushConnection& connection) {
    auto order = take_order(connection);
    if (!order) return Unexpected(order.error());
    const auto to = find_destination(order->folder);
    if (!to) return Unexpected(to.error());
    if (order->only_shows) return show_plan(connection, *order, *to);

    auto folder = PushedFolder::open(to->folder, wait_for_folder);
    if (!folder) return Unexpected(folder.error());
    const auto ended = folder->end_interrupted();
    if (!ended) return Unexpected(ended.error());
    if (!to->copy_before.empty()) {
        if (auto adopted = folder->adopt(to->brought_before); !adopted) return adopted;
    }
    const auto pushed = pushed_list(folder->files());
    if (!pushed) return Unexpected(pushed.error());
    const PushPlan plan = plan_push(*pushed, order->project, &folder->files());
    if (auto put = put_plan(connection, *ended, *to, plan); !put) return put;

    auto done = stage_files(connection, *folder, order->project, plan);
    if (done) done = folder->commit(plan.next);
    if (!done) {
        (void)folder->end_interrupted();  // if this fails, the next push repeats it
        done.error().message += ": nothing was changed on the robot";
        return done;
    }
    const auto kept = folder->finish();
    if (!kept) {
        Error why = kept.error();
        why.message += ": some files on the robot were already changed; correct this and push again";
        return Unexpected(std::move(why));
    }
    if (auto said = connection.put(say_done); !said) return said;
    return put_changes(connection, *kept);
}

}  // namespace

bool receive_project(const PushConnection& connection) {
    const auto done = receive(connection);
    if (!done && connection.put(say_failed)) (void)connection.put(describe(done.error()));
    return done.has_value();
}

}  // namespace nezumi::push
