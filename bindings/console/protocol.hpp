// The console's protocol: requests and events as lines of JSON, the same for the prompt, attach and batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// A request of a client. As a line: {"do":"eval","id":1,"text":"ls()"}.
struct Request {
    enum class Kind {
        hello,        ///< says what the client wants; without it, it gets only answers and outputs
        eval,         ///< runs `text`; the `answer` comes when it is done
        complete,     ///< asks for completions of `text` at `cursor`; the answer is `completions`
        is_complete,  ///< asks whether `text` is complete; the answer is an `answer`
        interrupt,    ///< stops the running request immediately; has no answer
        key,          ///< a key for `drive`, named in `text`: up, down, left, right, space, escape, faster,
                      ///< slower; has no answer
    };

    Kind kind = Kind::eval;
    std::int64_t id = 0;     ///< chosen by the client; the answer has the same id
    std::string text;        ///< at most `max_line` bytes of UTF-8
    std::size_t cursor = 0;  ///< [bytes] in `text`, at most its size; default: the end of the text
    bool log = false;        ///< hello: the client wants log lines and the status
    bool keys = false;       ///< hello: the client has a keyboard and can send keys
    std::string who;         ///< hello: "spreadsheet", or "" for a console

    bool operator==(const Request&) const = default;
};

/// A message to a client. As a line: {"is":"answer","id":1,"ok":true}.
struct Event {
    enum class Kind {
        answer,       ///< to the request `id`; `ok`: it succeeded
        completions,  ///< to the request `id`: `items` can replace the text from byte `from` to the cursor
        output,       ///< one or more lines in `text`: results, prints, watches
        error,        ///< one or more lines in `text`: errors
        log,          ///< a log line; `level` is its level
        keys,         ///< whether keys are wanted from now on (`ok`): all, or `only_escape` as `text`
        status,       ///< the state of the system in one line, about once a second; `ok`: time passes
        lost,         ///< `count` outputs and log lines were dropped, because the client was too slow
        bye,          ///< the last event; `text` gives the reason
    };

    /// The `level` of an output that replaces the previous drawing in a terminal.
    static constexpr std::string_view in_place = "in_place";
    /// The `text` of `keys` if no other key is wanted.
    static constexpr const char* only_escape = "escape";

    Kind kind = Kind::output;
    std::int64_t id = 0;
    bool ok = true;
    std::string text;
    std::string level;
    std::size_t from = 0;
    std::size_t count = 0;
    std::vector<std::string> items;

    bool operator==(const Event&) const = default;
};

/// The longest line in both directions [bytes], without its end. Longer lines are refused.
inline constexpr std::size_t max_line = std::size_t{1} << 20;

/// The message as one line, with its end. Bytes that are not UTF-8 become replacement characters.
std::string to_line(const Request& request);
std::string to_line(const Event& event);

/// Reads one line, with or without its end. The error says in one line what is wrong.
Expected<Request> read_request(std::string_view line);
Expected<Event> read_event(std::string_view line);

/// Splits a stream into lines. Keeps at most one incomplete line of at most `limit` bytes.
class LineReader {
public:
    explicit LineReader(std::size_t limit = max_line) : limit_(limit) {}

    /// Takes the next piece. Fetch all its lines with `next` before the next piece.
    void feed(std::string_view piece);
    /// The next complete line without its end, an error for a line that was too long, or nothing at the end of the
    /// piece.
    std::optional<Expected<std::string>> next();

private:
    std::size_t limit_;
    std::string begun_;   // the line that is not complete yet
    std::string piece_;   // the last piece
    std::size_t at_ = 0;  // index into piece_
    bool too_long_ = false;
};

}  // namespace nezumi
