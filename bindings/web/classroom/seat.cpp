// Reads only what the teacher's tiles show from a pupil's process. The process is not trusted.
#include "bindings/web/classroom/seat.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/base/trimmed.hpp"

namespace nezumi::web {
namespace {

constexpr std::size_t longest_error = 500;  // [bytes] shown
// [bytes] that may wait for a process that does not read, for example because it is stopped. Above this, it is ended.
constexpr std::size_t most_waiting = std::size_t{8} << 20;

// A process that ends sooner than this after its start has failed. After `most_failures` failures in a row, the system
// file counts as broken.
constexpr std::chrono::seconds short_run{5};
constexpr int most_failures = 3;
constexpr int could_not_run = 2;  // exit status of `nezumi run` if the system can't run
constexpr std::chrono::seconds longest_wait{30};

// The position of WebFrame::running in a message: after 4 bytes for the kind, the time and the tick.
constexpr std::size_t place_of_running = 4 + 8 + 8;

}  // namespace

void SeatView::take(const RelayFrame& frame) {
    if (frame.kind == RelayFrame::Kind::binary) {
        const bool is_state = frame.bytes.size() > place_of_running && frame.bytes[0] == 1;
        if (is_state) running_ = frame.bytes[place_of_running] != 0;
        return;
    }
    if (!frame.bytes.starts_with(R"({"is":"system")")) return;
    const auto json = nlohmann::json::parse(frame.bytes, nullptr, false);
    if (!json.is_object()) return;
    described_ = true;
    stopped_ = json.value("stopped", nlohmann::json()) == true;
    std::string error;
    scripts_.clear();
    const auto components = json.find("components");
    if (components != json.end() && components->is_array()) {
        for (const auto& each : *components) {
            if (!each.is_object()) continue;
            const auto script = each.find("script");
            if (script != each.end() && script->is_string()) scripts_.push_back(script->get<std::string>());
            if (!error.empty() || each.value("state", nlohmann::json()) != "ERROR") continue;
            const auto text = each.find("error");
            error = text != each.end() && text->is_string() ? text->get<std::string>() : "ERROR";
        }
    }
    if (error.size() > longest_error) error.resize(longest_error);
    if (error.empty())
        error_since_ = 0;
    else if (error_.empty())
        error_since_ = Clock::to_time_t(Clock::now());
    error_ = std::move(error);
}

std::string SeatView::state() const {
    if (!described_) return "starting";
    if (!error_.empty()) return "error";
    if (stopped_) return "stopped";
    return running_ ? "runs" : "paused";
}

ClassSystem::ClassSystem() : help_token(make_token()), look_token(make_token()) {}

void ClassSystem::tell(const RelayFrame& frame) {
    if (!run) return;
    append_frame(out, frame);
    if (out.size() > most_waiting) run->end();
    flush();
}

void ClassSystem::tell(std::string_view message) {
    tell({.kind = RelayFrame::Kind::message, .client = own_client, .bytes = std::string(message)});
}

void ClassSystem::flush() {
    while (run && !out.empty()) {
        const ssize_t sent = send(run->socket(), out.data(), out.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent <= 0) return;
        out.erase(0, static_cast<std::size_t>(sent));
    }
}

bool ClassSystem::note_end(PupilRun::Clock::time_point now) {
    failures = now - run->begin() < short_run ? failures + 1 : 0;
    problem = std::string(trimmed(run->said()));
    if (const auto line = problem.rfind("nezumi: "); line != std::string::npos) problem = problem.substr(line + 8);
    const int doublings = std::min(failures, 5);
    next_start = now + std::min(longest_wait, std::chrono::seconds(1) * (1 << doublings));
    return (run->has_ended() && run->status() == could_not_run) || failures >= most_failures;
}

}  // namespace nezumi::web
