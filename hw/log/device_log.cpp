// The fields of a line are separated by one blank. Texts are quoted, with non-printable characters escaped.
#include "hw/log/device_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/number_in.hpp"

namespace nezumi::hw {
namespace {

using Kind = DeviceCall::Kind;

constexpr std::string_view header = "nezumi device log 1";
constexpr double longest_run = 1e7;  // [s]

constexpr std::array<std::pair<Kind, std::string_view>, 6> names{{{Kind::open_read, "open-read"},
                                                                  {Kind::open_write, "open-write"},
                                                                  {Kind::read, "read"},
                                                                  {Kind::write, "write"},
                                                                  {Kind::list, "list"},
                                                                  {Kind::keys, "keys"}}};
constexpr std::string_view never = "never";  // written instead of the duration if the call did not return

std::string quoted_text(std::string_view text) {
    std::string all = "\"";
    for (const char each : text) {
        const auto byte = static_cast<unsigned char>(each);
        if (each == '\n') {
            all += "\\n";
        } else if (each == '"' || each == '\\') {
            all += '\\';
            all += each;
        } else if (byte < 0x20 || byte > 0x7e) {
            all += fmt::format("\\x{:02x}", byte);
        } else {
            all += each;
        }
    }
    return all + '"';
}

std::string error_name(int error) {
    const char* name = strerrorname_np(error);
    return name != nullptr ? name : fmt::format("E{}", error);
}

// The errno for the name "EIO" or "E5"; 0: unknown.
int error_number(std::string_view name) {
    constexpr int most = 4095;  // the kernel's largest
    if (!name.starts_with('E')) return 0;
    for (int error = 1; error < most; ++error) {
        if (const char* its = strerrorname_np(error); its != nullptr && name == its) return error;
    }
    const int number = number_in<int>(name.substr(1)).value_or(0);
    return number > 0 && number < most && error_name(number) == name ? number : 0;
}

// Splits a line into words.
class Words {
public:
    explicit Words(std::string_view line) : rest_(line) {}

    // The next word; "" at the end.
    std::string_view word() {
        const std::string_view all = std::exchange(rest_, {});
        const auto blank = all.find(' ');
        if (blank != all.npos) rest_ = all.substr(blank + 1);
        return all.substr(0, blank);
    }
    // A quoted text, or nothing if there is none.
    std::optional<std::string> text() {
        if (!rest_.starts_with('"')) return std::nullopt;
        std::string text;
        std::size_t at = 1;
        for (; at < rest_.size() && rest_[at] != '"'; ++at) {
            const auto byte = static_cast<unsigned char>(rest_[at]);
            if (byte < 0x20 || byte > 0x7e) return std::nullopt;
            if (rest_[at] != '\\') {
                text += rest_[at];
            } else if (!escape(++at, text)) {
                return std::nullopt;
            }
        }
        if (at >= rest_.size()) return std::nullopt;
        rest_.remove_prefix(at + 1);
        if (rest_.starts_with(' ')) rest_.remove_prefix(1);
        return text;
    }
    std::string_view rest() const { return rest_; }

private:
    bool escape(std::size_t& at, std::string& text) const {
        const char kind = at < rest_.size() ? rest_[at] : '\0';
        if (kind == 'n') text += '\n';
        if (kind == '"' || kind == '\\') text += kind;
        if (kind == 'n' || kind == '"' || kind == '\\') return true;
        if (kind != 'x' || at + 2 >= rest_.size()) return false;
        const auto byte = number_in<unsigned char>(rest_.substr(at + 1, 2), 16);
        if (!byte) return false;
        text += static_cast<char>(*byte);
        at += 2;
        return true;
    }

    std::string_view rest_;
};

// A time [s] from 0 to `longest_run`.
std::optional<double> seconds(std::string_view word) {
    const auto value = number_in<double>(word);
    return value && *value >= 0 && *value <= longest_run ? value : std::nullopt;
}

std::optional<std::string> path_of(Words& words) {
    const bool is_quoted = words.rest().starts_with('"');
    auto path = is_quoted ? words.text() : std::optional(std::string(words.word()));
    if (path && !path->starts_with("/dev") && !path->starts_with("/sys")) path.reset();
    return path;
}

std::string path_text(const std::string& path) {
    const bool is_plain = std::all_of(path.begin(), path.end(), [](unsigned char each) {
        return each > 0x20 && each < 0x7f && each != '"' && each != '\\';
    });
    return is_plain ? path : quoted_text(path);
}

// A line of a log, or an error with what was expected.
class Line {
public:
    explicit Line(std::string_view line) : words_(line) {}

    tl::expected<DeviceCall, std::string> read() {
        const std::string_view begin = words_.word(), took = words_.word(), name = words_.word();
        const auto began = seconds(begin);
        if (!began) return wrong("a time [s]", begin);
        call_.begin = *began;
        const auto spent = took == never ? std::numeric_limits<double>::infinity() : seconds(took).value_or(-1);
        if (spent < 0) return wrong("a duration [s]", took);
        call_.took = spent;
        const auto kind =
            std::find_if(names.begin(), names.end(), [&](const auto& each) { return each.second == name; });
        if (kind == names.end()) return wrong("open-read, open-write, read, write, list or keys", name);
        call_.kind = kind->first;
        const std::string_view rest = words_.rest();
        auto path = path_of(words_);
        if (!path) return wrong("a path in /dev or /sys", rest);
        call_.path = std::move(*path);
        if (call_.kind == Kind::write) {
            auto text = words_.text();
            if (!text) return wrong("what was written, in quotes", words_.rest());
            call_.text = std::move(*text);
        }
        if (const auto equals = words_.word(); equals != "=") return wrong("=", equals);
        if (std::isinf(call_.took)) return words_.rest().empty() ? call_ : wrong("the end of the line", words_.rest());
        return result();
    }

private:
    tl::expected<DeviceCall, std::string> wrong(std::string_view expected, std::string_view found) const {
        return tl::unexpected(fmt::format("expected {}, got '{}'", expected, shown(found)));
    }

    tl::expected<DeviceCall, std::string> result() {
        const std::string_view rest = words_.rest();
        if (call_.error = error_number(rest); call_.error != 0) return call_;
        constexpr std::string_view expected[] = {"ok or an error such as EIO",
                                                 "the number of written bytes, or an error such as EIO",
                                                 "a string in quotes, or an error such as EIO"};
        switch (call_.kind) {
            case Kind::open_read:
            case Kind::open_write: return rest == "ok" ? call_ : wrong(expected[0], rest);
            case Kind::write: {
                const auto bytes = number_in<std::size_t>(rest);
                if (!bytes) return wrong(expected[1], rest);
                call_.bytes = *bytes;
                return call_;
            }
            case Kind::read:
            case Kind::list:
            case Kind::keys: break;
        }
        auto text = words_.text();
        if (!text || !words_.rest().empty()) return wrong(expected[2], rest);
        call_.text = std::move(*text);
        return call_;
    }

    Words words_;
    DeviceCall call_;
};

}  // namespace

std::string fingerprint(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char each : text) hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3;
    return fmt::format("#{}:{:016x}", text.size(), hash);
}

std::string_view name_of(DeviceCall::Kind kind) {
    return std::find_if(names.begin(), names.end(), [kind](const auto& each) { return each.first == kind; })->second;
}

std::string device_log_header() { return fmt::format("{}\n", header); }

std::string start_line(double when) { return fmt::format("{:.6f} start\n", when); }
std::string end_line(double when) { return fmt::format("{:.6f} end\n", when); }

std::string to_line(const DeviceCall& call) {
    const bool came_back = std::isfinite(call.took);
    std::string line = fmt::format("{:.6f} {} {} {}", call.begin, came_back ? fmt::format("{:.6f}", call.took) : never,
                                   name_of(call.kind), path_text(call.path));
    if (call.kind == Kind::write) line += " " + quoted_text(call.text);
    line += " =";
    if (!came_back) return line + "\n";
    if (call.error != 0) return line + " " + error_name(call.error) + "\n";
    switch (call.kind) {
        case Kind::open_read:
        case Kind::open_write: return line + " ok\n";
        case Kind::write: return line + fmt::format(" {}\n", call.bytes);
        case Kind::read:
        case Kind::list:
        case Kind::keys: break;
    }
    return line + " " + quoted_text(call.text) + "\n";
}

Expected<DeviceLog> read_device_log(std::string_view text, const std::string& file) {
    DeviceLog log;
    std::optional<double> start, end;
    int number = 0;
    while (!text.empty()) {
        const auto length = text.find('\n');
        if (length == text.npos) {
            log.is_torn = true;
            break;
        }
        const std::string_view line = text.substr(0, length);
        text.remove_prefix(length + 1);
        const auto wrong = [&](std::string why) { return failure(std::move(why), {.file = file, .line = number}); };
        if (++number == 1) {
            if (line != header)
                return wrong(
                    fmt::format("is not a device log (written by nezumi run --device-log): expected '{}', got '{}'",
                                header, shown(line)));
            continue;
        }
        if (const auto blank = line.find(' '); line.substr(blank + 1) == "start" || line.substr(blank + 1) == "end") {
            auto& mark = line.ends_with("start") ? start : end;
            const auto when = seconds(line.substr(0, std::min(blank, line.size())));
            if (!when || mark)
                return wrong(fmt::format("expected exactly one line 'TIME start' and one line 'TIME end', got '{}'",
                                         shown(line)));
            mark = when;
            continue;
        }
        auto call = Line(line).read();
        if (!call) return wrong(call.error());
        call->line = number;
        if (std::isfinite(call->took)) log.length = std::max(log.length, call->end());
        log.calls.push_back(std::move(*call));
    }
    if (number == 0)
        return failure("is empty: expected a device log of nezumi run --device-log", {.file = file, .line = 1});
    log.start = start.value_or(0);
    if (end) log.length = *end;
    if (log.length < log.start)
        return failure(fmt::format("ends at {} s, before it starts at {} s", log.length, log.start),
                       {.file = file, .line = number});
    return log;
}

}  // namespace nezumi::hw
