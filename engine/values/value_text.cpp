// One writer makes both forms, exact and short.
#include "engine/values/value_text.hpp"

#include <fmt/format.h>

#include <limits>
#include <type_traits>

#include "engine/base/lua_text.hpp"
#include "engine/values/value.hpp"

namespace nezumi {
namespace {

struct Writer {
    bool is_exact;
    std::size_t most;
    std::string out;

    void end(bool is_empty) { out += out.size() >= most ? " ..." : is_empty ? "}" : " }"; }

    void add(const ValueView& value) {
        if (out.size() >= most) return;
        switch (value.type->kind) {
            case Type::Kind::nothing:
            case Type::Kind::other: out += "nil"; return;
            case Type::Kind::any: return add(value.as<Value>());
            case Type::Kind::octets: out += fmt::format("<{} bytes>", value.as<Octets>().size()); return;
            case Type::Kind::structure:
                out += "{";
                for (const Type::Field& field : value.type->fields) {
                    if (out.size() >= most) break;
                    out += fmt::format("{}{} = ", &field == value.type->fields.data() ? " " : ", ", field.name);
                    add(value.field(field));
                }
                return end(false);
            case Type::Kind::array:
            case Type::Kind::sequence:
            case Type::Kind::optional: {
                out += "{";
                std::size_t index = 0;
                for_each_element(value, [&](const ValueView& element) {
                    if (out.size() >= most) return false;
                    out += index++ > 0 ? ", " : " ";
                    add(element);
                    return true;
                });
                return end(value.count() == 0);
            }
            case Type::Kind::map: {
                out += "{";
                bool is_empty = true;
                for_each_entry(value, [&](const std::string& name, const ValueView& element) {
                    out += fmt::format("{}{} = ", is_empty ? " " : ", ", lua_key(name));
                    add(element);
                    is_empty = false;
                });
                return end(is_empty);
            }
            case Type::Kind::enumeration: out += lua_quoted(value.type->choices[value.choice()]); return;
            case Type::Kind::text: {
                const auto& text = value.as<std::string>();
                out += text.size() > most ? lua_quoted(text.substr(0, most)) + "..." : lua_quoted(text);
                return;
            }
            default: return visit_number(value, [this](const auto& number) { add_number(number); });
        }
    }

    template <class T>
    void add_number(const T& number) {
        if constexpr (!std::is_floating_point_v<T>) {
            out += fmt::format("{}", number);
        } else if (is_exact) {
            out += lua_number(number);
        } else {
            out += fmt::format("{:.6g}", number == 0 ? T{0} : number);
        }
    }
};

}  // namespace

std::string lua_text(const ValueView& value) {
    Writer writer{true, std::numeric_limits<std::size_t>::max(), {}};
    writer.add(value);
    return std::move(writer.out);
}

std::string short_text(const ValueView& value, std::size_t width) {
    Writer writer{false, width, {}};
    writer.add(value);
    return std::move(writer.out);
}

}  // namespace nezumi
