// Only differences are sent.
#include "bindings/push/send.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "bindings/push/messages.hpp"

namespace nezumi::push {
namespace {

constexpr std::string_view nothing_changed = "nothing was changed on the robot";

// Takes the next word of the other side, or the error that it sent. If the connection broke, the error ends with
// `state`.
Expected<std::string> take_word(const PushConnection& connection, std::string_view state) {
    auto word = connection.take();
    if (!word) return failure(fmt::format("{}: {}", word.error().message, state));
    if (*word != say_failed) return word;
    const auto why = connection.take();
    return why ? failure(*why) : Unexpected(why.error());
}

// Sends the contents, then the commit. Returns false if the other side stopped reading: it has sent the reason. An
// error is one of this side.
Expected<bool> send_contents(const PushConnection& connection, const ProjectScan& project,
                             const std::vector<FileChange>& changes) {
    for (const std::string& name : names_to_send(changes, project.list)) {
        bool is_taken = true;
        const int problem = project.folder.read(name, [&](std::string_view bytes) {
            is_taken = connection.put(bytes).has_value();
            return is_taken ? 0 : EPIPE;
        });
        if (is_taken && problem != 0)
            return failure(std::string("can't be read: ") + std::strerror(problem), {.file = name});
        if (!is_taken || !connection.put("")) return false;
    }
    return connection.put(say_commit).has_value();
}

void add_kept(std::vector<FileChange>& changes, std::vector<FileChange> kept) {
    for (FileChange& change : kept) {
        std::erase_if(changes, [&](const FileChange& planned) { return planned.name == change.name; });
        changes.push_back(std::move(change));
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const FileChange& one, const FileChange& other) { return one.name < other.name; });
}

Expected<Sent> take_plan(const PushConnection& connection) {
    if (const auto word = take_word(connection, nothing_changed); !word) return Unexpected(word.error());
    auto folder = connection.take();
    if (!folder) return Unexpected(folder.error());
    const auto finished = connection.take();
    if (!finished) return Unexpected(finished.error());
    auto copy = connection.take();
    if (!copy) return Unexpected(copy.error());
    auto changes = take_changes(connection);
    if (!changes) return Unexpected(changes.error());
    return Sent{std::move(*changes), std::move(*folder), *finished == say_finished, std::move(*copy)};
}

}  // namespace

Expected<Sent> send_project(const PushConnection& connection, const ProjectScan& project, const std::string& folder,
                            bool only_shows) {
    // If sending fails, the other side has sent the reason before.
    (void)connection.put(folder);
    (void)connection.put(only_shows ? say_show : say_change);
    (void)connection.put(to_text(project.list));
    auto sent = take_plan(connection);
    if (!sent || only_shows) return sent;
    const auto is_told = send_contents(connection, project, sent->changes);
    if (!is_told) return Unexpected(is_told.error());
    const auto word =
        take_word(connection, *is_told ? "push again: that finishes this push or undoes it" : nothing_changed);
    if (!word) return Unexpected(word.error());
    auto kept = take_changes(connection);
    if (kept) add_kept(sent->changes, std::move(*kept));
    return sent;
}

}  // namespace nezumi::push
