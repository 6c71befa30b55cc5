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
        typed,    ///< something was
        nothing,  ///< the time is over
        end,      ///< nothing more will be
    };
    struct Hooks {
        /// Waits until more is typed and appends it to `typed`, for at most so many milliseconds (-1: without end); may
        /// call `print` meanwhile.
        std::function<Waited(std::string& typed, int milliseconds)> wait;
        /// What could stand before the cursor; may call `print`.
        std::function<Completion(const std::string& text, std::size_t cursor)> complete;
    };
    enum class Outcome {
        input,        ///< Enter
        interrupted,  ///< Ctrl-C
        end,          ///< Ctrl-D in an empty line, or there is no more
    };

    /// Takes the terminal over; an error when it is none. One thread is to use it, the one that made it.
    static Expected<std::unique_ptr<LineEditor>> create(int input, int output, bool may_stop, Hooks hooks);
    /// Leaves the terminal as it was.
    ~LineEditor();
    LineEditor(const LineEditor&) = delete;
    LineEditor& operator=(const LineEditor&) = delete;

    /// Reads an input, which has several lines if several were pasted. `so_far` is what was typed of it before. When
    /// it is interrupted, `input` is what was dropped.
    Outcome read(const std::string& so_far, std::string& input);
    /// Writes whole lines; an input that is being edited comes back below them.
    void print(std::string_view lines);
    /// Of the input that is edited now, and of those that follow.
    void set_prompt(std::string prompt);
    /// The terminal's title, where it has one.
    void set_title(std::string_view title);
    /// The latest input, for the arrow keys and Ctrl-R.
    void remember(const std::string& input);
    /// Whether colours and the like are understood.
    bool is_plain() const;
    /// Bytes that were typed and not taken yet.
    std::string& typed();

private:
    struct Parts;
    explicit LineEditor(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

}  // namespace nezumi
