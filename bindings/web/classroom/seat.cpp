// Only what tiles show is read; a pupil's process is not trusted.
#include "bindings/web/classroom/seat.hpp"

#include <sys/socket.h>

#include <cstring>
#include <nlohmann/json.hpp>

namespace nezumi::web {
namespace {

constexpr std::size_t longest_error = 500;  // [bytes] shown
// [bytes] that may wait for a process which does not read, as one that the kernel has stopped.
constexpr std::size_t most_waiting = std::size_t{8} << 20;

// WebFrame begins with the time, the tick and whether it runs; before it are 4 bytes for the kind of frame.
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
    const auto components = json.find("components");
    if (components != json.end() && components->is_array()) {
        for (const auto& each : *components) {
            if (!each.is_object() || each.value("state", nlohmann::json()) != "ERROR") continue;
            const auto text = each.find("error");
            error = text != each.end() && text->is_string() ? text->get<std::string>() : "ERROR";
            break;
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

void Seat::tell(const RelayFrame& frame) {
    if (!run) return;
    append_frame(out, frame);
    if (out.size() > most_waiting) run->end();
    flush();
}

void Seat::flush() {
    while (run && !out.empty()) {
        const ssize_t sent = send(run->socket(), out.data(), out.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent <= 0) return;
        out.erase(0, static_cast<std::size_t>(sent));
    }
}

}  // namespace nezumi::web
