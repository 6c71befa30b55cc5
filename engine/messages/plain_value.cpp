// Reads a constant or a default.
#include "engine/messages/plain_value.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "engine/base/number_in.hpp"
#include "engine/base/trimmed.hpp"
#include "engine/messages/definition.hpp"

namespace nezumi {
namespace {

// An int64, or a uint64 if the type is one and no int64 has this value.
Expected<Value> whole_value(std::string_view text, const Type& type) {
    const std::string_view given = text;
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    if (hexadecimal) text.remove_prefix(2);
    const auto size = number_in<std::uint64_t>(text, hexadecimal ? 16 : 10);
    constexpr auto most = std::uint64_t{1} << 63;
    if (size && *size >= most && !negative && type.kind == Type::Kind::uint64) return Value(*size);
    if (!size || *size > (negative ? most : most - 1))
        return failure(fmt::format("expected an integer below 2^{}, got '{}'",
                                   type.kind == Type::Kind::uint64 ? 64 : 63, shown(given)));
    return Value(static_cast<std::int64_t>(negative ? 0 - *size : *size));
}

}  // namespace

Expected<Value> plain_value(std::string_view text, std::string_view kind) {
    const Type* type = type_of_kind(kind);
    if (type == nullptr || type->kind == Type::Kind::octets)
        return failure(fmt::format("a value of type '{}' can't be a constant or a default", shown(kind)));
    if (type->kind == Type::Kind::boolean) {
        if (text == "true" || text == "True" || text == "TRUE" || text == "1") return Value(true);
        if (text == "false" || text == "False" || text == "FALSE" || text == "0") return Value(false);
        return failure(fmt::format("expected true or false, got '{}'", shown(text)));
    }
    if (type->kind == Type::Kind::text) {
        const bool quoted =
            text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
        return Value(quoted ? text.substr(1, text.size() - 2) : text);
    }
    if (type->is_integer()) {
        // The value of a character is its code.
        if (text.size() == 3 && text.front() == '\'' && text.back() == '\'')
            return Value(std::int64_t{static_cast<unsigned char>(text[1])});
        auto value = whole_value(text, *type);
        const auto* whole = value ? value->get_if<std::int64_t>() : nullptr;
        if (whole == nullptr) return value;
        const auto [least, most] = type->integer_range();
        if (*whole >= least && *whole <= most) return value;
        return failure(fmt::format("expected an integer from {} to {}, got '{}'", least, most, shown(text)));
    }
    const auto number = number_in<double>(text);
    if (!number) return failure(fmt::format("expected a number, got '{}'", shown(text)));
    return Value(*number);
}

FieldComment parse_comment(std::string_view comment) {
    const std::size_t end = comment.find(']');
    constexpr std::size_t longest = 12;
    if (!comment.starts_with('[') || end == std::string_view::npos || end < 2 || end > longest)
        return {"", std::string(comment)};
    const std::string_view rest = trimmed(comment.substr(end + 1));
    if (rest.starts_with("or [")) return {"", std::string(comment)};
    return {std::string(comment.substr(1, end - 1)), std::string(rest)};
}

}  // namespace nezumi
