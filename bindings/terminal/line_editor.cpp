// libedit draws and edits. This file adds printing above the line, pasting of several lines, and Ctrl-C without a
// signal.
#include "bindings/terminal/line_editor.hpp"

#include <fmt/format.h>
#include <histedit.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include "bindings/console/put_text.hpp"
#include "bindings/terminal/text_layout.hpp"
#include "bindings/terminal/tty_input.hpp"

namespace nezumi {
namespace {

// A single Escape is treated as this key: it ends a search and does not change a line.
constexpr const char* abort_key = "\a";

struct CloseFile {
    void operator()(FILE* file) const { fclose(file); }
};
using File = std::unique_ptr<FILE, CloseFile>;

std::string_view terminal_type() {
    const char* type = std::getenv("TERM");
    return type != nullptr ? type : "";
}

}  // namespace

struct LineEditor::Parts {
    Hooks hooks;
    bool may_stop = false;
    bool plain = false;
    bool titled = false;
    int input = -1;
    termios before{};
    locale_t locale = nullptr;
    locale_t locale_before = nullptr;
    File in, out;
    History* history = nullptr;
    EditLine* editor = nullptr;
    std::string prompt;
    std::string so_far;
    std::string typed;
    int width = 0;          // [columns] when libedit last read it
    int rows_in_place = 0;  // written by `print_in_place`, directly above the input
    bool editing = false;
    Outcome outcome = Outcome::input;
    std::string dropped;

    ~Parts();

    static Parts& of(EditLine* editor) {
        void* parts = nullptr;
        el_wget(editor, EL_CLIENTDATA, &parts);
        return *static_cast<Parts*>(parts);
    }
    int columns() const {
        winsize size{};
        return ioctl(input, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
    }
    int rows() const {
        winsize size{};
        return ioctl(input, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 ? size.ws_row : 24;
    }
    int cursor_row(int columns) const;
    int cursor_row() const { return cursor_row(columns()); }
    void follow_size();
    void draw_resized();
    void erase_input();
    void draw_input();
    void open_editor();
    void bind_keys();
    unsigned char complete();
    unsigned char insert_pasted();
    unsigned char stop();
};

LineEditor::Parts::~Parts() {
    if (titled) std::fputs("\x1b[23;2t", out.get());
    if (editor != nullptr) el_end(editor);
    if (history != nullptr) history_end(history);
    if (out) std::fflush(out.get());
    if (input >= 0) tcsetattr(input, TCSADRAIN, &before);
    if (locale != nullptr) {
        uselocale(locale_before);
        freelocale(locale);
    }
}

int LineEditor::Parts::cursor_row(int columns) const {
    const LineInfoW* line = el_wline(editor);
    const std::wstring text =
        to_wide(prompt) + std::wstring(line->buffer, static_cast<std::size_t>(line->cursor - line->buffer));
    return std::min(row_after(text, columns), rows() - 1);
}

// Tells libedit if the window was resized. The size is polled, because SIGWINCH belongs to the whole process.
void LineEditor::Parts::follow_size() {
    const int before_now = std::exchange(width, columns());
    if (width == before_now) return;
    el_resize(editor);
    rows_in_place = 0;  // lines may be wrapped differently now
}

// Called before a key, after the window was resized: libedit would draw at the wrong place, because it knows only the
// old size. An input of several rows is drawn once more below, because only some terminals wrap old rows again.
void LineEditor::Parts::draw_resized() {
    if (!editing || plain || columns() == width) return;
    const bool is_one_row = cursor_row(width) == 0 && cursor_row() == 0;
    std::fputs(is_one_row ? "\r\x1b[J" : "\r\n\x1b[J", out.get());
    draw_input();
}

void LineEditor::Parts::erase_input() {
    if (!editing) return;
    if (plain) {
        std::fputs("\n", out.get());
        return;
    }
    if (const int row = cursor_row(); row > 0) put_text(out.get(), fmt::format("\x1b[{}A", row));
    std::fputs("\r\x1b[J", out.get());
}

void LineEditor::Parts::draw_input() {
    follow_size();
    if (editing) el_wset(editor, EL_REFRESH);
    std::fflush(out.get());
}

unsigned char LineEditor::Parts::complete() {
    const LineInfoW* line = el_wline(editor);
    const std::wstring all(line->buffer, static_cast<std::size_t>(line->lastchar - line->buffer));
    const std::wstring before_cursor = all.substr(0, static_cast<std::size_t>(line->cursor - line->buffer));
    // At the beginning of a line within a block, Tab inserts an indentation.
    const std::size_t row = before_cursor.rfind(L'\n') + 1;
    const bool first = so_far.empty() && row == 0;
    if (!first && before_cursor.find_first_not_of(L" \t", row) == std::wstring::npos) {
        el_winsertstr(editor, L"  ");
        return CC_REFRESH;
    }
    const std::string text = so_far + to_utf8(all);
    const std::size_t cursor = so_far.size() + to_utf8(before_cursor).size();
    const Completion found = hooks.complete(text, cursor);
    if (found.candidates.empty() || found.from > cursor) return CC_REFRESH_BEEP;

    const std::string part = text.substr(found.from, cursor - found.from);
    const std::string common = common_beginning(found.candidates);
    if (common != part && common.size() >= part.size()) {
        el_wdeletestr(editor, static_cast<int>(to_wide(part).size()));
        el_winsertstr(editor, to_wide(common).c_str());
        return CC_REFRESH;
    }
    if (found.candidates.size() == 1) return CC_NORM;
    erase_input();
    rows_in_place = 0;
    std::fputs(in_columns(found.candidates, columns()).c_str(), out.get());
    draw_input();
    return CC_NORM;
}

unsigned char LineEditor::Parts::insert_pasted() {
    static constexpr std::wstring_view end = L"\x1b[201~";
    std::wstring text;
    wchar_t letter = 0;
    while (!text.ends_with(end)) {
        if (el_wgetc(editor, &letter) != 1) return CC_EOF;
        text += letter == L'\r' ? L'\n' : letter;
    }
    text.resize(text.size() - end.size());
    text.erase(text.find_last_not_of(L'\n') + 1);
    std::erase_if(text, [](wchar_t some) { return (some < L' ' && some != L'\n' && some != L'\t') || some == 0x7F; });
    if (text.empty()) return CC_NORM;
    return el_winsertstr(editor, text.c_str()) == 0 ? CC_REFRESH : CC_REFRESH_BEEP;
}

unsigned char LineEditor::Parts::stop() {
    if (!may_stop) return CC_NORM;
    termios editing_mode{};
    tcgetattr(input, &editing_mode);
    std::fputs(plain ? "\n" : "\x1b[?2004l\r\n", out.get());
    std::fflush(out.get());
    tcsetattr(input, TCSADRAIN, &before);
    raise(SIGTSTP);
    tcsetattr(input, TCSADRAIN, &editing_mode);
    if (!plain) std::fputs("\x1b[?2004h", out.get());
    draw_input();
    return CC_NORM;
}

void LineEditor::Parts::open_editor() {
    editor = el_init_fd("nezumi", in.get(), out.get(), out.get(), input, fileno(out.get()), fileno(out.get()));
    el_wset(editor, EL_CLIENTDATA, this);
    el_set(
        editor, EL_PROMPT, +[](EditLine* of_editor) { return of(of_editor).prompt.data(); });
    el_set(editor, EL_SIGNAL, 0);
    // Ctrl-C, Ctrl-Z, Ctrl-S and Ctrl-Q are ordinary keys, while a line is edited and while an input runs.
    for (const char* mode : {"-d", "-x"}) el_set(editor, EL_SETTY, mode, "-isig", "-ixon", nullptr);
    el_set(editor, EL_SETTY, "-x", "-icanon", "-echo", nullptr);
    el_wset(
        editor, EL_GETCFN, +[](EditLine* of_editor, wchar_t* letter) {
            Parts& parts = of(of_editor);
            for (;;) {
                // libedit would combine a single Escape with the next key, even a much later one.
                const bool may_be_lone = parts.typed == "\x1b";
                const auto taken = may_be_lone ? std::nullopt : take_character(parts.typed);
                if (taken) {
                    parts.draw_resized();
                    *letter = *taken;
                    return 1;
                }
                const Waited waited = parts.hooks.wait(parts.typed, may_be_lone ? escape_wait : -1);
                if (waited == Waited::end) return 0;
                if (waited == Waited::nothing) parts.typed = abort_key;
            }
        });
    el_set(editor, EL_EDITOR, "emacs");
    el_set(editor, EL_HIST, ::history, history);
    bind_keys();
}

void LineEditor::Parts::bind_keys() {
    using Action = unsigned char (*)(EditLine*, int);
    // Uses the wide functions, because el_set() copies the texts of EL_ADDFN and never frees them.
    const auto add = [&](const wchar_t* name, const wchar_t* help, Action action, const wchar_t* keys) {
        el_wset(editor, EL_ADDFN, name, help, action);
        el_wset(editor, EL_BIND, keys, name, nullptr);
    };
    add(
        L"nezumi-complete", L"completes", +[](EditLine* of_editor, int) { return of(of_editor).complete(); }, L"\\t");
    add(
        L"nezumi-paste", L"inserts what is pasted",
        +[](EditLine* of_editor, int) { return of(of_editor).insert_pasted(); }, L"\\e[200~");
    add(
        L"nezumi-stop", L"stops the process", +[](EditLine* of_editor, int) { return of(of_editor).stop(); }, L"^Z");
    const Action interrupt = +[](EditLine* of_editor, int) -> unsigned char {
        Parts& parts = of(of_editor);
        parts.outcome = Outcome::interrupted;
        // The whole input stays visible, and the next output is below it.
        const LineInfoW* line = el_wline(of_editor);
        const std::wstring_view text(line->buffer, static_cast<std::size_t>(line->lastchar - line->buffer));
        parts.erase_input();
        parts.dropped = to_utf8(text);
        put_text(parts.out.get(), parts.prompt + parts.dropped + "^C");
        return CC_EOF;
    };
    add(L"nezumi-interrupt", L"drops the input", interrupt, L"^C");
    add(
        L"nezumi-abort", L"does nothing", +[](EditLine*, int) -> unsigned char { return CC_NORM; }, L"^G");
    const Action leave = +[](EditLine* of_editor, int) -> unsigned char {
        const LineInfoW* line = el_wline(of_editor);
        if (line->lastchar == line->buffer) return CC_EOF;
        if (line->cursor == line->lastchar) return CC_REFRESH_BEEP;
        el_cursor(of_editor, 1);
        el_wdeletestr(of_editor, 1);
        return CC_REFRESH;
    };
    add(L"nezumi-leave", L"deletes a character, or leaves", leave, L"^D");

    static constexpr std::array<std::array<const char*, 2>, 22> keys{{
        {"\\e[A", "ed-prev-history"},  {"\\eOA", "ed-prev-history"},      {"\\e[B", "ed-next-history"},
        {"\\eOB", "ed-next-history"},  {"\\e[C", "ed-next-char"},         {"\\eOC", "ed-next-char"},
        {"\\e[D", "ed-prev-char"},     {"\\eOD", "ed-prev-char"},         {"\\e[H", "ed-move-to-beg"},
        {"\\eOH", "ed-move-to-beg"},   {"\\e[1~", "ed-move-to-beg"},      {"\\e[7~", "ed-move-to-beg"},
        {"\\e[F", "ed-move-to-end"},   {"\\eOF", "ed-move-to-end"},       {"\\e[4~", "ed-move-to-end"},
        {"\\e[8~", "ed-move-to-end"},  {"\\e[3~", "ed-delete-next-char"}, {"\\e[1;5C", "em-next-word"},
        {"\\e[1;5D", "ed-prev-word"},  {"^R", "em-inc-search-prev"},      {"^S", "em-inc-search-next"},
        {"^W", "ed-delete-prev-word"},
    }};
    for (const auto& [key, action] : keys) el_set(editor, EL_BIND, key, action, nullptr);
}

LineEditor::LineEditor(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
LineEditor::~LineEditor() = default;

Expected<std::unique_ptr<LineEditor>> LineEditor::create(int input, int output, bool may_stop, Hooks hooks) {
    const auto failed = [] { return failure(std::string("can't use the terminal: ") + std::strerror(errno)); };
    auto parts = std::make_unique<Parts>();
    parts->hooks = std::move(hooks);
    parts->may_stop = may_stop;
    parts->plain = terminal_type().empty() || terminal_type() == "dumb";
    if (tcgetattr(input, &parts->before) != 0) return failed();
    parts->in.reset(fdopen(dup(input), "r"));
    parts->out.reset(fdopen(dup(output), "w"));
    if (!parts->in || !parts->out) return failed();
    parts->input = input;
    // Sets the locale only for this thread; the process keeps its own.
    parts->locale = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    if (parts->locale != nullptr) parts->locale_before = uselocale(parts->locale);
    parts->history = history_init();
    HistEvent event{};
    ::history(parts->history, &event, H_SETSIZE, 1 << 20);
    ::history(parts->history, &event, H_SETUNIQUE, 1);
    parts->open_editor();
    return std::unique_ptr<LineEditor>(new LineEditor(std::move(parts)));
}

LineEditor::Outcome LineEditor::read(const std::string& so_far, std::string& input) {
    parts_->so_far = so_far;
    parts_->outcome = Outcome::input;
    if (!parts_->plain) std::fputs("\x1b[?2004h", parts_->out.get());
    parts_->follow_size();
    parts_->editing = true;
    int count = 0;
    const wchar_t* line = el_wgets(parts_->editor, &count);
    parts_->editing = false;
    if (!parts_->plain) std::fputs("\x1b[?2004l", parts_->out.get());
    if (line == nullptr || count <= 0) {
        if (parts_->outcome == Outcome::input) parts_->outcome = Outcome::end;
        if (parts_->outcome == Outcome::interrupted) input = parts_->dropped;
        std::fputs("\r\n", parts_->out.get());
    } else {
        input = to_utf8({line, static_cast<std::size_t>(count)});
        if (input.ends_with('\n')) input.pop_back();
    }
    parts_->rows_in_place = 0;
    std::fflush(parts_->out.get());
    return parts_->outcome;
}

void LineEditor::print(std::string_view lines) {
    parts_->erase_input();
    parts_->rows_in_place = 0;
    std::fwrite(lines.data(), 1, lines.size(), parts_->out.get());
    parts_->draw_input();
}

void LineEditor::print_in_place(std::string_view lines) {
    Parts& parts = *parts_;
    parts.follow_size();
    parts.erase_input();
    if (parts.rows_in_place > 0) put_text(parts.out.get(), fmt::format("\x1b[{}A\x1b[J", parts.rows_in_place));
    std::fwrite(lines.data(), 1, lines.size(), parts.out.get());
    int rows = 0;
    for (std::string_view rest = lines; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rows += row_after(to_wide(std::string(line)), parts.columns()) + 1;
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    }
    // Rows that have left the screen can't be overwritten.
    parts.rows_in_place = parts.plain || rows + 1 >= parts.rows() ? 0 : rows;
    parts.draw_input();
}

void LineEditor::set_prompt(std::string prompt) {
    if (prompt == parts_->prompt) return;
    parts_->erase_input();
    parts_->prompt = std::move(prompt);
    parts_->draw_input();
}

void LineEditor::set_title(std::string_view title) {
    if (parts_->plain || terminal_type() == "linux" || terminal_type().starts_with("vt")) return;
    if (!std::exchange(parts_->titled, true)) std::fputs("\x1b[22;2t", parts_->out.get());
    put_text(parts_->out.get(), fmt::format("\x1b]2;{}\a", title));
    std::fflush(parts_->out.get());
}

void LineEditor::remember(const std::string& input) {
    HistEvent event{};
    ::history(parts_->history, &event, H_ENTER, input.c_str());
}

bool LineEditor::is_plain() const { return parts_->plain; }
std::string& LineEditor::typed() { return parts_->typed; }

}  // namespace nezumi
