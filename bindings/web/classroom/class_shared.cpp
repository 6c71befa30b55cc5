// The shared system: pupils take turns, and after each turn it starts again from the teacher's files, stopped.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "bindings/web/classroom/check_work.hpp"
#include "bindings/web/classroom/classroom.hpp"
#include "engine/base/list.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

// The requests that the driving pupil may send, in addition to the requests of all viewers.
constexpr std::array<std::string_view, 3> while_driving{"drive", "rearm", "explain"};
constexpr std::array<std::string_view, 4> acts_of_driver{"SetParameter", "Use", "Reset", "Press"};

template <class List>
bool has(const List& list, const Json& text) {
    return text.is_string() && contains(list, text.get<std::string_view>());
}

}  // namespace

bool Classroom::is_there(int pupil) const {
    return std::any_of(clients_.begin(), clients_.end(), [&](const auto& each) {
        return each.second.pupil == pupil && (each.second.role == Role::pupil || each.second.role == Role::guest);
    });
}

bool Classroom::drives(const Client& client) const {
    return client.role == Role::guest && shared_->turns.driver() == client.pupil;
}

std::string Classroom::why_not_shared(const Client& client, const Json& request) const {
    const Json what = request.is_object() ? request.value("do", Json()) : Json();
    if (!drives(client)) return "it is not your turn";
    if (has(while_driving, what) || (what == "act" && has(acts_of_driver, request.value("act", Json())))) return "";
    return "in the shared system you can only drive, set parameters and press buttons: use your own system for "
           "everything else";
}

Expected<Classroom::Json> Classroom::ask_shared(const Client& client, std::string_view what) {
    if (!shared_) return failure("the class has no shared system");
    Turns& turns = shared_->turns;
    const bool is_driver = turns.driver() == client.pupil;
    if (what == "stop_shared") {
        shared_->tell(stop_message);
    } else if (what == "queue") {
        turns.enter(client.pupil);
    } else if (what == "leave_queue") {
        turns.remove(client.pupil);
        if (is_driver) end_turn();
    } else if (!is_driver) {
        return failure("it is not your turn");
    } else {
        take_behaviors();
        if (!shared_->problem_of_driver.empty()) return failure(shared_->problem_of_driver);
    }
    return Json::object();
}

Expected<Classroom::Json> Classroom::teach_shared(const Json& request) {
    if (!shared_) return failure("the class has no shared system");
    Turns& turns = shared_->turns;
    const auto number = [&](const char* name) {
        const Json value = request.value(name, Json());
        return value.is_number_integer() ? value.get<int>() : 0;
    };
    const Json go = request.value("go", Json());
    if (go == "end" || go == "restart") {
        end_turn();
    } else if (go == "up") {
        turns.move_up(number("pupil"));
    } else if (go == "remove") {
        turns.remove(number("pupil"));
    } else if (go == "limit") {
        const std::chrono::minutes limit(number("minutes"));
        turns.set_limit(limit);
        if (turns.limit() != limit) return failure("'minutes' must be a whole number from 1 to 120");
    } else {
        return failure("'go' must be one of end, restart, up, remove, limit");
    }
    return Json::object();
}

void Classroom::take_behaviors() {
    const Seat* seat = seat_of(shared_->turns.driver());
    const auto taken = shared_->take_behaviors(pupils_.work_of(seat->pupil));
    shared_->problem_of_driver = taken ? "" : describe(taken.error());
}

void Classroom::begin_turn() {
    shared_->tell(stop_message);
    take_behaviors();
    for (auto& [id, client] : clients_) {
        if (drives(client)) close(client);  // the page connects again, and then may drive
    }
}

// Stops the robots now and restarts the system, which begins with the emergency stop on.
void Classroom::end_turn() {
    shared_->turns.end();
    shared_->problem_of_driver.clear();
    shared_->tell(stop_message);
    if (shared_->run) shared_->run_before = shared_->run.get();
    restart(*shared_);
}

void Classroom::serve_shared(Clock::time_point now) {
    if (!shared_) return;
    SharedSystem& shared = *shared_;
    if (shared.run) shared.run->hurry(now);
    if (shared.run && shared.run->has_ended()) {
        shared.note_end(now);
        const auto next_start = shared.next_start;
        end_turn();
        shared.next_start = next_start;
    }
    if (shared.turns.look(now, [this](int pupil) { return is_there(pupil); })) end_turn();
    const bool is_ending =
        std::any_of(ending_.begin(), ending_.end(), [&](const auto& each) { return each.get() == shared.run_before; });
    if (!shared.run && !is_ending && now >= shared.next_start) {
        shared.run_before = nullptr;
        if (const auto renewed = shared.renew(); renewed) {
            auto words = confined_words(options_.program, shared.folder, options_.trust, shared.options.devices);
            words.insert(words.end(), {"run", shared.file().string(), "--page-on-input", "--stopped"});
            words.insert(words.end(), shared.options.hardware.begin(), shared.options.hardware.end());
            start(shared, std::move(words));
        } else {
            shared.problem = describe(renewed.error());
            shared.next_start = now + std::chrono::seconds(5);
        }
    }
    const bool is_ready = shared.run && !shared.run->is_ending() && shared.view.is_described();
    if (is_ready) shared.problem.clear();
    if (is_ready && shared.turns.begin(now)) begin_turn();
}

Classroom::Json Classroom::state_of_shared() const {
    const SharedSystem& shared = *shared_;
    const auto name_of = [&](int pupil) {
        const auto found = seats_.find(pupil);
        return found == seats_.end() ? "" : found->second->pupil.name;
    };
    const auto left = std::chrono::ceil<std::chrono::seconds>(shared.turns.left(Clock::now()));
    Json state{{"name", shared.name()},
               {"real", shared.is_real()},
               {"state", shared.run ? shared.view.state() : "off"},
               {"problem", shared.problem.empty() ? shared.view.error() : shared.problem},
               {"driver", name_of(shared.turns.driver())},
               {"left", left.count()},
               {"limit", shared.turns.limit().count()}};
    Json waiting = Json::array();
    for (const int pupil : shared.turns.waiting()) waiting.push_back({{"number", pupil}, {"name", name_of(pupil)}});
    state["waiting"] = std::move(waiting);
    return state;
}

Classroom::Json Classroom::shared_for_pupil(const Client& client) const {
    Json state = state_of_shared();
    const Seat& seat = *seats_.at(client.pupil);
    // A pupil sees no names and numbers of other pupils: only the teacher does.
    state["waiting"] = shared_->turns.waiting().size();
    state["place"] = shared_->turns.place_of(client.pupil);
    const bool is_driver = shared_->turns.driver() == client.pupil;
    state["driving"] = is_driver;
    if (is_driver) state["not_taken"] = shared_->problem_of_driver;
    state["link"] = seat.shared_token;
    state["own"] = seat.pupil.token;
    return state;
}

}  // namespace nezumi::web
