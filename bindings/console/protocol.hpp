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

/// What a client asks. As a line: {"do":"eval","id":1,"text":"ls()"}.
struct Request {
    enum class Kind {
        hello,        ///< says what the client wants; without it nothing but answers and output comes
        eval,         ///< runs `text`; answered when it is done, by an `answer`
        complete,     ///< what could stand before `cursor` in `text`; answered by `completions`
        is_complete,  ///< whether `text` can be run as it is; answered by an `answer`
        interrupt,    ///< ends what runs, at once: not answered
        key,          ///< a key for `drive`, named by `text`: up, down, left, right, space, escape,
                      ///< faster, slower; not answered
    };

    Kind kind = Kind::eval;
    std::int64_t id = 0;     ///< of the client's choice; the answer carries it
    std::string text;        ///< at most `max_line` bytes of UTF-8
    std::size_t cursor = 0;  ///< [bytes] in `text`, at most its size; its end when a line does not say
    bool log = false;        ///< hello: log lines and the status are wanted
    bool keys = false;       ///< hello: keys can be sent, there is a keyboard
    std::string who;         ///< hello: "spreadsheet", or "" for a console

    bool operator==(const Request&) const = default;
};

/// What a client is told. As a line: {"is":"answer","id":1,"ok":true}.
struct Event {
    enum class Kind {
        answer,       ///< to the request `id`: `ok`
        completions,  ///< to the request `id`: `items` may stand from byte `from` to the cursor
        output,       ///< `text` of one or more lines: results, prints, watches
        error,        ///< the same of what went wrong
        log,          ///< a log line, written out; `level` says how loud
        keys,         ///< from now on keys are wanted (`ok`), or no longer
        status,       ///< the system's state in one line, about once a second; `ok`: time passes
        lost,         ///< `count` outputs and log lines were left out, as they came faster than the client took them
        bye,          ///< nothing comes any more; `text` says why
    };

    /// `level` of an output that is a drawing drawn anew: a terminal shows it in place of the one before.
    static constexpr std::string_view in_place = "in_place";

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

/// The longest line of either side [bytes], its end not counted: what is longer is refused.
inline constexpr std::size_t max_line = std::size_t{1} << 20;

/// One line, with its end. Bytes that are no UTF-8 become replacement characters.
std::string to_line(const Request& request);
std::string to_line(const Event& event);

/// Reads one line, its end not needed. The error says in one line what is wrong with it.
Expected<Request> read_request(std::string_view line);
Expected<Event> read_event(std::string_view line);

/// Cuts what comes in pieces into lines, and never keeps more than one line of at most `limit` bytes.
class LineReader {
public:
    explicit LineReader(std::size_t limit = max_line) : limit_(limit) {}

    /// Takes the next piece. Every line that it ends must be fetched by `next` before the next piece.
    void feed(std::string_view piece);
    /// The next whole line without its end; an error for one that was too long; nothing when the piece is used up.
    std::optional<Expected<std::string>> next();

private:
    std::size_t limit_;
    std::string begun_;   // of the line that has not ended
    std::string piece_;   // what was fed last
    std::size_t at_ = 0;  // in piece_
    bool too_long_ = false;
};

}  // namespace nezumi
