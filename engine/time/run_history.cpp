// Branches share the events before their beginning, which are never changed.
#include "engine/time/run_history.hpp"

#include <fmt/format.h>

#include <utility>

namespace nezumi {

bool is_of_history(const Act& act, bool succeeded) {
    return succeeded || std::holds_alternative<Command>(act) || std::holds_alternative<Activate>(act) ||
           std::holds_alternative<Deactivate>(act) || std::holds_alternative<Reset>(act);
}

void RunHistory::begin(FilesSeen files) {
    *this = RunHistory();
    files_ = std::move(files);
}

void RunHistory::add(PastEvent event) {
    if (is_past(event.when)) {
        branches_.push_back({.name = fmt::format("branch {}", branches_.size()),
                             .parent = current_,
                             .inherited = position_,
                             .left = event.when});
        current_ = branches_.size() - 1;
    }
    Branch& branch = branches_[current_];
    branch.end = event.when;
    branch.own.push_back(std::move(event));
    position_ = branch.size();
}

void RunHistory::reach(const ActTime& now, double seconds) {
    Branch& branch = branches_[current_];
    if (is_past(now)) return;
    branch.end = now;
    branch.seconds = seconds;
}

bool RunHistory::is_past(const ActTime& now) const {
    const Branch& branch = branches_[current_];
    return position_ < branch.size() || is_earlier(now, branch.end);
}

const PastEvent* RunHistory::due(const ActTime& now) const {
    if (position_ == branches_[current_].size()) return nullptr;
    const PastEvent& next = event(current_, position_);
    return is_earlier(now, next.when) ? nullptr : &next;
}

const PastEvent& RunHistory::event(std::size_t branch, std::size_t index) const {
    while (index < branches_[branch].inherited) branch = branches_[branch].parent;
    return branches_[branch].own[index - branches_[branch].inherited];
}

RunHistory RunHistory::course(std::size_t branch) const {
    RunHistory course;
    Branch& only = course.branches_.front();
    for (std::size_t index = 0; index < branches_[branch].size(); ++index) only.own.push_back(event(branch, index));
    only.end = branches_[branch].end;
    course.files_ = files_;
    return course;
}

std::optional<std::size_t> RunHistory::find(std::string_view name) const {
    for (std::size_t index = 0; index < branches_.size(); ++index) {
        if (branches_[index].name == name) return index;
    }
    return std::nullopt;
}

}  // namespace nezumi
