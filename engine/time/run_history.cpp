// A branch shares the events of its parent from before the branch began.
#include "engine/time/run_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/values/walk.hpp"

namespace nezumi {

bool is_of_history(const Act& act, bool succeeded) {
    return succeeded || std::holds_alternative<Command>(act) || std::holds_alternative<Activate>(act) ||
           std::holds_alternative<Deactivate>(act) || std::holds_alternative<Reset>(act);
}

namespace {

// The message that an act gives to a port; null for other acts.
const Value* message_in(const Act& act) {
    return std::visit(
        []<class T>(const T& its) -> const Value* {
            if constexpr (std::is_same_v<T, Inject> || std::is_same_v<T, Write> || std::is_same_v<T, Hold>) {
                return &its.value;
            } else {
                return nullptr;
            }
        },
        act);
}

const PastAct* act_in(const PastEvent& event) {
    const auto* const act = std::get_if<std::shared_ptr<const PastAct>>(&event.what);
    return act != nullptr ? act->get() : nullptr;
}

std::size_t bytes_of(const PastEvent& event) {
    std::size_t bytes = sizeof event;
    if (const PastAct* const act = act_in(event)) {
        bytes += sizeof *act;
        if (const Value* const message = message_in(act->act)) bytes += heap_bytes(*message);
        for (const auto& [path, seen] : act->files) bytes += seen.text ? seen.text->size() : 0;
    }
    return bytes;
}

// Only the kind of an act and its actor remain.
void lighten(PastEvent& event) {
    const PastAct* const act = act_in(event);
    if (act == nullptr) return;
    Act kind = std::visit([]<class T>(const T& /*its*/) -> Act { return T{}; }, act->act);
    event.what =
        std::make_shared<const PastAct>(PastAct{.act = std::move(kind), .who = act->who, .failed = act->failed});
}

}  // namespace

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
    bytes_ += bytes_of(event);
    if (is_cut_) lighten(event);
    Branch& branch = branches_[current_];
    branch.end = event.when;
    branch.own.push_back(std::move(event));
    if (is_cut_ && branch.own.size() > most_latest) branch.own.pop_front();
    if (!is_cut_ && bytes_ > most_bytes) cut();
    position_ = branch.size();
}

void RunHistory::cut() {
    is_cut_ = true;
    for (Branch& branch : branches_) {
        branch.inherited = 0;
        const auto surplus = branch.own.size() - std::min(branch.own.size(), most_latest);
        branch.own.erase(branch.own.begin(), branch.own.begin() + static_cast<std::ptrdiff_t>(surplus));
        branch.own.shrink_to_fit();
        std::for_each(branch.own.begin(), branch.own.end(), lighten);
    }
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

std::optional<std::int64_t> RunHistory::end_of_start(int start, std::size_t branch) const {
    for (std::size_t index = 0; index < branches_[branch].size(); ++index) {
        const PastEvent& each = event(branch, index);
        const PastAct* const act = act_in(each);
        if (each.when.start == start && act != nullptr && std::holds_alternative<Restart>(act->act))
            return each.when.tick;
    }
    return std::nullopt;
}

}  // namespace nezumi
