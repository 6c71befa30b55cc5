// A parser for the part of IDL that describes data.
#include "engine/messages/idl_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/messages/idl_tokens.hpp"
#include "engine/messages/plain_value.hpp"

namespace nezumi {
namespace {

// The type of a field, or the type for which a name of the file stands.
struct IdlType {
    std::string kind{};                  // "" for an enumeration
    std::vector<std::string> choices{};  // of an enumeration
    std::vector<std::size_t> shape{};
    std::size_t length = FieldLimits{}.length;
};

struct Refused {
    std::string_view word, instead;
};
constexpr std::array refused{Refused{"union", "use a struct with all fields"},
                             Refused{"valuetype", "use a struct"},
                             Refused{"any", "use a field with a fixed type"},
                             Refused{"fixed", "use double"},
                             Refused{"map", "use a sequence of structs with a key and a value"},
                             Refused{"Object", "use a struct"},
                             Refused{"bitset", "use an unsigned integer"},
                             Refused{"bitmask", "use an unsigned integer"}};

class Parser : IdlTokens {
public:
    explicit Parser(const IdlIncluder& include) : include_(include) {}

    void read(const SourceText& source) {
        included_.insert(file_name(source));
        const SourceText* const outer = std::exchange(source_, &source);
        IdlLexer lexer(source);
        IdlLexer* const outer_lexer = std::exchange(lexer_, &lexer);
        const IdlToken outer_token = std::exchange(token_, {});
        step();
        read_definitions(false);
        source_ = outer;
        lexer_ = outer_lexer;
        token_ = outer_token;
    }

    Expected<std::vector<MessageDefinition>> result() {
        if (error_) return Unexpected(*error_);
        return std::move(messages_);
    }

private:
    // The full name of a definition in the current module: "RTC/Time".
    std::string in_module(const std::string& name) const { return module_.empty() ? name : module_ + "/" + name; }

    // Definitions

    void read_definitions(bool inner) {
        if (++depth_ > 32) fail("expected at most 32 nested modules");
        while (!error_ && token_.kind != Kind::end && !(inner && is("}"))) read_definition();
        --depth_;
    }

    void read_definition() {
        skip_annotations();
        std::string doc = std::move(token_.comment);
        const int line = token_.line;
        if (token_.kind == Kind::include) {
            read_include();
        } else if (take(";")) {
        } else if (take("module")) {
            const std::string outer = module_;
            module_ = in_module(take_name());
            expect("{");
            read_definitions(true);
            expect("}");
            take(";");
            module_ = outer;
        } else if (take("struct")) {
            read_structure(std::move(doc), line);
        } else if (take("typedef")) {
            const IdlType type = read_type();
            do {
                auto [name, declared] = read_declarator(type);
                add(name, declared);
            } while (take(","));
            expect(";");
        } else if (take("enum")) {
            const std::string name = take_name();
            add(name, read_enumeration());
            expect(";");
        } else if (take("const")) {
            read_constant();
        } else if (is("interface") || is("exception") || is("abstract") || is("local") || is("native")) {
            skip_definition();  // these describe functions, not data
        } else {
            refuse_word();
            fail(fmt::format("expected a definition, got {}", found()));
        }
    }

    void refuse_word() {
        const auto word =
            std::find_if(refused.begin(), refused.end(), [&](const Refused& each) { return is(each.word); });
        if (word != refused.end()) fail(fmt::format("'{}' is not supported: {}", word->word, word->instead));
    }

    // The name without folders. Of included files with the same name, only the first is read, as with include guards: a
    // project may have a copy of an installed file, and also include installed files that include the original.
    static std::string file_name(const SourceText& source) { return source.path.substr(source.path.rfind('/') + 1); }

    void read_include() {
        const std::string name(token_.text);
        auto found = include_(name, *source_);
        if (!found) return fail(fmt::format("#include \"{}\": {}", shown(name), found.error().message));
        if (included_.insert(file_name(*found)).second && !found->text.empty()) {
            if (included_.size() > 64) return fail("expected at most 64 files that include each other");
            const std::string outer = std::exchange(module_, "");
            read(*found);
            module_ = outer;
        }
        step();
    }

    // Skips `{ ... }` up to the `;` after it.
    void skip_definition() {
        int depth = 0;
        while (!error_ && token_.kind != Kind::end) {
            if (is("{")) ++depth;
            if (is("}")) --depth;
            const bool ends = depth == 0 && is(";");
            step();
            if (ends) return;
        }
    }

    // Skips annotations, `@name(...)`. Only the unit is used.
    void skip_annotations() {
        unit_.clear();
        while (take("@")) {
            const std::string name = take_name();
            if (!take("(")) continue;
            for (int depth = 1; depth > 0 && !error_ && token_.kind != Kind::end;) {
                if (is("(")) ++depth;
                if (is(")")) --depth;
                if (name == "unit" && token_.kind == Kind::text) unit_ = token_.text.substr(1, token_.text.size() - 2);
                step();
            }
        }
    }

    void add(const std::string& name, const IdlType& type) {
        if (!error_ && !types_.try_emplace(in_module(name), type).second)
            fail(fmt::format("'{}' is defined twice", shown(name)));
    }

    IdlType read_enumeration() {
        IdlType type;
        expect("{");
        do {
            if (is("}")) break;
            skip_annotations();
            type.choices.push_back(take_name());
        } while (take(","));
        expect("}");
        if (type.choices.empty()) fail("expected at least one choice in the enumeration");
        return type;
    }

    void read_constant() {
        const IdlType type = read_type();
        const std::string name = take_name();
        expect("=");
        const bool negative = take("-");
        std::string text = (negative ? "-" : "") + std::string(token_.text);
        if (token_.kind == Kind::word) {
            const auto other = constants_.find(in_module(text));
            if (other != constants_.end()) {
                constants_[in_module(name)] = other->second;
                step();
                return expect(";");
            }
        }
        const auto value = plain_value(text, type.kind);
        if (!value) return fail(fmt::format("constant '{}': {}", shown(name), value.error().message));
        constants_[in_module(name)] = *value;
        step();
        if (token_.kind == Kind::sign && !is(";"))
            return fail(fmt::format("constant '{}': expressions are not supported: write the value", shown(name)));
        expect(";");
    }

    void read_structure(std::string doc, int line) {
        const std::string name = take_name();
        if (take(";")) return;  // a forward declaration
        if (is(":"))
            return fail(
                fmt::format("struct '{}' inherits from another struct, which nezumi does not support: write the "
                            "fields of that struct here",
                            shown(name)));
        MessageDefinition message{.name = in_module(name), .doc = std::move(doc), .place = {source_->shown, line}};
        message.rtm = "IDL:" + message.name + ":1.0";
        expect("{");
        while (!error_ && token_.kind != Kind::end && !is("}")) read_fields(message);
        expect("}");
        take(";");
        if (error_) return;
        add(name, {.kind = message.name});
        if (message.fields.empty()) return fail(fmt::format("struct '{}' has no fields", shown(name)), line);
        const std::string of_module = module_.empty() ? "" : module_ + "/";
        for (const auto& [constant, value] : constants_) {
            if (constant.starts_with(of_module) && constant.find('/', of_module.size()) == std::string::npos)
                message.constants.emplace(constant.substr(of_module.size()), value);
        }
        messages_.push_back(std::move(message));
    }

    void read_fields(MessageDefinition& message) {
        skip_annotations();
        std::string doc = std::move(token_.comment);
        const std::string unit = unit_;
        const int line = token_.line;
        const IdlType type = read_type();
        const std::size_t first = message.fields.size();
        do {
            auto [name, declared] = read_declarator(type);
            for (const FieldDefinition& other : message.fields) {
                if (other.name == name) return fail(fmt::format("field '{}' is defined twice", shown(name)));
            }
            FieldDefinition field{.name = name,
                                  .kind = std::move(declared.kind),
                                  .choices = std::move(declared.choices),
                                  .shape = std::move(declared.shape),
                                  .unit = unit,
                                  .numbers = Numbers::any,
                                  .place = {source_->shown, line}};
            field.limits.length = declared.length;
            message.fields.push_back(std::move(field));
            if (message.fields.size() > most_message_fields) return fail("expected fewer fields in this struct");
        } while (take(","));
        if (!is(";")) return fail(fmt::format("expected ';', got {}", found()));
        const std::string behind = lexer_->comment_behind();
        if (doc.empty()) doc = behind;
        const FieldComment comment = parse_comment(doc);
        for (std::size_t i = first; i < message.fields.size(); ++i) {
            message.fields[i].doc = comment.doc;
            if (message.fields[i].unit.empty()) message.fields[i].unit = comment.unit;
        }
        step();
    }

    // Types

    std::pair<std::string, IdlType> read_declarator(IdlType type) {
        std::string name = take_name();
        std::vector<std::size_t> lengths;
        while (take("[")) {
            lengths.push_back(read_length());
            expect("]");
        }
        // The last length is that of the innermost dimension.
        type.shape.insert(type.shape.end(), lengths.rbegin(), lengths.rend());
        return {std::move(name), std::move(type)};
    }

    std::size_t read_length() {
        std::optional<std::int64_t> length;
        if (token_.kind == Kind::number) {
            if (const auto value = plain_value(token_.text, "longlong")) length = value->get<std::int64_t>();
        } else if (token_.kind == Kind::word) {
            const auto found = constants_.find(in_module(std::string(token_.text)));
            const auto* whole = found != constants_.end() ? found->second.get_if<std::int64_t>() : nullptr;
            if (whole != nullptr) length = *whole;
        }
        if (!length || *length < 1)
            return fail(fmt::format("expected the array length (a whole number from 1), got {}", found())), 1;
        step();
        return static_cast<std::size_t>(*length);
    }

    IdlType read_type() {
        if (++depth_ > 32) fail("expected at most 32 nested sequences");
        IdlType type = read_type_here();
        --depth_;
        return type;
    }

    IdlType read_type_here() {
        if (take("sequence")) {
            expect("<");
            IdlType type = read_type();
            if (take(",")) type.length = read_length();
            expect(">");
            type.shape.push_back(0);
            return type;
        }
        if (take("string")) {
            IdlType type{.kind = "string"};
            if (take("<")) {
                type.length = read_length();
                expect(">");
            }
            return type;
        }
        if (take("enum")) {
            const std::string name = take_name();
            IdlType type = read_enumeration();
            add(name, type);
            return type;
        }
        // Reported only if a message uses such a field, because files with basic types of other programs have some.
        if (take("wchar") || take("wstring")) return {.kind = std::string(wide_text)};
        refuse_word();
        const bool is_unsigned = take("unsigned");
        const std::string prefix = is_unsigned ? "u" : "";
        if (take("short")) return {.kind = prefix + "short"};
        if (take("long")) {
            if (is("double")) return fail("nezumi has no long double: use double"), IdlType{};
            return {.kind = prefix + (take("long") ? "longlong" : "long")};
        }
        for (const std::string_view kind : {"boolean", "octet", "float", "double"}) {
            if (take(kind)) return {.kind = std::string(kind)};
        }
        for (const auto& [word, kind] : foreign_kinds()) {
            if (take(word)) return {.kind = std::string(kind)};
        }
        return read_named_type();
    }

    // "RTC::Time", "Time": searches the current module, then the modules around it.
    IdlType read_named_type() {
        const int line = token_.line;
        const bool from_root = take("::");
        std::string name = take_name();
        while (take("::")) name.append("/").append(take_name());
        if (error_) return {};
        std::string within = from_root ? "" : module_;
        while (true) {
            const auto found = types_.find(within.empty() ? name : fmt::format("{}/{}", within, name));
            if (found != types_.end()) return found->second;
            if (within.empty()) break;
            const std::size_t slash = within.rfind('/');
            within = slash == std::string::npos ? "" : within.substr(0, slash);
        }
        std::vector<std::string_view> names;
        for (const auto& [known, type] : types_) names.push_back(std::string_view(known).substr(known.rfind('/') + 1));
        return fail(fmt::format("unknown type '{}'{}", shown(name), did_you_mean(name, names)), line), IdlType{};
    }

    const IdlIncluder& include_;
    std::string module_;
    std::string unit_;
    int depth_ = 0;
    std::set<std::string> included_;
    std::map<std::string, IdlType> types_;
    std::map<std::string, Value> constants_;
    std::vector<MessageDefinition> messages_;
};

}  // namespace

MessageDefinition without_stamp(MessageDefinition message) {
    const FieldDefinition& first = message.fields.front();
    const bool is_time = first.kind == "Time" || first.kind.ends_with("/Time");
    if (first.name != "tm" || !is_time || !first.shape.empty() || message.fields.size() < 2) {
        message.has_rtm_stamp = false;
        return message;
    }
    message.fields.erase(message.fields.begin());
    message.is_single = message.fields.size() == 1 && message.fields.front().name == "data";
    return message;
}

Expected<std::vector<MessageDefinition>> read_idl(const SourceText& source, const IdlIncluder& include) {
    Parser parser(include);
    parser.read(source);
    return parser.result();
}

}  // namespace nezumi
