// An existing file may be replaced or removed only if it has the content of an earlier push.
#include "bindings/push/plan.hpp"

#include <algorithm>
#include <optional>
#include <set>

namespace nezumi::push {
namespace {

using What = FileChange::What;

class Planner {
public:
    Planner(const FileList& pushed, const FileList& project, const OpenFolder* there)
        : pushed_(pushed), project_(project), there_(there) {}

    PushPlan operator()() {
        for (const auto& [name, brought] : pushed_) {
            if (!project_.contains(name)) plan_removal(name, brought);
        }
        for (const auto& [name, wanted] : project_) {
            if (is_closed(name)) {
                keep(name);
            } else if (wanted.is_folder()) {
                plan_folder(name, wanted);
            } else {
                plan_file(name, wanted);
            }
        }
        std::stable_sort(plan_.changes.begin(), plan_.changes.end(),
                         [](const FileChange& one, const FileChange& other) { return one.name < other.name; });
        return std::move(plan_);
    }

private:
    std::optional<ListedFile> find(const std::string& name) const {
        return there_ != nullptr ? there_->find(name) : std::nullopt;
    }
    bool is_as_brought(const std::string& name, const ListedFile& found) const {
        const auto brought = pushed_.find(name);
        return brought != pushed_.end() && have_same_content(found, brought->second);
    }
    void note(What what, const std::string& name) { plan_.changes.push_back({what, name}); }
    // Keeps the file and its entry in the list.
    void keep(const std::string& name) {
        if (const auto brought = pushed_.find(name); brought != pushed_.end()) plan_.next.insert(*brought);
    }
    void keep(const std::string& name, const ListedFile& wanted) {
        note(pushed_.contains(name) ? What::kept_edited : What::kept_own, name);
        keep(name);
        if (wanted.is_folder()) closed_.insert(name);
    }
    // True if the file is in a folder that can't be made, because another object with the folder's name is kept.
    bool is_closed(const std::string& name) const {
        for (auto slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
            if (closed_.contains(name.substr(0, slash))) return true;
        }
        return false;
    }
    // True if a folder becomes empty when all pushed files in it are removed.
    bool becomes_empty(const std::string& folder) const {
        const auto names = there_->names_in(folder);
        return names && std::all_of(names->begin(), names->end(), [&](const std::string& last) {
                   const std::string name = folder + "/" + last;
                   const auto found = find(name);
                   return !found || (is_as_brought(name, *found) && (!found->is_folder() || becomes_empty(name)));
               });
    }

    void plan_removal(const std::string& name, const ListedFile& brought) {
        const auto found = find(name);
        if (!found) return;
        const bool is_ours = have_same_content(*found, brought);
        if (is_ours && brought.is_folder()) return;
        note(is_ours ? What::removed : What::kept_removed, name);
    }
    void plan_folder(const std::string& name, const ListedFile& wanted) {
        const auto found = find(name);
        if (found && !found->is_folder() && !is_as_brought(name, *found)) return keep(name, wanted);
        if (!found || !found->is_folder()) note(found ? What::changed : What::added, name);
        plan_.next.emplace(name, wanted);
    }
    void plan_file(const std::string& name, const ListedFile& wanted) {
        const auto found = find(name);
        const bool is_same = found && have_same_content(*found, wanted);
        const bool is_ours = found && is_as_brought(name, *found) && (!found->is_folder() || becomes_empty(name));
        if (found && !is_same && !is_ours) return keep(name, wanted);
        if (!found || *found != wanted) note(found ? What::changed : What::added, name);
        plan_.next.emplace(name, wanted);
    }

    const FileList& pushed_;
    const FileList& project_;
    const OpenFolder* there_;
    PushPlan plan_;
    std::set<std::string> closed_;
};

}  // namespace

bool is_change(What what) { return what == What::added || what == What::changed || what == What::removed; }

bool is_withheld(What what) { return what == What::kept_edited || what == What::kept_own; }

PushPlan plan_push(const FileList& pushed, const FileList& project, const OpenFolder* there) {
    return Planner(pushed, project, there)();
}

}  // namespace nezumi::push
