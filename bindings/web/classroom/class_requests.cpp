// Handles requests of visitors, pupils and the teacher. Paths of files are made only from numbers and names of
// exercises.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bindings/web/classroom/classroom.hpp"
#include "engine/base/list.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

std::string text_in(const Json& request, const char* name) {
    const auto found = request.find(name);
    return found != request.end() && found->is_string() ? found->get<std::string>() : "";
}

Expected<Json> said(const Expected<void>& done) {
    if (!done) return Unexpected(done.error());
    return Json::object();
}

// The requests of pupils about the shared system.
constexpr std::array<std::string_view, 4> of_shared{"queue", "leave_queue", "load", "stop_shared"};
constexpr std::string_view pause_message = R"({"do":"time","what":"pause"})";
constexpr std::string_view resume_message = R"({"do":"time","what":"resume"})";

}  // namespace

Expected<Classroom::Json> Classroom::perform(Client& client, const Json& request) {
    if (client.role == Role::visitor) return join(client, request);
    if (client.role == Role::teacher) return teach(request);
    Seat* seat = seat_of(client.pupil);
    const std::string what = text_in(request, "what");
    const bool is_own = client.role == Role::pupil || client.role == Role::guest;
    if (is_own && contains(of_shared, what)) return ask_shared(client, what);
    if (seat == nullptr) return failure("this page has no permission for that: open your own link of the class");
    const bool may_act = client.role == Role::pupil || client.role == Role::helper;
    if (may_act && what == "check") return said(check_later(*seat));
    if (may_act && what == "restart") {
        seat->is_repairing = false;
        seat->failures = 0;
        restart(*seat);
        return Json::object();
    }
    return failure("this page has no permission for that: open your own link of the class");
}

Expected<Classroom::Json> Classroom::join(Client& client, const Json& request) {
    const auto now = Clock::now();
    const std::string code = text_in(request, "code");
    if (!code.empty()) {
        if (!tries_.may_try(client.source, now)) return failure("too many wrong codes: wait a minute");
        const Pupil* pupil = pupils_.find_code(code);
        Seat* seat = pupil == nullptr ? nullptr : seat_of(pupil->number);
        if (seat == nullptr) {
            tries_.was_wrong(client.source, now);
            return failure("nobody in this class has this code");
        }
        seat->is_wanted = true;
        return Json{{"token", pupil->token}};
    }
    if (!door_is_open_) return failure("the teacher has closed the class to new pupils");
    if (seats_.size() >= most_pupils) return failure("the class is full");
    while (!joins_.empty() && now - joins_.front() > std::chrono::minutes(1)) joins_.pop_front();
    if (joins_.size() >= most_joins) return failure("too many pupils are joining: wait a minute, then try again");
    auto pupil = pupils_.join(text_in(request, "name"));
    if (!pupil) return Unexpected(pupil.error());
    joins_.push_back(now);
    Seat& seat = add_seat(**pupil);
    seat.is_wanted = true;
    if (auto given = give_exercise(seat, first_exercise_); !given) {
        seats_.erase(seat.pupil.number);
        pupils_.remove(**pupil);
        return Unexpected(given.error());
    }
    return Json{{"token", seat.pupil.token}, {"code", seat.pupil.code}};
}

void Classroom::tell_all(std::string_view message) {
    for (auto& [number, seat] : seats_) {
        seat->tell(message);
        if (seat->page) seat->page->tell(message);
    }
    if (shared_) shared_->tell(message);
}

Expected<Classroom::Json> Classroom::teach(const Json& request) {
    const std::string what = text_in(request, "what");
    if (what == "stop") {
        tell_all(stop_message);
    } else if (what == "freeze" || what == "thaw") {
        is_frozen_ = what == "freeze";
        tell_all(is_frozen_ ? pause_message : resume_message);
    } else if (what == "door") {
        door_is_open_ = request.value("open", Json()) == true;
    } else if (what == "collect") {
        return collect();
    } else if (what == "shared") {
        return teach_shared(request);
    } else if (what == "project") {
        const Json number = request.value("pupil", Json());
        projected_ = number.is_number_integer() && system_at(number.get<int>()) != nullptr ? number.get<int>() : 0;
        for (auto& [id, client] : clients_) {
            if (client.role == Role::spectator) close(client);
        }
    } else {
        const Json number = request.value("pupil", Json());
        if (!number.is_number_integer()) return failure("'pupil' must be a number");
        if (number.get<int>() != 0) {
            Seat* seat = seat_of(number.get<int>());
            if (seat == nullptr) return failure("there is no such pupil");
            return teach_one(*seat, what, request);
        }
        // The request is for all pupils. Pupils who join later start with this exercise, too.
        if (what == "exercise" && exercise_called(text_in(request, "exercise")) != nullptr)
            first_exercise_ = text_in(request, "exercise");
        for (auto& [number_of, seat] : seats_) {
            if (auto done = teach_one(*seat, what, request); !done) return done;
        }
    }
    return Json::object();
}

Expected<Classroom::Json> Classroom::teach_one(Seat& seat, const std::string& what, const Json& request) {
    const std::string text = text_in(request, "text");
    if (text.size() > Pupils::longest_comment) return failure("the text is too long");
    if (what == "exercise") return said(give_exercise(seat, text_in(request, "exercise")));
    if (what == "check") return said(check_later(seat));
    if (what == "restart") {
        seat.is_repairing = false;
        restart(seat);
        return Json::object();
    }
    if (what == "renew") {
        auto done = pupils_.renew(seat.pupil);
        seat.shared_token = make_token();
        for (auto& [id, client] : clients_) {
            const bool is_own = client.role == Role::pupil || client.role == Role::guest;
            if (is_own && client.pupil == seat.pupil.number) close(client);
        }
        close_page(seat);
        return said(done);
    }
    if (what == "hint") {
        if (text.empty()) return failure("the hint has no text");
        seat.pupil.hints.push_back(text);
        if (seat.pupil.hints.size() > Pupils::most_hints) seat.pupil.hints.erase(seat.pupil.hints.begin());
        return said(pupils_.save(seat.pupil));
    }
    if (what == "mark") {
        seat.pupil.mark = text_in(request, "mark").substr(0, 40);
        seat.pupil.comment = text;
        return said(pupils_.save(seat.pupil));
    }
    return failure("unknown request '" + what + "'");
}

const Exercise* Classroom::exercise_called(std::string_view name) const {
    const auto found =
        std::find_if(exercises_.begin(), exercises_.end(), [&](const Exercise& each) { return each.name == name; });
    return found == exercises_.end() ? nullptr : &*found;
}

Expected<void> Classroom::give_exercise(Seat& seat, const std::string& name) {
    const Exercise* exercise = exercise_called(name);
    if (exercise == nullptr) return failure("there is no exercise '" + name + "'");
    seat.pupil.exercise = name;
    // Existing files stay: the pupil may have changed them.
    if (auto ok = copy_files(exercise->start(), pupils_.work_of(seat.pupil), false); !ok) return ok;
    std::error_code problem;
    std::filesystem::create_directories(pupils_.work_of(seat.pupil) / "behaviors", problem);
    if (auto ok = pupils_.save(seat.pupil); !ok) return ok;
    seat.checked.clear();
    seat.check.clear();
    seat.is_repairing = false;
    seat.failures = 0;
    restart(seat);
    return {};
}

}  // namespace nezumi::web
