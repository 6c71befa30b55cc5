// A line of a .msg file is a comment, a field or a constant.
#include "engine/messages/msg_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "engine/base/number_in.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/messages/plain_value.hpp"

namespace nezumi {
namespace {

// Type names that are used only by ROS.
constexpr std::pair<std::string_view, std::string_view> ros_kinds[] = {
    {"bool", "boolean"}, {"byte", "octet"}, {"float32", "float"}, {"float64", "double"}, {"string", "string"}};

// The basic type in definitions for a type name of ROS; "" if it is not a basic type.
std::string_view kind_of_ros(std::string_view name) {
    const auto find_in = [&](const auto& kinds) -> std::string_view {
        for (const auto& [theirs, ours] : kinds) {
            if (theirs == name) return ours;
        }
        return "";
    };
    const std::string_view kind = find_in(ros_kinds);
    return kind.empty() ? find_in(foreign_kinds()) : kind;
}

// Takes letters, digits and the characters of `more` from the start of a text.
std::string_view take_word(std::string_view& text, std::string_view more = "_") {
    std::size_t size = 0;
    while (size < text.size() && (std::isalnum(static_cast<unsigned char>(text[size])) != 0 ||
                                  more.find(text[size]) != std::string_view::npos))
        ++size;
    const std::string_view word = text.substr(0, size);
    text.remove_prefix(size);
    return word;
}

bool take(std::string_view& text, std::string_view start) {
    if (!text.starts_with(start)) return false;
    text.remove_prefix(start.size());
    return true;
}

class Reader {
public:
    Reader(const SourceText& source, std::string_view package) : source_(source), package_(package) {
        const std::string name = std::filesystem::path(source.path).stem().string();
        message_.name = package.empty() ? name : fmt::format("{}/{}", package, name);
        if (!package.empty()) message_.ros = fmt::format("{}/msg/{}", package, name);
        message_.place = {source.shown, 0};
    }

    Expected<MessageDefinition> read() {
        std::string_view rest = source_.text;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            ++line_;
            if (auto ok = read_line(rest.substr(0, end)); !ok) return Unexpected(ok.error());
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        return std::move(message_);
    }

private:
    Unexpected wrong(std::string_view text) const { return failure(std::string(text), {source_.shown, line_}); }

    Expected<void> read_line(std::string_view line) {
        // A '#' within the default of a text does not begin a comment.
        const std::size_t quote = line.find_first_of("\"'");
        std::size_t hash = line.find('#');
        if (quote < hash) hash = line.find('#', std::min(line.find(line[quote], quote + 1), line.size()));
        const std::string_view comment =
            hash == std::string_view::npos
                ? ""
                : trimmed(line.substr(std::min(line.find_first_not_of('#', hash), line.size())));
        const std::string_view text = trimmed(line.substr(0, std::min(hash, line.size())));
        if (text.empty()) {
            if (comment.empty()) {
                end_comment();
            } else {
                above_ += (above_.empty() ? "" : " ") + std::string(comment);
            }
            return {};
        }
        std::string doc = comment.empty() ? std::exchange(above_, "") : std::string(comment);
        above_.clear();
        return read_entry(text, std::move(doc));
    }

    // If an empty line follows the first comment, this comment is the documentation of the message.
    void end_comment() {
        if (message_.doc.empty() && message_.fields.empty() && message_.constants.empty()) message_.doc = above_;
        above_.clear();
    }

    Expected<void> read_entry(std::string_view text, std::string doc) {
        FieldDefinition field{.doc = std::move(doc), .numbers = Numbers::any, .place = {source_.shown, line_}};
        if (auto ok = read_kind(text, field); !ok) return ok;
        if (text.empty() || trimmed(text.substr(0, 1)).size() == 1)
            return wrong(fmt::format("expected a field's name after its type '{}'", shown(field.kind)));
        text = trimmed(text);
        const std::string_view given = text;
        field.name = take_word(text);
        if (field.name.empty() || std::isdigit(static_cast<unsigned char>(field.name.front())) != 0)
            return wrong(fmt::format("expected a field's name, got '{}'", shown(given)));
        const std::string_view behind = trimmed(text);
        if (behind.starts_with('=')) return read_constant(field, behind.substr(1));
        for (const FieldDefinition& other : message_.fields) {
            if (other.name == field.name) return wrong(fmt::format("field '{}' is defined twice", field.name));
        }
        if (!behind.empty() && field.shape.empty()) {
            auto initial = plain_value(behind, field.kind);
            if (!initial)
                return wrong(fmt::format("the default of field '{}': {}", field.name, initial.error().message));
            field.initial = std::move(*initial);
        }
        auto [unit, meaning] = parse_comment(field.doc);
        field.unit = std::move(unit);
        field.doc = std::move(meaning);
        message_.fields.push_back(std::move(field));
        return {};
    }

    Expected<void> read_constant(const FieldDefinition& field, std::string_view text) {
        auto value = plain_value(trimmed(text), field.kind);
        if (!value) return wrong(fmt::format("constant '{}': {}", field.name, value.error().message));
        message_.constants.insert_or_assign(field.name, std::move(*value));
        return {};
    }

    // "float64[36]", "string<=10", "geometry_msgs/Point[]".
    Expected<void> read_kind(std::string_view& text, FieldDefinition& field) {
        const std::string name(take_word(text, "_/"));
        if (name.empty()) return wrong(fmt::format("expected a type, got '{}'", shown(text)));
        if (name == "wstring") return wrong("nezumi has no wstring: use a string, which holds UTF-8");
        const std::string_view known = kind_of_ros(name);
        field.kind = known.empty() ? full_name(name) : std::string(known);
        if (name == "string" && take(text, "<=")) {
            if (auto ok = read_length(text, field.limits.length); !ok) return ok;
        }
        if (!take(text, "[")) return {};
        std::size_t length = 0;
        if (take(text, "<=")) {
            if (auto ok = read_length(text, field.limits.length); !ok) return ok;
        } else if (!text.starts_with(']')) {
            if (auto ok = read_length(text, length); !ok) return ok;
            if (length == 0) return wrong("an array must have at least 1 element");
        }
        field.shape.push_back(length);
        return take(text, "]") ? Expected<void>() : wrong(fmt::format("expected ']', got '{}'", shown(text)));
    }

    Expected<void> read_length(std::string_view& text, std::size_t& length) {
        const std::string_view digits = take_word(text);
        const auto read = number_in<std::size_t>(digits);
        if (!read) return wrong(fmt::format("expected a length (a whole number), got '{}'", shown(digits)));
        length = *read;
        return {};
    }

    // Adds the package to a type name: types of the same package may be written without it.
    std::string full_name(const std::string& name) const {
        if (name == "Header") return "std_msgs/Header";
        if (name == "time") return "builtin_interfaces/Time";
        if (name == "duration") return "builtin_interfaces/Duration";
        return name.find('/') != std::string::npos || package_.empty() ? name : fmt::format("{}/{}", package_, name);
    }

    const SourceText& source_;
    std::string package_;
    MessageDefinition message_;
    std::string above_;  // comment lines since the last empty line or field
    int line_ = 0;
};

}  // namespace

Expected<MessageDefinition> read_msg(const SourceText& source, std::string_view package) {
    return Reader(source, package).read();
}

}  // namespace nezumi
