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
        nothing,  ///< time-out
        end,      ///< the terminal is closed
    };
    struct Hooks {
        /// Waits until more is typed and appends it to `typed`, for at most so many milliseconds (-1: without end); may
        /// call `print` meanwhile.
        std::function<Waited(std::string& typed, int milliseconds)> wait;
        /// Completions of the text before the cursor; may call `print`.
        std::function<Completion(const std::string& text, std::size_t cursor)> complete;
    };
    enum class Outcome {
        input,        ///< Enter
        interrupted,  ///< Ctrl-C
        end,          ///< Ctrl-D in an empty line, or there is no more
    };

    /// Takes over the terminal; an error when it is none. Must be used by the thread that made it only.
    static Expected<std::unique_ptr<LineEditor>> create(int input, int output, bool may_stop, Hooks hooks);
    /// Restores the terminal's settings.
    ~LineEditor();
    LineEditor(const LineEditor&) = delete;
    LineEditor& operator=(const LineEditor&) = delete;

    /// Reads an input, which has several lines if several were pasted. `so_far` is what was typed of it before. When
    /// it is interrupted, `input` is what was dropped.
    Outcome read(const std::string& so_far, std::string& input);
    /// Writes whole lines; an input that is being edited is drawn again below them.
    void print(std::string_view lines);
    /// The same for a drawing that is drawn anew: it takes the place of the one before, where nothing else was written
    /// since then and the terminal can.
    void print_in_place(std::string_view lines);
    /// Sets the prompt of the input that is edited now and of those that follow.
    void set_prompt(std::string prompt);
    /// Sets the terminal's title, where it has one.
    void set_title(std::string_view title);
    /// Adds the latest input to the history of the arrow keys and Ctrl-R.
    void remember(const std::string& input);
    /// Whether the terminal understands escape sequences, for colours.
    bool is_plain() const;
    /// Bytes that were typed and not yet consumed.
    std::string& typed();

private:
    struct Parts;
    explicit LineEditor(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace nezumi
