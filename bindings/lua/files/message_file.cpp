// The word `message`: its name, and then its fields.
#include "bindings/lua/files/message_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/syntax/first_comment.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "engine/base/list.hpp"
#include "engine/base/names.hpp"
#include "engine/ports/port_base.hpp"
#include "engine/records/fields.hpp"

namespace nezumi {
namespace {

// Whether a text is `begin`, then names, then `end`. `between` is before the last name, a slash between the others.
bool is_type_name(std::string_view text, std::string_view begin, std::string_view between, std::string_view end) {
    if (!text.starts_with(begin) || !text.ends_with(end) || text.size() < begin.size() + end.size()) return false;
    text = text.substr(begin.size(), text.size() - begin.size() - end.size());
    const std::size_t last = text.rfind(between);
    if (last == text.npos || !is_identifier(text.substr(last + between.size()))) return false;
    text = text.substr(0, last);
    for (std::size_t slash = text.find('/'); slash != text.npos; slash = text.find('/')) {
        if (!is_identifier(text.substr(0, slash))) return false;
        text.remove_prefix(slash + 1);
    }
    return is_identifier(text);
}

// Letters, digits and underscores. Keywords of Lua are allowed, because messages of other programs use them.
bool is_field_name(std::string_view name) { return is_identifier(name) || is_keyword(name); }

// "double[8]" is `double` in an array; also "Point2D[]".
std::string read_kind(std::string_view text, FieldDefinition& field) {
    const std::size_t open = text.find('[');
    field.kind = text.substr(0, open);
    if (field.kind.empty()) return "expected its type, as \"double\", \"double[8]\" or \"Point2D[]\"";
    if (open == std::string_view::npos) return "";
    const std::string_view inside = text.substr(open + 1);
    if (inside == "]") {
        field.shape.push_back(0);
        return "";
    }
    std::size_t length = 0;
    const auto read = std::from_chars(inside.data(), inside.data() + inside.size(), length);
    if (read.ec != std::errc() || length == 0 ||
        inside.substr(static_cast<std::size_t>(read.ptr - inside.data())) != "]")
        return fmt::format("expected an array as \"{0}[8]\" or \"{0}[]\", got '{1}'", field.kind, shown(text));
    field.shape.push_back(length);
    return "";
}

class MessageReader {
public:
    MessageReader(DataFile& file, const SourceText& source) : file_(file), source_(source) {}

    static int word(lua_State* lua) {
        auto& reader = self(lua);
        bridge(lua, [&] { return reader.read_name(lua); });
        lua_settop(lua, 1);
        lua_pushlightuserdata(lua, &reader);
        lua_pushcclosure(lua, table, 1);
        return 1;
    }

    std::optional<MessageDefinition> definition;

private:
    static MessageReader& self(lua_State* lua) {
        return *static_cast<MessageReader*>(lua_touserdata(lua, lua_upvalueindex(1)));
    }
    static int table(lua_State* lua) {
        bridge(lua, [&] { return self(lua).read_fields(lua); });
        return 0;
    }

    // These raise no Lua error.

    Expected<void> read_name(lua_State* lua) {
        const Place place = calling_place(lua);
        const auto refuse = [&](std::string text) { return Unexpected(file_.fail({std::move(text), place})); };
        if (auto ok = Arguments{lua}.at_most("message", 1, " \"NAME\" { ... }"); !ok) return refuse(ok.error().message);
        const auto name = Arguments{lua}.text(1, "its name");
        if (!name) return refuse(fmt::format("message: {}", name.error().message));
        if (!name_.empty()) return refuse("message: a file can define only one message");
        const std::string of_file = type_of_file(source_.path);
        if (!is_identifier(*name) || name->find('_') != std::string::npos)
            return refuse(
                fmt::format("message '{}': expected a name of letters and digits, as 'Obstacle'", shown(*name)));
        if (*name != of_file)
            return refuse(fmt::format("message '{}': a message must have the name of its file, '{}'", *name, of_file));
        name_ = *name;
        return {};
    }

    Expected<void> read_fields(lua_State* lua) {
        const Place place = calling_place(lua);
        const auto value = read_file_value(lua, 1);
        if (!value)
            return Unexpected(file_.fail({fmt::format("message '{}': {}", name_, value.error().message), place}));
        FieldCheck check(fmt::format("message '{}'", name_), "message", place, file_.source(place.file));
        MessageDefinition made{.name = name_, .doc = first_comment(source_.text), .place = {source_.shown, place.line}};
        Fields all(check, *value);
        read_foreign_names(all, made);
        std::size_t index = 0;
        for (const Value& each : all.elements()) {
            Fields fields(check, each, {fmt::format("[{}]", ++index)});
            if (fields.elements().empty() && (fields.gives("ros") || fields.gives("rtm"))) {
                read_foreign_names(fields, made);
                fields.done();
            } else {
                read_field(std::move(fields), made);
            }
            if (!check.ok()) break;
        }
        all.done();
        if (check.ok() && made.fields.empty())
            return Unexpected(file_.fail(
                {fmt::format("message '{}' has no fields: write {{ \"distance\", \"double\" }}", name_), place}));
        if (auto ok = check.result(); !ok) return Unexpected(file_.fail(ok.error()));
        definition = std::move(made);
        return {};
    }

    // Reads the type names of ROS and OpenRTM, `ros = "my_msgs/msg/Obstacle"`: beside the fields or in a table.
    void read_foreign_names(Fields& fields, MessageDefinition& message) const {
        const auto read = [&](std::string_view word, std::string& name, auto is_right, std::string_view expected) {
            std::string given;
            if (!fields.text(word, given) || given.empty()) return;
            if (!name.empty()) {
                fields.check().wrong_at(fields.path_of(word), fmt::format("{}: is set already, to '{}'", word, name));
            } else if (!is_right(given)) {
                fields.check().wrong_at(fields.path_of(word), fmt::format("{}: expected a type of {}, got '{}'", word,
                                                                          expected, shown(given)));
            }
            name = std::move(given);
        };
        read(
            "ros", message.ros, [](std::string_view text) { return is_type_name(text, "", "/msg/", ""); },
            fmt::format("ROS 2 such as \"my_msgs/msg/{}\"", name_));
        read(
            "rtm", message.rtm, [](std::string_view text) { return is_type_name(text, "IDL:", "/", ":1.0"); },
            fmt::format("OpenRTM such as \"IDL:My/{}:1.0\"", name_));
    }

    void read_field(Fields fields, MessageDefinition& message) const {
        FieldCheck& check = fields.check();
        const auto wrong = [&](std::string_view text) { check.wrong_at(fields.path(), text); };
        if (message.fields.size() == most_message_fields)
            return wrong(fmt::format("expected at most {} fields", most_message_fields));
        const std::vector<Value>& elements = fields.elements();
        const auto* name = !elements.empty() ? elements[0].get_if<std::string>() : nullptr;
        if (name == nullptr || elements.size() > 2)
            return wrong("expected a field as { \"distance\", \"double\", unit = \"m\" }");
        if (!is_field_name(*name))
            return wrong(fmt::format("field '{}': expected a name of letters, digits and underscores", shown(*name)));
        for (const FieldDefinition& other : message.fields) {
            if (other.name == *name) return wrong(fmt::format("field '{}' is defined twice", *name));
        }
        FieldDefinition field{.name = *name, .place = check.place_of(fields.path())};
        const auto refuse = [&](std::string_view text) { wrong(fmt::format("field '{}' {}", field.name, text)); };
        if (elements.size() < 2) return refuse("has no type: write { \"" + field.name + "\", \"double\" }");
        if (const auto* kind = elements[1].get_if<std::string>()) {
            if (const std::string problem = read_kind(*kind, field); !problem.empty())
                return wrong(fmt::format("field '{}': {}", field.name, problem));
        } else if (const auto* choices = elements[1].get_if<FileTable>()) {
            if (const std::string problem = read_choices(*choices, field); !problem.empty()) return refuse(problem);
        } else {
            return refuse(fmt::format("has the type {}, expected a string or a list of choices", to_lua(elements[1])));
        }
        fields.text("unit", field.unit);
        fields.text("doc", field.doc);
        read_bounds(fields, field);
        if (const Value* initial = fields.field("default")) field.initial = *initial;
        fields.done();
        message.fields.push_back(std::move(field));
    }

    static std::string read_choices(const FileTable& table, FieldDefinition& field) {
        for (const Value& each : table.elements) {
            const auto* choice = each.get_if<std::string>();
            if (choice == nullptr || choice->empty())
                return fmt::format("has the choice {}, expected a string", to_lua(each));
            if (contains(field.choices, *choice)) return fmt::format("has the choice '{}' twice", shown(*choice));
            field.choices.push_back(*choice);
        }
        if (!table.fields.empty() || field.choices.empty()) return "expected choices, as { \"red\", \"green\" }";
        return "";
    }

    // Reads the bounds of a number, or the largest length of a field that has a length.
    static void read_bounds(Fields& fields, FieldDefinition& field) {
        const bool has_length =
            field.kind == "string" || field.kind == "bytes" || (!field.shape.empty() && field.shape.back() == 0);
        if (has_length) {
            std::int64_t most = 0;
            if (fields.whole("max", most, 1, std::numeric_limits<std::int32_t>::max()))
                field.limits.length = static_cast<std::size_t>(most);
            return;
        }
        const Type* type = type_of_kind(field.kind);
        if (type == nullptr || !type->is_number()) return;
        const Rule any{.most = std::numeric_limits<double>::max()};
        fields.number("min", field.limits.min, any, field.unit);
        fields.number("max", field.limits.max, any, field.unit);
        if (field.limits.min > field.limits.max)
            fields.check().wrong_at(fields.path(), fmt::format("field '{}' has a min of {} above its max of {}",
                                                               field.name, field.limits.min, field.limits.max));
    }

    DataFile& file_;
    const SourceText& source_;
    std::string name_;
};

}  // namespace

Expected<MessageDefinition> read_message_file(const SourceText& source, const Project& project) {
    auto file = DataFile::create(project, {});
    if (!file) return Unexpected(file.error());
    MessageReader reader(**file, source);
    if (auto ran = (*file)->run(source.text, source.shown, {{"message", MessageReader::word, &reader}}); !ran)
        return Unexpected(ran.error());
    if (!reader.definition)
        return failure(
            "a message file must return a message: `return message \"Obstacle\" { { \"distance\", \"double\" } }`",
            {source.shown});
    return std::move(*reader.definition);
}

}  // namespace nezumi
