// Sends a command after the previous one was answered, so that output has the order of the commands.
#include "bindings/terminal/batch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <string_view>
#include <utility>

#include "bindings/console/input_text.hpp"
#include "bindings/console/put_text.hpp"
#include "engine/base/visible.hpp"

namespace nezumi {
namespace {

class Batch {
public:
    Batch(ConsoleClient& client, const BatchFiles& files) : client_(client), files_(files) {}

    BatchEnd run_all();
    /// Sets the time limit of each following command [s].
    void limit(double seconds) { longest_ = std::chrono::duration<double>(seconds); }
    /// Whether some output was lost.
    bool has_lost() const { return lost_ || left_out_; }
    /// Runs a command. `line` is the number of its first line in the file; 0 if it is not from a file.
    bool run(const std::string& text, int line);

private:
    std::optional<std::string> read_line();
    std::optional<std::string> give_up_input();
    bool has_more_input();
    bool is_cut_off();  // whether the system ended without a `bye`; reports this once
    std::optional<Event> wait_for_answer(std::int64_t id);
    void show(const Event& event);
    void tell(const std::string& text) const { put_text(files_.error, visible(text) + "\n"); }
    std::string place(std::string_view message) const;

    ConsoleClient& client_;
    BatchFiles files_;
    LineReader reader_;
    bool ended_ = false;     // end of the input
    bool lost_ = false;      // the output is closed
    bool left_out_ = false;  // the system has dropped output that it could not send in time
    bool unread_ = false;    // the input can't be read to its end
    bool fed_ = false;       // the reader may hold another line
    bool bye_ = false;       // the system has announced its end
    bool told_ = false;
    int first_line_ = 0;  // of the running command
    int unfinished_ = 0;  // line of the first command without an answer
    std::optional<std::chrono::duration<double>> longest_;
};

BatchEnd Batch::run_all() {
    bool well = true;
    std::string text;
    int first = 1;
    int line = 1;
    for (; client_.is_open() && !lost_; ++line) {
        auto next = read_line();
        if (next) text += (text.empty() ? "" : "\n") + *next;
        if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
            text.clear();
        } else if (!next || is_complete_input(text)) {
            well = run(std::exchange(text, {}), first) && well;
        } else {
            continue;
        }
        if (!next) break;
        first = line + 1;
    }
    if (!client_.is_open() && unfinished_ == 0 && has_more_input()) unfinished_ = line;
    return {.well = !is_cut_off() && well && !has_lost() && !unread_, .unfinished = unfinished_};
}

// Whether the input has another command; never blocks.
bool Batch::has_more_input() {
    const auto says_something = [](std::string_view text) {
        return text.find_first_not_of(" \t\r\n") != std::string_view::npos;
    };
    while (auto line = reader_.next()) {
        if (!*line || says_something(**line)) return true;
    }
    pollfd polled{.fd = files_.input, .events = POLLIN, .revents = 0};
    std::array<char, 65536> piece{};
    while (!ended_ && poll(&polled, 1, 0) > 0) {
        const ssize_t got = read(files_.input, piece.data(), piece.size());
        if (got <= 0) return false;
        if (says_something({piece.data(), static_cast<std::size_t>(got)})) return true;
    }
    return false;
}

bool Batch::run(const std::string& text, int line) {
    first_line_ = line;
    const auto answer = wait_for_answer(client_.send({.kind = Request::Kind::eval, .text = text}));
    if (answer) return answer->ok;
    if (unfinished_ == 0) unfinished_ = line;
    if (is_cut_off()) return false;
    if (!files_.own) tell(place("the system has ended"));
    return files_.own;
}

std::optional<std::string> Batch::give_up_input() {
    tell(fmt::format("the commands can't be read: {}", std::strerror(errno)));
    ended_ = unread_ = true;
    return std::nullopt;
}

bool Batch::is_cut_off() {
    if (client_.is_open() || bye_) return false;
    if (!std::exchange(told_, true)) tell(place("the connection to the system is lost"));
    return true;
}

std::optional<std::string> Batch::read_line() {
    for (;;) {
        if (fed_) {
            auto line = reader_.next();
            fed_ = line.has_value();
            if (line && *line) return std::move(**line);
            if (line) return "error('" + line->error().message + "', 0)";
        }
        if (ended_ || !client_.is_open()) return std::nullopt;
        std::array<pollfd, 2> polled{{{.fd = files_.input, .events = POLLIN, .revents = 0},
                                      {.fd = client_.file(), .events = POLLIN, .revents = 0}}};
        if (poll(polled.data(), polled.size(), -1) < 0) {
            if (errno == EINTR) continue;
            return give_up_input();
        }
        if (polled[1].revents != 0) {
            while (const auto event = client_.next(0)) show(*event);
        }
        if (polled[0].revents == 0) continue;
        std::array<char, 65536> piece{};
        const ssize_t got = read(files_.input, piece.data(), piece.size());
        if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (got < 0) return give_up_input();
        ended_ = got == 0;
        // The last line may lack its line end.
        reader_.feed(ended_ ? "\n" : std::string_view(piece.data(), static_cast<std::size_t>(got)));
        fed_ = true;
    }
}

std::optional<Event> Batch::wait_for_answer(std::int64_t id) {
    const auto begin = std::chrono::steady_clock::now();
    for (;;) {
        int left = -1;
        if (longest_) {
            const auto rest = *longest_ - (std::chrono::steady_clock::now() - begin);
            left = static_cast<int>(std::clamp(std::chrono::duration<double, std::milli>(rest).count(), 0.0, 1e6));
        }
        auto event = client_.next(left);
        if (!event && left == 0) {
            client_.send({.kind = Request::Kind::interrupt, .text = {}});
            tell(fmt::format("no answer within {:g} s: interrupted", longest_->count()));
            return Event{.kind = Event::Kind::answer, .ok = false, .text = {}};
        }
        if (!event && client_.is_open()) continue;  // a signal
        if (!event) return std::nullopt;
        if (event->kind == Event::Kind::answer && event->id == id) return event;
        show(*event);
    }
}

void Batch::show(const Event& event) {
    switch (event.kind) {
        case Event::Kind::output:
            lost_ = !put_text(files_.out, visible(event.text) + "\n") || std::fflush(files_.out) != 0 || lost_;
            return;
        case Event::Kind::error: tell(place(event.text)); return;
        case Event::Kind::log: tell(event.text); return;
        case Event::Kind::lost:
            left_out_ = true;
            return tell(fmt::format("({} more messages were dropped)", event.count));
        case Event::Kind::answer:
        case Event::Kind::completions:
        case Event::Kind::keys:
        case Event::Kind::status: return;
        case Event::Kind::bye: bye_ = true; return;
    }
}

// Converts line numbers within a command to those of the file.
std::string Batch::place(std::string_view message) const {
    if (first_line_ == 0) return std::string(message);
    static constexpr std::string_view word = "line ";
    int within = 1;
    if (message.starts_with(word)) {
        int line = 0;
        const char* const end = message.data() + message.size();
        const auto [rest, error] = std::from_chars(message.data() + word.size(), end, line);
        if (error == std::errc{} && std::string_view(rest, static_cast<std::size_t>(end - rest)).starts_with(": ")) {
            within = line;
            message = std::string_view(rest + 2, static_cast<std::size_t>(end - rest - 2));
        }
    }
    return fmt::format("line {}: {}", first_line_ + within - 1, message);
}

}  // namespace

BatchEnd run_batch(ConsoleClient& client, const BatchFiles& files) {
    client.send({.kind = Request::Kind::hello, .text = {}, .log = true});
    return Batch(client, files).run_all();
}

bool run_text(ConsoleClient& client, const std::string& text, const BatchFiles& files, std::optional<double> timeout) {
    Batch batch(client, files);
    if (timeout) batch.limit(*timeout);
    return batch.run(text, 0) && !batch.has_lost();
}

}  // namespace nezumi
