// Limits the number of rows, because a slider on the page has no more positions.
#include "bindings/web/remembered_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <variant>
#include <vector>

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_rows = 1500, most_poses = 12'000, most_marks = 300;
// Equal acts of one user within this time [s] get only one mark, for example those of a joystick.
constexpr double together = 0.5;
// The shortest time [s] between two rows of a plot, as in the page.
constexpr double between_values = 0.04;
// The number of rows of a plot, about.
constexpr double most_values = 6000;

struct Mark {
    double at = 0;
    std::string_view kind{};
    std::string text{};
};

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

std::string_view kind_of(const Act& act) {
    return std::holds_alternative<Reload>(act) || std::holds_alternative<Rollback>(act) ? "reload" : "act";
}

void add_acts(std::vector<Mark>& marks, const RunHistory& history, std::size_t branch, int start, double rate) {
    std::string last;
    double last_at = -1;
    for (std::size_t index = 0; index < history.branches()[branch].size(); ++index) {
        const PastEvent& event = history.event(branch, index);
        const auto* past = std::get_if<std::shared_ptr<const PastAct>>(&event.what);
        if (past == nullptr || event.when.start != start) continue;
        const double at = static_cast<double>(event.when.tick) / rate;
        std::string text = fmt::format("{} by {}", act_in_words(name_of((*past)->act)), to_text((*past)->who));
        const bool is_more = text == last && at - last_at < together;
        last_at = at;
        if (is_more) continue;
        marks.push_back({at, kind_of((*past)->act), text});
        last = std::move(text);
    }
}

}  // namespace

Expected<Json> remembered_to_json(RunningSystem& live, const std::string& branch, bool rows) {
    const RunHistory& history = live.history_until_now();
    const auto which = history.find(branch);
    if (!which) return failure(fmt::format("there is no branch '{}'", branch));
    const int start = history.branches()[*which].end.start;
    const double rate = live.system().settings().rate;
    const auto seconds = [&](const ActTime& when) { return static_cast<double>(when.tick) / rate; };
    Json json{{"is", "remembered"}, {"branch", branch}, {"marks", Json::array()}};
    std::vector<Mark> marks;
    add_acts(marks, history, *which, start, rate);
    if (const RememberedRun* run = live.remembered()) {
        using Kind = RememberedRun::Mark::Kind;
        for (auto& mark : run->marks(history, *which, start))
            marks.push_back({seconds(mark.when), mark.kind == Kind::error ? "error" : "collision", mark.text});
        if (rows) {
            const std::size_t robots = std::max<std::size_t>(1, live.system().robots().size());
            json["rows"] = json["things"] = Json::array();
            for (const auto& row : run->rows(history, *which, start, std::min(most_rows, most_poses / robots))) {
                Json numbers = Json::array({seconds(row.when)});
                for (const auto& pose : row.robots) {
                    for (const float value : {pose.x, pose.y, pose.heading})
                        numbers.push_back(rounded(static_cast<double>(value)));
                }
                json["rows"].push_back(std::move(numbers));
                for (const auto& [index, pose] : row.things) {
                    const auto& [place, turn] = pose;
                    Json thing = Json::array({seconds(row.when), index});
                    for (const double value : {place.x, place.y, place.z, turn.r, turn.p, turn.y})
                        thing.push_back(rounded(value));
                    json["things"].push_back(std::move(thing));
                }
            }
        }
    }
    std::stable_sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) { return a.at < b.at; });
    if (marks.size() > most_marks) marks.erase(marks.begin(), marks.end() - most_marks);
    for (const Mark& mark : marks) json["marks"].push_back({{"at", mark.at}, {"kind", mark.kind}, {"text", mark.text}});
    return json;
}

Json then_to_json(Trace& trace, double at, const std::vector<std::string>& names) {
    Json values = Json::object();
    for (const std::string& name : names) {
        const auto found = trace.remember_part(name);
        if (!found) continue;
        const Series& series = *found->series;
        // A value that is published in a tick can be read only after this tick.
        std::size_t after = 0;
        for (std::size_t end = series.size(); after < end;) {
            const std::size_t middle = (after + end) / 2;
            series.seconds(middle) < at - 1e-9 ? after = middle + 1 : end = middle;
        }
        if (after == 0) continue;
        Json leaves = Json::array();
        for (std::size_t label = 0; label < series.labels().size(); ++label) {
            const double value = series.value(after - 1, label);
            if (std::isnan(value)) continue;
            const bool is_text = series.is_text(label);
            leaves.push_back({series.labels()[label],
                              is_text ? Json(series.texts()[static_cast<std::size_t>(value)]) : Json(value)});
        }
        values[name] = {{"tm", series.seconds(after - 1)}, {"leaves", std::move(leaves)}};
    }
    return {{"is", "then"}, {"at", at}, {"values", std::move(values)}};
}

void add_numbers(Json& json, const Trace& trace, const std::string& port) {
    json["port"] = port;
    json["labels"] = json["values"] = Json::array();
    const Series* series = trace.remembered(port);
    if (series == nullptr) return;
    std::vector<std::size_t> columns;
    for (std::size_t label = 0; label < series->labels().size(); ++label) {
        if (series->is_text(label)) continue;
        columns.push_back(label);
        json["labels"].push_back(series->labels()[label]);
    }
    double last = -std::numeric_limits<double>::infinity();
    const double whole = series->size() > 0 ? series->seconds(series->size() - 1) - series->seconds(0) : 0;
    const double between = std::max(between_values, whole / most_values);
    for (std::size_t sample = 0; sample < series->size(); ++sample) {
        const double at = series->seconds(sample);
        if (at < last + between && sample + 1 < series->size()) continue;
        last = at;
        Json row = Json::array({at});
        for (const std::size_t label : columns) {
            const double value = series->value(sample, label);
            row.push_back(std::isfinite(value) ? Json(value) : Json());
        }
        json["values"].push_back(std::move(row));
    }
}

}  // namespace nezumi::web
