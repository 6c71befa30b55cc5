// Writes the definition of each inner structure once, after the first structure that uses it.
#include "engine/messages/msg_text.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cctype>
#include <deque>
#include <set>
#include <utility>

#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

constexpr std::size_t unbounded = FieldLimits{}.length;

// "my_msgs/msg/Obstacle" as a field names it: "my_msgs/Obstacle".
std::string short_name(const std::string& full) {
    const std::size_t at = full.find("/msg/");
    return at == full.npos ? full : full.substr(0, at) + full.substr(at + 4);
}

// "too near" of the field `kind`: KIND_TOO_NEAR.
std::string constant_name(std::string_view field, std::string_view choice) {
    std::string name = fmt::format("{}_{}", field, choice);
    for (char& c : name) {
        const auto sign = static_cast<unsigned char>(c);
        c = std::isalnum(sign) != 0 ? static_cast<char>(std::toupper(sign)) : '_';
    }
    return name;
}

class MsgWriter {
public:
    std::string write(const Type& type) {
        std::string text = fields_of(type);
        std::set<std::string> written{full_ros_name(type)};
        while (!waiting_.empty()) {
            const auto [name, fields] = std::move(waiting_.front());
            waiting_.pop_front();
            if (!written.insert(name).second) continue;
            text += fmt::format("{:=>80}\nMSG: {}\n{}", "", short_name(name),
                                fields.type != nullptr ? fields_of(*fields.type) : fields.text);
        }
        return text;
    }

private:
    struct Fields {
        const Type* type;  // null: the fields are in `text`
        std::string text;
    };

    std::string fields_of(const Type& type) {
        std::string text;
        for (const Type::Field& field : type.fields) {
            const std::size_t most = field.limits != nullptr ? field.limits->length : unbounded;
            text += fmt::format("{} {}\n", kind_of(*field.type, most), field.name);
            if (field.type->kind != Type::Kind::enumeration) continue;
            for (std::size_t i = 0; i < field.type->choices.size(); ++i)
                text += fmt::format("uint32 {}={}\n", constant_name(field.name, field.type->choices[i]), i);
        }
        return text;
    }

    // The type name of the element of an array or a sequence.
    std::string element_of(const Type& type) {
        const Type& element = *type.element;
        const bool is_list = element.kind == Type::Kind::sequence || element.kind == Type::Kind::array ||
                             element.kind == Type::Kind::octets;
        std::string kind = kind_of(element, unbounded);
        if (!is_list) return kind;
        std::string name = "nezumi_msgs/msg/List";
        for (const char c : kind) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
        waiting_.emplace_back(name, Fields{nullptr, kind + " values\n"});
        return short_name(name);
    }

    std::string kind_of(const Type& type, std::size_t most) {
        switch (type.kind) {
            case Type::Kind::boolean: return "bool";
            case Type::Kind::int8: return "int8";
            case Type::Kind::int16: return "int16";
            case Type::Kind::int32: return "int32";
            case Type::Kind::int64: return "int64";
            case Type::Kind::uint8: return "uint8";
            case Type::Kind::uint16: return "uint16";
            case Type::Kind::uint32:
            case Type::Kind::enumeration: return "uint32";
            case Type::Kind::uint64: return "uint64";
            case Type::Kind::float32: return "float32";
            case Type::Kind::float64: return "float64";
            case Type::Kind::text: return most == unbounded ? "string" : fmt::format("string<={}", most);
            case Type::Kind::octets: return most == unbounded ? "uint8[]" : fmt::format("uint8[<={}]", most);
            case Type::Kind::array: return fmt::format("{}[{}]", element_of(type), type.length);
            case Type::Kind::sequence:
                return element_of(type) + (most == unbounded ? "[]" : fmt::format("[<={}]", most));
            case Type::Kind::structure:
                waiting_.emplace_back(full_ros_name(type), Fields{&type, {}});
                return short_name(full_ros_name(type));
            default: assert(false && "no type of ROS 2"); return {};
        }
    }

    std::deque<std::pair<std::string, Fields>> waiting_;
};

}  // namespace

std::string_view ros_name(const Type& type) {
    return type.message != nullptr && !type.message->ros.empty() ? std::string_view(type.message->ros) : type.name;
}

std::string full_ros_name(const Type& type) {
    const std::string_view name = ros_name(type);
    if (name.find("/msg/") != name.npos) return std::string(name);
    std::string own(name.substr(name.find('/') == name.npos ? 0 : name.rfind('/') + 1));
    return "nezumi_msgs/msg/" + own;
}

std::string msg_text(const Type& type) { return MsgWriter().write(type); }

}  // namespace nezumi
