// Writes any structure, by the field table of its type.
#include "engine/records/write_record.hpp"

#include <fmt/format.h>

#include "engine/base/lua_text.hpp"
#include "engine/values/value_text.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {
namespace {

std::string write_setting(const ValueView& value, const ValueView& from, const Rule& rule) {
    if (is_record(*value.type)) return write_record(value, from);
    if (value.type->kind != Type::Kind::optional) return setting_text(value, rule);
    const Type& type = *value.type->element;
    const Value plain(type);
    if (!is_record(type)) return setting_text({type, value.first()}, rule);
    const std::string text = value.count() > 0 ? write_record({type, value.first()}, plain) : "false";
    return text == "{}" ? "true" : text;
}

}  // namespace

std::string setting_text(const ValueView& value, const Rule& rule) {
    if (value.type->kind == Type::Kind::boolean && !rule.words[0].empty())
        return lua_quoted(rule.words[value.as<bool>() ? 1 : 0]);
    if (value.type == &type_of<Pose2D>()) {
        const auto& [position, heading] = value.as<Pose2D>();
        return fmt::format("{{ x = {}, y = {}, heading = {} }}", lua_number(position.x), lua_number(position.y),
                           lua_number(heading));
    }
    if (value.type->kind != Type::Kind::structure) return lua_text(value);
    std::string text;  // of a position
    for (const Type::Field& axis : value.type->fields)
        text += (text.empty() ? "{ " : ", ") + lua_text(value.field(axis));
    return text + " }";
}

std::string write_record(const ValueView& value, const ValueView& from) {
    std::string text;
    for (const Type::Field& field : value.type->fields) {
        const Rule& rule = *field.rule;
        const ValueView member = value.field(field), before = from.field(field);
        if (field.type->kind == Type::Kind::nothing || field.type->kind == Type::Kind::sequence || rule.by_hand)
            continue;
        if (!rule.required && is_equal(member, before)) continue;
        text += (text.empty() ? "{ " : ", ") + field.name + " = " + write_setting(member, before, rule);
    }
    return text.empty() ? "{}" : text + " }";
}

}  // namespace nezumi
