// Pages of runs that pupils open. Each run is a process in the pupil's copy, confined as the pupil's system is.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bindings/web/classroom/check_work.hpp"
#include "bindings/web/classroom/classroom.hpp"
#include "bindings/web/scenario_runs.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

// The run of a page ends if no browser shows the page for this time. A page that is loaded again comes back sooner.
constexpr std::chrono::seconds longest_absence{20};

std::string field_in(const Json& request, const char* name) {
    const auto found = request.find(name);
    return found != request.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

Expected<void> Classroom::open_page(const Client& client, ClientId id, const Json& request) {
    Seat* seat = seat_of(client.pupil);
    if (seat == nullptr || (client.role != Role::pupil && client.role != Role::helper))
        return failure("this page has no permission for that: open your own link of the class");
    const auto number = request.value("id", Json());
    if (!number.is_number_integer()) return failure("'id' must be a number");
    const auto work = pupils_.work_of(seat->pupil);
    const auto words =
        words_of_page({.what = field_in(request, "what") == "open" ? TestMessage::What::open : TestMessage::What::watch,
                       .file = field_in(request, "file"),
                       .name = field_in(request, "name")},
                      work);
    if (!words) return Unexpected(words.error());
    close_page(*seat);
    seat->page = std::make_unique<OpenedPage>(id, number.get<std::int64_t>());
    auto all = confined_words(options_.program, work, options_.trust);
    all.insert(all.end(), words->begin(), words->end());
    all.emplace_back("--page-on-input");
    start(*seat->page, std::move(all));
    return {};
}

void Classroom::close_page(Seat& seat) {
    if (!seat.page) return;
    restart(*seat.page);
    seat.page.reset();
}

void Classroom::serve_page(Seat& seat, Clock::time_point now) {
    if (!seat.page) return;
    OpenedPage& page = *seat.page;
    const bool has_ended = !page.run || page.run->has_ended() || page.run->is_ending();
    if (!page.is_answered && (has_ended || page.view.is_described())) {
        page.is_answered = true;
        if (has_ended) page.note_end(now);
        if (const auto asker = clients_.find(page.asker); asker != clients_.end())
            send(asker->second, {{"is", "answer"},
                                 {"id", page.question},
                                 {"ok", !has_ended},
                                 {"text", has_ended ? page.problem : ""},
                                 {"content", "/index.html#" + page.help_token}});
    }
    const bool is_shown = std::any_of(clients_.begin(), clients_.end(), [&](const auto& each) {
        return each.second.role == Role::reader && each.second.pupil == seat.pupil.number;
    });
    if (is_shown || !page.is_answered) page.seen = now;
    if (has_ended || now - page.seen > longest_absence) close_page(seat);
}

}  // namespace nezumi::web
