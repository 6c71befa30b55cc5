// Computes the memory layout of a definition.
#include "engine/messages/message_catalog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/lua_text.hpp"
#include "engine/messages/message_fields.hpp"
#include "engine/values/layout.hpp"
#include "engine/values/limits.hpp"
#include "engine/values/value_text.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {
namespace {

// How deep the structures of a type are nested, and the total number of their fields.
struct Extent {
    int depth = 0;
    std::size_t fields = 0;
};
Extent extent_of(const Type& type, std::map<const Type*, Extent>& known) {
    const auto [place, is_new] = known.try_emplace(&type);
    if (!is_new) return place->second;
    Extent extent;
    if (type.element != nullptr) extent = extent_of(*type.element, known);
    for (const Type::Field& field : type.fields) {
        const Extent part = extent_of(*field.type, known);
        extent.depth = std::max(extent.depth, part.depth);
        extent.fields += part.fields + 1;
    }
    if (type.kind == Type::Kind::structure) ++extent.depth;
    return known[&type] = extent;
}

// "message 'Obstacle': field 'distance' TEXT".
Unexpected wrong(const MessageDefinition& message, const FieldDefinition& field, std::string_view text) {
    return failure(fmt::format("message '{}': field '{}'{}", message.name, shown(field.name), text), field.place);
}

// The key of a definition: definitions with the same key are the same type.
std::string key_of(const MessageDefinition& definition, const std::vector<const Type*>& elements) {
    std::string key = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n", definition.name, definition.doc, definition.is_single,
                                  definition.ros, definition.rtm, definition.has_rtm_stamp, definition.place.file);
    for (const auto& [name, value] : definition.constants) key += fmt::format("{} = {}\n", name, lua_text(value));
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const FieldDefinition& field = definition.fields[i];
        key += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", lua_quoted(field.name), lua_quoted(field.kind),
                           fmt::ptr(elements[i]), fmt::join(field.choices, "\v"), fmt::join(field.shape, ","),
                           field.limits.min, field.limits.max, field.limits.length, lua_quoted(field.unit),
                           lua_quoted(field.doc), static_cast<int>(field.numbers), lua_text(field.initial));
    }
    return key;
}

// Sets a field to its default. Returns the error if the default does not fit, or "".
std::string set_default(const ValuePlace& place, const Value& value) {
    const Type& type = *place.type;
    const auto refuse = [&](std::string_view expected) {
        return fmt::format("has the default {}, expected {}", lua_text(value), expected);
    };
    const auto* text = value.get_if<std::string>();
    if (type.kind == Type::Kind::enumeration) {
        const auto found =
            text != nullptr ? std::find(type.choices.begin(), type.choices.end(), *text) : type.choices.end();
        if (found == type.choices.end()) return refuse(fmt::format("one of {}", fmt::join(type.choices, ", ")));
        place.set_choice(static_cast<std::size_t>(found - type.choices.begin()));
        return "";
    }
    if (type.kind == Type::Kind::text)
        return text != nullptr ? (place.as<std::string>() = *text, "") : refuse("a string");
    if (type.kind == Type::Kind::boolean) {
        const auto* truth = value.get_if<bool>();
        return truth != nullptr ? (place.as<bool>() = *truth, "") : refuse("true or false");
    }
    if (!type.is_number()) return refuse("none: only a single value can have one");
    const auto* whole = value.get_if<std::int64_t>();
    const auto* number = value.get_if<double>();
    if (type.is_integer()) {
        const auto [min, max] = type.integer_range();
        if (whole == nullptr || *whole < min || *whole > max)
            return refuse(fmt::format("an integer from {} to {}", min, max));
    } else if (whole == nullptr && number == nullptr) {
        return refuse("a number");
    }
    visit_number(place,
                 [&]<class T>(T& out) { out = whole != nullptr ? static_cast<T>(*whole) : static_cast<T>(*number); });
    return "";
}

}  // namespace

struct MessageCatalog::Entry {
    Types types;
    MessageType message;
};

MessageCatalog::MessageCatalog() = default;
MessageCatalog::~MessageCatalog() = default;

MessageCatalog& MessageCatalog::shared() {
    // Never destroyed, because values may refer to its types until the process has ended.
    // NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): it is what the function gives
    static MessageCatalog* const catalog = new MessageCatalog;
    return *catalog;
}

Expected<const MessageType*> MessageCatalog::define(const MessageDefinition& definition, const Payloads& payloads) {
    std::vector<const Type*> elements;
    for (const FieldDefinition& field : definition.fields) {
        if (!field.choices.empty()) {
            elements.push_back(nullptr);
            continue;
        }
        const Type* type = type_of_kind(field.kind);
        if (type == nullptr) {
            auto found = payloads(field);
            if (!found) {
                return found.error().place.file.empty() ? wrong(definition, field, ": " + found.error().message)
                                                        : Unexpected(found.error());
            }
            type = *found;
        }
        elements.push_back(type);
    }

    const Lock lock(mutex_);
    const auto [place, is_new] = all_.try_emplace(key_of(definition, elements));
    const auto made_at = place;  // a copy, because clang does not let lambdas capture structured bindings
    if (!is_new) return last_[definition.name] = &place->second->message;
    auto made = std::make_unique<Entry>();
    const auto refuse = [&](const FieldDefinition& field, std::string_view text) {
        all_.erase(made_at);
        return wrong(definition, field, fmt::format(" {}", text));
    };
    std::vector<Type::Field> fields;
    std::size_t size = 0;
    std::size_t count = 0;
    std::map<const Type*, Extent> known;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const FieldDefinition& field = definition.fields[i];
        const Type* type = elements[i] != nullptr ? elements[i] : &made->types.enumeration_of(field.choices);
        for (const std::size_t length : field.shape) {
            if (length > most_message_size || type->size * std::max(length, std::size_t{1}) > most_message_size)
                return refuse(field,
                              fmt::format("has an array of {} elements, which makes the message larger than {} bytes",
                                          length, most_message_size));
            type = length == 0 ? &made->types.sequence_of(*type) : &made->types.array_of(*type, length);
        }
        size += type->size;
        if (size > most_message_size)
            return refuse(field, fmt::format("makes the message larger than {} bytes", most_message_size));
        const Extent extent = extent_of(*type, known);
        count += extent.fields + 1;
        if (extent.depth >= most_message_depth)
            return refuse(field, fmt::format("has {} levels of nested messages, expected at most {}", extent.depth,
                                             most_message_depth - 1));
        if (count > most_message_fields)
            return refuse(field, fmt::format("makes a message with more than {} fields, nested ones included",
                                             most_message_fields));
        fields.push_back(
            {.name = field.name,
             .type = type,
             .unit = field.unit,
             .doc = field.doc,
             .numbers = field.numbers,
             .limits = field.limits == FieldLimits{} ? nullptr : std::make_shared<const FieldLimits>(field.limits)});
    }
    MessageType& message = made->message;
    message = {.name = definition.name,
               .doc = definition.doc,
               .file = definition.place.file,
               .ros = definition.ros,
               .rtm = definition.rtm,
               .has_rtm_stamp = definition.has_rtm_stamp,
               .constants = definition.constants};
    Type& payload = definition.is_single ? made->types.like(*fields.front().type)
                                         : made->types.structure_of(definition.name, fields);
    payload.message = &message;
    message.payload = &payload;
    if (!definition.is_single) {
        payload.doc = definition.doc;
        Value initial(payload);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const FieldDefinition& field = definition.fields[i];
            const ValuePlace value = ValuePlace(initial).field(payload.fields[i]);
            const bool has_default = !field.initial.is_nothing();
            if (std::string problem = has_default ? set_default(value, field.initial) : ""; !problem.empty())
                return refuse(field, problem);
            if (const std::string misfit = explain_misfit(field.limits, value.view()); !misfit.empty())
                return refuse(field, (has_default ? "has a default out of its range: " : "needs a default: ") + misfit);
        }
        set_initial(payload, std::move(initial));
    }
    place->second = std::move(made);
    return last_[definition.name] = &place->second->message;
}

std::string wire_name(const MessageType& type) {
    if (type.is_compiled()) return type.name;
    std::string name = type.name;
    std::replace(name.begin(), name.end(), '/', '_');
    // For a sequence, the rows below are only those of an element, so the kind of the payload is mixed in too.
    std::uint64_t seed = mix(0, static_cast<std::uint64_t>(type.payload->kind));
    for (const MessageField& row : message_fields(type)) {
        if (row.is_structure) continue;
        for (const std::string* text : {&row.path, &row.values, &row.unit}) seed = mix(seed, std::string_view(*text));
    }
    return fmt::format("{}_{:016x}", name, seed);
}

const MessageType* MessageCatalog::find(std::string_view name) {
    const Lock lock(mutex_);
    const auto found = last_.find(name);
    return found != last_.end() ? found->second : nullptr;
}

}  // namespace nezumi
