// Follows each type to those of its fields.
#include "bindings/web/types_json.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "bindings/web/web_frame.hpp"
#include "engine/ports/cdr.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
constexpr bool is_vector = false;
template <class T>
constexpr bool is_vector<std::vector<T>> = true;

template <class T>
std::string type_name() {
    if constexpr (is_vector<T>) {
        return "sequence<" + type_name<typename T::value_type>() + ">";
    } else if constexpr (Described<T>) {
        return std::string(Describe<T>::name);
    } else if constexpr (std::is_same_v<T, std::string>) {
        return "string";
    } else if constexpr (std::is_same_v<T, bool>) {
        return "bool";
    } else if constexpr (std::is_floating_point_v<T>) {
        return sizeof(T) == sizeof(float) ? "float" : "double";
    } else {
        return (std::is_signed_v<T> ? "int" : "uint") + std::to_string(8 * sizeof(T));
    }
}

template <class T>
void add(Json& types) {
    if constexpr (is_vector<T>) {
        add<typename T::value_type>(types);
    } else if constexpr (Described<T>) {
        const std::string name(Describe<T>::name);
        if (types.contains(name)) return;
        Json fields = Json::array();
        T value{};
        for_each_field(value, [&](const auto& field, const auto& member) {
            using Member = std::remove_cvref_t<decltype(member)>;
            fields.push_back(
                {{"name", field.name}, {"type", type_name<Member>()}, {"unit", field.unit}, {"doc", field.doc}});
            add<Member>(types);
        });
        types[name] = std::move(fields);
    }
}

}  // namespace

Json types_to_json() {
    Json types = Json::object();
    add<CdrTime>(types);
    const auto add_message = [&]<class T>(const MessageType<T>& type) {
        add<T>(types);
        const std::string name(type.name);
        Json fields = Json::array();
        fields.push_back({{"name", "tm"}, {"type", type_name<CdrTime>()}, {"unit", ""}, {"doc", "its stamp"}});
        if (types.contains(name)) {
            // The payload is called as its message: its fields follow the stamp.
            for (const Json& field : types[name]) fields.push_back(field);
        } else {
            fields.push_back({{"name", "data"}, {"type", type_name<T>()}, {"unit", ""}, {"doc", type.doc}});
        }
        types[name] = std::move(fields);
    };
    std::apply([&](const auto&... type) { (add_message(type), ...); }, message_types);
    add<WebFrame>(types);
    add<WebPicture>(types);
    return types;
}

}  // namespace nezumi::web
