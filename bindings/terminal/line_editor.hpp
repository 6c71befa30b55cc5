// Edits an input on a terminal with libedit, while other text may be printed above it at any time.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "bindings/console/session.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

class LineEditor {
public:
    enum class Waited {
        typed,    ///< bytes were typed
        nothing,  ///< the time is over
        end,      ///< the terminal is closed
    };
    struct Hooks {
        /// Waits until more is typed, for at most this time (-1: no limit), and appends it to `typed`. May call
        /// `print`.
        std::function<Waited(std::string& typed, int milliseconds)> wait;
        /// Completions of the text before the cursor; may call `print`.
        std::function<Completion(const std::string& text, std::size_t cursor)> complete;
    };
    enum class Outcome {
        input,        ///< Enter
        interrupted,  ///< Ctrl-C
        end,          ///< Ctrl-D in an empty line, or end of input
    };

    /// Takes over the terminal. Fails if it is not a terminal. Must be used only by the thread that made it.
    static Expected<std::unique_ptr<LineEditor>> create(int input, int output, bool may_stop, Hooks hooks);
    /// Restores the terminal's settings.
    ~LineEditor();
    LineEditor(const LineEditor&) = delete;
    LineEditor& operator=(const LineEditor&) = delete;

    /// Reads an input; pasted text may have several lines. `so_far` is the part typed before. After an interruption
    /// `input` is the dropped text.
    Outcome read(const std::string& so_far, std::string& input);
    /// Writes whole lines; the edited input is redrawn below them.
    void print(std::string_view lines);
    /// Writes a drawing that changes: it replaces the previous one if nothing else was written since and the
    /// terminal allows it.
    void print_in_place(std::string_view lines);
    /// Sets the prompt of the present input and the following ones.
    void set_prompt(std::string prompt);
    /// Sets the terminal's title, if it has one.
    void set_title(std::string_view title);
    /// Adds the latest input to the history of the arrow keys and Ctrl-R.
    void remember(const std::string& input);
    /// True if the terminal does not understand escape sequences.
    bool is_plain() const;
    /// Bytes that were typed but not used yet.
    std::string& typed();

private:
    struct Parts;
    explicit LineEditor(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace nezumi
