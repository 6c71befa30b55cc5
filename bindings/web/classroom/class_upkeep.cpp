// Starts and restarts pupils' processes, runs checks at the same time, and tells browsers what has changed.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "bindings/web/classroom/check_work.hpp"
#include "bindings/web/classroom/classroom.hpp"
#include "engine/base/json_text.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::web {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds states_every{250};
constexpr std::chrono::seconds repeated_every{2};
constexpr std::chrono::seconds saves_every{2};
// The most states of the class that may wait for a slow browser.
constexpr std::size_t most_states = 4;
// An empty system that runs while the pupil's own system file can't, so that the pupil can correct the file in the
// page.
constexpr const char* stand_in = ".nezumi/repair.lua";
constexpr std::string_view stand_in_text = "--- Shown while your own system file can't run.\narena {}\n";

std::size_t passed(const Seat& seat) {
    return static_cast<std::size_t>(std::count_if(seat.checked.begin(), seat.checked.end(),
                                                  [](const CheckedScenario& each) { return each.passed; }));
}

}  // namespace

Seat& Classroom::add_seat(Pupil& pupil) {
    auto& seat = seats_[pupil.number];
    seat = std::make_unique<Seat>(pupil);
    return *seat;
}

void Classroom::start(Seat& seat) {
    const fs::path work = pupils_.work_of(seat.pupil);
    std::error_code none;
    fs::create_directories(work / ".nezumi", none);
    fs::path file = work / system_of(seat.pupil.exercise);
    if (seat.is_repairing) {
        file = work / stand_in;
        [[maybe_unused]] const auto written = write_whole(file, stand_in_text);
    }
    std::vector<std::string> words = confined_words(options_.program, work, options_.trust);
    words.insert(words.end(), {"run", file.string(), "--keep-going", "--page-on-input"});
    start(seat, std::move(words));
}

void Classroom::start(ClassSystem& system, std::vector<std::string> words) {
    system.out.clear();
    system.reader = {};
    system.view.forget();
    system.view_is_ready = true;
    system.run = std::make_unique<PupilRun>(std::move(words));
    const auto comes = [&](ClientId id, bool views) {
        system.tell({.kind = views ? RelayFrame::Kind::viewer : RelayFrame::Kind::opened, .client = id});
        if (id != own_client) system.tell({.kind = RelayFrame::Kind::ready, .client = id});
    };
    comes(own_client, false);
    for (const auto& [id, client] : clients_) {
        if (system_at(client.system) == &system) comes(id, is_spectator(client));
    }
    if (is_frozen_) system.tell(R"({"do":"time","what":"pause"})");
}

void Classroom::restart(ClassSystem& system) {
    if (system.run) {
        system.run->end();
        ending_.push_back(std::move(system.run));
    }
    for (auto& [id, client] : clients_) {
        if (system_at(client.system) == &system) close(client);  // the page connects again
    }
    system.view.forget();
    system.next_start = Clock::now();
}

void Classroom::ended(Seat& seat) {
    const auto now = Clock::now();
    const bool can_not_run = seat.note_end(now);
    const auto next_start = seat.next_start;
    restart(seat);
    if (!seat.is_repairing && can_not_run)
        seat.is_repairing = true;
    else
        seat.next_start = next_start;
}

void Classroom::upkeep(Clock::time_point now) {
    for (auto& run : ending_) run->hurry(now);
    std::erase_if(ending_, [&](const auto& run) { return run->has_ended(); });
    for (auto& [number, seat] : seats_) {
        if (seat->run) seat->run->hurry(now);
        if (seat->run && seat->run->has_ended()) ended(*seat);
        serve_page(*seat, now);
        // After the class was closed and opened again, a system starts only when its pupil has come back.
        if (!seat->run && seat->is_wanted && !seat->pupil.exercise.empty() && now >= seat->next_start) start(*seat);
    }
    serve_shared(now);
    if (now - looked_ > saves_every) {
        looked_ = now;
        for (auto& [number, seat] : seats_) {
            const Exercise* exercise = exercise_called(seat->pupil.exercise);
            if (!seat->run || exercise == nullptr) continue;
            const fs::path work = pupils_.work_of(seat->pupil);
            seat->last_save = look_at_work(work, exercise->start()).last_save;
            trim_versions(work, options_.quota.bytes);
            auto over = enforce_quota(work, exercise->start(), options_.quota);
            // While the pupil repairs the files, texts may still be too long: the system is not restarted for that.
            if (!over || (seat->is_repairing && over->removed == 0)) continue;
            close_page(*seat);
            restart(*seat);
            seat->is_repairing = true;
            seat->problem = std::move(over->why);
        }
    }
    if (now - shown_ < states_every) return;
    shown_ = now;
    const auto ask = [](ClassSystem& system) {
        if (std::exchange(system.view_is_ready, false))
            system.tell({.kind = RelayFrame::Kind::ready, .client = own_client});
    };
    for (auto& [number, seat] : seats_) {
        ask(*seat);
        if (seat->page) ask(*seat->page);
    }
    if (shared_) ask(*shared_);
    show_states();
}

void Classroom::show_states() {
    std::string teacher;
    for (auto& [id, client] : clients_) {
        if (client.waiting.size() > most_states || client.role == Role::reader) continue;
        std::string state;
        if (client.role == Role::visitor) {
            state = R"({"is":"class","role":"visitor"})";
        } else if (client.role == Role::teacher) {
            if (teacher.empty()) teacher = json_text(state_for_teacher());
            state = teacher;
        } else {
            state = json_text(state_for_pupil(client));
        }
        // An unchanged state is repeated, because a page takes a silent connection for a lost one.
        if (state == client.shown && shown_ - client.shown_at < repeated_every) continue;
        client.shown = state;
        client.shown_at = shown_;
        client.waiting.push_back({{.bytes = std::move(state)}, false});
    }
}

Classroom::Json Classroom::tile(const Seat& seat) const {
    const auto count = [&](Role role) {
        return std::count_if(clients_.begin(), clients_.end(), [&](const auto& each) {
            return each.second.role == role && each.second.pupil == seat.pupil.number;
        });
    };
    return {{"number", seat.pupil.number},
            {"name", seat.pupil.name},
            {"code", seat.pupil.code},
            {"exercise", seat.pupil.exercise},
            {"here", count(Role::pupil)},
            {"state", !seat.run           ? "off"
                      : seat.is_repairing ? "broken"
                                          : seat.view.state()},
            {"error", seat.is_repairing ? seat.problem : seat.view.error()},
            {"since", seat.view.error_since()},
            {"saved", seat.last_save},
            {"passed", passed(seat)},
            {"scenarios", seat.checked.size()},
            {"check", seat.check},
            {"memory", seat.run ? seat.run->memory() >> 20U : 0},
            {"mark", seat.pupil.mark},
            {"comment", seat.pupil.comment},
            {"help", seat.help_token},
            {"look", seat.look_token}};
}

Classroom::Json Classroom::state_for_teacher() const {
    Json state{{"is", "class"},
               {"role", "teacher"},
               {"frozen", is_frozen_},
               {"open", door_is_open_},
               {"projected", projected_},
               {"collected", collected_},
               {"first", first_exercise_},
               {"spectator", access_.view_token()}};
    state["address"] = origin_;
    Json exercises = Json::array();
    for (const Exercise& each : exercises_)
        exercises.push_back({{"name", each.name},
                             {"title", each.text.substr(0, each.text.find('\n'))},
                             {"title_ja", each.text_ja.substr(0, each.text_ja.find('\n'))}});
    state["exercises"] = std::move(exercises);
    Json tiles = Json::array();
    for (const auto& [number, seat] : seats_) tiles.push_back(tile(*seat));
    state["pupils"] = std::move(tiles);
    if (shared_) {
        state["shared"] = state_of_shared();
        state["shared"]["number"] = SharedSystem::number;
        state["shared"]["help"] = shared_->help_token;
    }
    return state;
}

Classroom::Json Classroom::state_for_pupil(const Client& client) const {
    if (client.system == SharedSystem::number) {
        Json state{{"is", "class"}, {"role", client.role == Role::guest ? "guest" : "shared"}, {"frozen", is_frozen_}};
        state["shared"] = client.role == Role::guest ? shared_for_pupil(client) : state_of_shared();
        if (client.role == Role::spectator) state["shared"].erase("waiting");
        return state;
    }
    const Seat& seat = *seats_.at(client.pupil);
    const auto is_there = [&](Role role) {
        return std::any_of(clients_.begin(), clients_.end(), [&](const auto& each) {
            return each.second.role == role && each.second.pupil == client.pupil;
        });
    };
    Json state{{"is", "class"},
               {"name", seat.pupil.name},
               {"frozen", is_frozen_},
               {"helps", is_there(Role::helper)},
               {"looks", is_there(Role::looker)},
               {"projected", projected_ == client.pupil},
               {"broken", seat.is_repairing ? seat.problem : ""}};
    if (client.role == Role::spectator) {
        state["role"] = "spectator";
        return state;
    }
    const bool is_own = client.role == Role::pupil;
    state["role"] = is_own ? "pupil" : client.role == Role::helper ? "helper" : "looker";
    if (is_own) state["code"] = seat.pupil.code;
    state["exercise"] = seat.pupil.exercise;
    if (const Exercise* exercise = exercise_called(seat.pupil.exercise)) {
        state["text"] = exercise->text;
        state["text_ja"] = exercise->text_ja;
    }
    state["hints"] = seat.pupil.hints;
    state["mark"] = seat.pupil.mark;
    state["comment"] = seat.pupil.comment;
    state["check"] = seat.check;
    // Pupils do not see the hidden scenarios, only how many of them pass.
    Json checked = Json::array();
    std::size_t hidden = 0, hidden_passed = 0;
    for (const CheckedScenario& each : seat.checked) {
        if (each.hidden) {
            ++hidden;
            hidden_passed += each.passed ? 1U : 0U;
        } else {
            checked.push_back({{"name", each.name}, {"passed", each.passed}});
        }
    }
    state["checked"] = std::move(checked);
    state["hidden"] = {{"passed", hidden_passed}, {"count", hidden}};
    if (is_own && shared_) state["shared"] = shared_for_pupil(client);
    return state;
}

Expected<void> Classroom::check_later(Seat& seat) {
    if (seat.check == "waits" || seat.check == "runs") return {};
    if (!jobs_->put([this, number = seat.pupil.number] { check_now(number); }))
        return failure("too many checks wait: try again in a minute");
    seat.check = "waits";
    return {};
}

void Classroom::check_now(int pupil) {
    WorkToCheck wanted{.program = options_.program, .trust = options_.trust};
    {
        const std::lock_guard lock(mutex_);
        Seat* seat = seat_of(pupil);
        const Exercise* exercise = seat == nullptr ? nullptr : exercise_called(seat->pupil.exercise);
        if (exercise == nullptr) return;
        seat->check = "runs";
        wanted.exercise = *exercise;
        wanted.work = pupils_.work_of(seat->pupil);
        wanted.scratch = options_.folder / "checks" / std::to_string(pupil);
    }
    auto checked = check_work(wanted, ends_);
    const std::lock_guard lock(mutex_);
    Seat* seat = seat_of(pupil);
    if (seat == nullptr || seat->pupil.exercise != wanted.exercise.name) return;
    seat->check = checked ? "" : describe(checked.error());
    seat->checked = checked ? std::move(*checked) : std::vector<CheckedScenario>();
}

Expected<Classroom::Json> Classroom::collect() {
    const std::time_t now = std::time(nullptr);  // the wall clock: the folder has the date of the collection
    std::tm local{};
    localtime_r(&now, &local);
    std::array<char, 32> stamp{};
    std::strftime(stamp.data(), stamp.size(), "%Y-%m-%d_%H%M%S", &local);
    const fs::path folder = options_.folder / "collected" / stamp.data();
    std::vector<PupilResult> results;
    for (const auto& [number, seat] : seats_) {
        const Pupil& pupil = seat->pupil;
        if (pupil.exercise.empty()) continue;
        const auto copied = collect_work(pupils_, pupil, folder);
        results.push_back({.number = number,
                           .name = pupil.name,
                           .exercise = pupil.exercise,
                           .problem = copied ? seat->check : describe(copied.error()),
                           .mark = pupil.mark,
                           .comment = pupil.comment,
                           .checked = seat->checked});
    }
    if (auto ok = write_results(folder, results); !ok) return Unexpected(ok.error());
    collected_ = folder.string();
    return Json{{"folder", collected_}};
}

}  // namespace nezumi::web
