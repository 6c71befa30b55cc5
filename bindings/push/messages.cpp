// Changes are sent as their count, then two texts for each change.
#include "bindings/push/messages.hpp"

namespace nezumi::push {

Expected<void> put_changes(const PushConnection& connection, const std::vector<FileChange>& changes) {
    auto put = connection.put_number(changes.size());
    for (const FileChange& change : changes) {
        if (put) put = connection.put_number(static_cast<std::size_t>(change.what));
        if (put) put = connection.put(change.name);
    }
    return put;
}

Expected<std::vector<FileChange>> take_changes(const PushConnection& connection) {
    const auto count = connection.take_number();
    if (!count) return Unexpected(count.error());
    std::vector<FileChange> changes;
    while (changes.size() < *count) {
        const auto what = connection.take_number();
        if (!what) return Unexpected(what.error());
        if (*what > static_cast<std::size_t>(FileChange::What::kept_removed))
            return failure("an unknown kind of change");
        auto name = connection.take();
        if (!name) return Unexpected(name.error());
        changes.push_back({static_cast<FileChange::What>(*what), std::move(*name)});
    }
    return changes;
}

std::vector<std::string> names_to_send(const std::vector<FileChange>& changes, const FileList& project) {
    std::vector<std::string> names;
    for (const FileChange& change : changes) {
        const bool is_new = change.what == FileChange::What::added || change.what == FileChange::What::changed;
        const auto file = project.find(change.name);
        if (is_new && file != project.end() && !file->second.is_folder()) names.push_back(change.name);
    }
    return names;
}

}  // namespace nezumi::push
