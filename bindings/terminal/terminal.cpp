// Waits for the terminal and for the system together, so that neither blocks the other.
#include "bindings/terminal/terminal.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "bindings/console/input_text.hpp"
#include "bindings/terminal/input_history.hpp"
#include "bindings/terminal/line_editor.hpp"
#include "bindings/terminal/tty_input.hpp"
#include "engine/base/visible.hpp"

namespace nezumi {
namespace {

constexpr std::string_view prompt = "nezumi> ";
constexpr std::string_view paused_prompt = "nezumi (paused)> ";
constexpr std::string_view more_prompt = "     >> ";

// A second Ctrl-C within this time leaves the prompt.
constexpr std::chrono::seconds leave_wait{2};

class Prompt {
public:
    Prompt(ConsoleClient& client, const TerminalOptions& options)
        : client_(client), options_(options), history_(options.history) {}

    Expected<PromptEnd> run();

private:
    enum class Came { typed, event, nothing, end };

    bool read_input(std::string& input);
    bool leaves_at_second();
    void evaluate(const std::string& input);
    Completion complete(const std::string& text, std::size_t cursor);
    void keep(const std::string& input);
    std::optional<Event> wait_for_answer(std::int64_t id);
    Came wait(int timeout);
    bool take_keys(bool alone);
    void interrupt();
    void show_events();
    void show(const Event& event, std::string& text);
    std::string coloured(const Event& event) const;
    std::string_view prompt_of(bool begun) const { return begun ? more_prompt : paused_ ? paused_prompt : prompt; }
    bool ended() const { return ended_ || !client_.is_open(); }

    ConsoleClient& client_;
    const TerminalOptions& options_;
    HistoryFile history_;
    std::unique_ptr<LineEditor> editor_;
    std::string latest_;           // the last input
    std::optional<Event> answer_;  // the last one received
    bool begun_ = false;           // the input has lines already
    bool paused_ = false;
    std::optional<std::chrono::steady_clock::time_point> asked_;  // when `leaves_at_second` explained how to leave
    bool keys_ = false;                                           // keys go to `drive`, or Escape to a seek
    bool only_escape_ = false;                                    // other keys are typed for the next input
    bool ended_ = false;                                          // the system has ended
    bool hung_up_ = false;                                        // the terminal is closed
    bool history_fails_ = false;
};

Expected<PromptEnd> Prompt::run() {
    auto editor = LineEditor::create(
        options_.input, options_.output, options_.attached,
        {.wait =
             [this](std::string&, int milliseconds) {
                 while (true) {
                     const Came came = wait(milliseconds);
                     if (came == Came::typed) return LineEditor::Waited::typed;
                     if (came == Came::nothing) return LineEditor::Waited::nothing;
                     if (came == Came::end) return LineEditor::Waited::end;
                 }
             },
         .complete = [this](const std::string& text, std::size_t cursor) { return complete(text, cursor); }});
    if (!editor) return Unexpected(editor.error());
    editor_ = std::move(*editor);
    for (const std::string& input : history_.read()) editor_->remember(latest_ = input);
    client_.send({.kind = Request::Kind::hello, .text = {}, .log = true, .keys = true});
    if (!options_.greeting.empty()) editor_->print(options_.greeting + "\n");

    std::string input;
    while (read_input(input)) {
        if (input.find_first_not_of(" \t\n") == std::string::npos) continue;
        keep(input);
        evaluate(input);
    }
    return ended() ? PromptEnd::ended : PromptEnd::left;
}

// Returns false at the end of input.
bool Prompt::read_input(std::string& input) {
    input.clear();
    begun_ = false;
    while (!ended() && !hung_up_) {
        editor_->set_prompt(std::string(prompt_of(begun_)));
        std::string line;
        switch (editor_->read(input, line)) {
            case LineEditor::Outcome::interrupted:
                if (!begun_ && line.empty() && leaves_at_second()) return false;
                interrupt();
                input.clear();
                begun_ = false;
                continue;
            case LineEditor::Outcome::end:
                if (!begun_ || ended() || hung_up_) return false;
                // Ctrl-D within an input of several lines only drops the input.
                input.clear();
                begun_ = false;
                continue;
            case LineEditor::Outcome::input: asked_.reset(); break;
        }
        input += line;
        if (is_complete_input(input)) return !ended();
        input += "\n";
        begun_ = true;
    }
    return false;
}

// Called after a Ctrl-C without an input: explains how to leave, unless it was just explained.
bool Prompt::leaves_at_second() {
    const auto now = std::chrono::steady_clock::now();
    if (asked_ && now - *asked_ <= leave_wait) return true;
    asked_ = now;
    editor_->print(options_.attached ? "Ctrl-C again, or Ctrl-D, leaves; the system continues\n"
                                     : "Ctrl-C again, or Ctrl-D, ends the run\n");
    return false;
}

void Prompt::keep(const std::string& input) {
    if (input == latest_ || input.front() == ' ') return;
    latest_ = input;
    editor_->remember(input);
    const auto kept = history_.append(input);
    if (!kept && !std::exchange(history_fails_, true)) editor_->print(kept.error().message + "\n");
}

void Prompt::evaluate(const std::string& input) {
    wait_for_answer(client_.send({.kind = Request::Kind::eval, .text = input}));
}

Completion Prompt::complete(const std::string& text, std::size_t cursor) {
    const auto answer =
        wait_for_answer(client_.send({.kind = Request::Kind::complete, .text = text, .cursor = cursor}));
    if (!answer) return {};
    return {.from = answer->from, .candidates = answer->items};
}

std::optional<Event> Prompt::wait_for_answer(std::int64_t id) {
    answer_.reset();
    bool undecided = false;
    while (!(answer_ && answer_->id == id) || keys_) {
        // An arrow key sends several bytes at once, the first is Escape. If nothing follows soon, it is the key Escape.
        const Came came = wait(undecided ? escape_wait : -1);
        if (came == Came::end) return std::nullopt;
        undecided = keys_ && take_keys(came == Came::nothing && undecided);
        const std::size_t interrupted = editor_->typed().find('\x03');
        if (interrupted == std::string::npos) continue;
        // Ctrl-C also drops what was typed before it.
        editor_->typed().erase(0, interrupted + 1);
        interrupt();
    }
    return answer_;
}

void Prompt::interrupt() { client_.send({.kind = Request::Kind::interrupt, .text = {}}); }

// Sends the typed keys to the system. Returns whether the remaining bytes may be the beginning of a key.
bool Prompt::take_keys(bool alone) {
    static constexpr std::array<std::string_view, 8> names{"up",    "down",   "left",   "right",
                                                           "space", "escape", "faster", "slower"};
    std::string& typed = editor_->typed();
    for (std::size_t at = 0; at < typed.size() && typed[at] != '\x03';) {
        const TypedKey key = next_key(std::string_view(typed).substr(at), alone);
        if (key.size == 0) return true;
        const bool is_kept = only_escape_ && key.key != Key::escape;
        if (is_kept) {
            at += key.size;
            continue;
        }
        typed.erase(at, key.size);
        if (key.key)
            client_.send({.kind = Request::Kind::key, .text = std::string(names[static_cast<std::size_t>(*key.key)])});
    }
    return false;
}

Prompt::Came Prompt::wait(int timeout) {
    if (ended()) return Came::end;
    std::array<pollfd, 2> files{{{.fd = options_.input, .events = POLLIN, .revents = 0},
                                 {.fd = client_.file(), .events = POLLIN, .revents = 0}}};
    const int found = poll(files.data(), files.size(), timeout);
    if (found == 0) return Came::nothing;
    if (found < 0) return errno == EINTR ? Came::event : Came::end;
    if (files[1].revents != 0) {
        show_events();
        if (ended()) return Came::end;
    }
    if (files[0].revents == 0) return Came::event;
    std::array<char, 4096> piece{};
    const ssize_t got = read(options_.input, piece.data(), piece.size());
    if (got > 0) {
        editor_->typed().append(piece.data(), static_cast<std::size_t>(got));
        return Came::typed;
    }
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) return Came::event;
    hung_up_ = true;
    return Came::end;
}

void Prompt::show_events() {
    // Prints all waiting output in one call, so that the edited line is redrawn only once.
    std::string text;
    while (auto event = client_.next(0)) {
        if (event->kind == Event::Kind::output && event->level == Event::in_place) {
            if (!text.empty()) editor_->print(std::exchange(text, {}));
            editor_->print_in_place(visible(event->text) + "\n");
            continue;
        }
        show(*event, text);
    }
    if (!text.empty()) editor_->print(text);
    editor_->set_prompt(std::string(prompt_of(begun_)));
}

void Prompt::show(const Event& event, std::string& text) {
    switch (event.kind) {
        case Event::Kind::answer:
        case Event::Kind::completions: answer_ = event; return;
        case Event::Kind::output:
        case Event::Kind::error:
        case Event::Kind::log: text += coloured(event) + "\n"; return;
        case Event::Kind::lost:
            text += "(" + std::to_string(event.count) + " more messages were dropped: this terminal is too slow)\n";
            return;
        case Event::Kind::keys:
            keys_ = event.ok;
            only_escape_ = event.text == Event::only_escape;
            return;
        case Event::Kind::status:
            paused_ = !event.ok;
            editor_->set_title(visible(event.text));
            return;
        case Event::Kind::bye:
            ended_ = true;
            if (options_.attached && !event.text.empty()) text += visible(event.text) + "\n";
            return;
    }
}

std::string Prompt::coloured(const Event& event) const {
    std::string plain = visible(event.text);
    const char* none = std::getenv("NO_COLOR");
    if (editor_->is_plain() || (none != nullptr && none[0] != '\0')) return plain;
    const bool wrong = event.kind == Event::Kind::error || event.level == "error";
    if (wrong) return "\x1b[31m" + plain + "\x1b[0m";
    if (event.level == "warn") return "\x1b[33m" + plain + "\x1b[0m";
    if (event.level == "debug") return "\x1b[2m" + plain + "\x1b[0m";
    return plain;
}

}  // namespace

Expected<PromptEnd> run_prompt(ConsoleClient& client, const TerminalOptions& options) {
    return Prompt(client, options).run();
}

}  // namespace nezumi
