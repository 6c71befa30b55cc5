// Functions over values of any type. Each function follows the tables of types.
#include "engine/values/walk.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/values/value.hpp"

namespace nezumi {

std::string LeafPath::text() const {
    if (parent_ == nullptr) return "";
    std::string text = parent_->text();
    if (index_ > 0) return text + "[" + std::to_string(index_) + "]";
    if (!text.empty() && !name_.starts_with('[')) text += '.';
    return text.append(name_);
}

std::uint64_t mix(std::uint64_t seed, std::string_view bytes) {
    seed = mix(seed, bytes.size());
    while (!bytes.empty()) {
        std::uint64_t word = 0;
        const std::size_t n = bytes.size() < sizeof word ? bytes.size() : sizeof word;
        std::memcpy(&word, bytes.data(), n);
        seed = mix(seed, word);
        bytes.remove_prefix(n);
    }
    return seed;
}

void visit_leaves(const ValueView& value, const LeafVisitor& visit, const LeafPath& path) {
    switch (value.type->kind) {
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields)
                visit_leaves(value.field(field), visit, path.field(field.name));
            return;
        case Type::Kind::array:
        case Type::Kind::sequence:
        case Type::Kind::optional: {
            std::size_t index = 0;
            return for_each_element(value, [&](const ValueView& element) {
                visit_leaves(element, visit, path.element(++index));
                return true;
            });
        }
        case Type::Kind::map:
            return for_each_entry(value, [&](const std::string& name, const ValueView& element) {
                visit_leaves(element, visit, path.field(name));
            });
        case Type::Kind::enumeration: return visit(path, value.type->choices[value.choice()]);
        case Type::Kind::any: return visit_leaves(value.as<Value>(), visit, path);
        case Type::Kind::nothing:
        case Type::Kind::octets:
        case Type::Kind::other: return;
        default: return visit(path, value);
    }
}

std::size_t leaf_numbers(const ValueView& value, std::span<double> numbers,
                         const std::function<double(const std::string& text)>& of_text) {
    if (numbers.empty()) return 0;
    std::size_t count = 0;
    const auto add = [&](const ValueView& part) {
        if (part.type->kind == Type::Kind::float64 && count < numbers.size()) {  // the usual type
            numbers[count++] = part.as<double>();
        } else {
            count += leaf_numbers(part, numbers.subspan(count), of_text);
        }
        return count < numbers.size();
    };
    switch (value.type->kind) {
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields) add(value.field(field));
            return count;
        case Type::Kind::array:
        case Type::Kind::sequence:
        case Type::Kind::optional: for_each_element(value, add); return count;
        case Type::Kind::map:
            for_each_entry(value, [&](const std::string&, const ValueView& element) { add(element); });
            return count;
        case Type::Kind::enumeration: numbers[0] = of_text(value.type->choices[value.choice()]); return 1;
        case Type::Kind::text: numbers[0] = of_text(value.as<std::string>()); return 1;
        case Type::Kind::any: return leaf_numbers(value.as<Value>(), numbers, of_text);
        case Type::Kind::nothing:
        case Type::Kind::octets:
        case Type::Kind::other: return 0;
        default:
            numbers[0] = visit_number(value, [](const auto& number) { return static_cast<double>(number); });
            return 1;
    }
}

namespace {

std::vector<std::pair<std::string_view, ValueView>> entries_of(const ValueView& map) {
    std::vector<std::pair<std::string_view, ValueView>> all;
    for_each_entry(map, [&](const std::string& name, const ValueView& element) { all.emplace_back(name, element); });
    return all;
}

}  // namespace

bool is_equal(const ValueView& a, const ValueView& b) {
    if (a.type != b.type) return false;
    switch (a.type->kind) {
        case Type::Kind::structure:
            return std::all_of(a.type->fields.begin(), a.type->fields.end(),
                               [&](const Type::Field& field) { return is_equal(a.field(field), b.field(field)); });
        case Type::Kind::array:
        case Type::Kind::sequence:
        case Type::Kind::optional: {
            bool equal = a.count() == b.count();
            for (std::size_t i = 0; equal && i < a.count(); ++i) {
                with_element(a, i, [&](const ValueView& one) {
                    with_element(b, i, [&](const ValueView& other) { equal = is_equal(one, other); });
                });
            }
            return equal;
        }
        case Type::Kind::map: {
            const auto all = entries_of(a), others = entries_of(b);
            return std::equal(all.begin(), all.end(), others.begin(), others.end(),
                              [](const auto& one, const auto& other) {
                                  return one.first == other.first && is_equal(one.second, other.second);
                              });
        }
        case Type::Kind::enumeration: return a.choice() == b.choice();
        case Type::Kind::any: return is_equal(a.as<Value>(), b.as<Value>());
        case Type::Kind::nothing: return true;
        case Type::Kind::text: return a.as<std::string>() == b.as<std::string>();
        case Type::Kind::octets: return a.as<Octets>() == b.as<Octets>();
        case Type::Kind::other: return a.at == b.at;
        default: return visit_number(a, [&]<class T>(const T& number) { return number == b.as<T>(); });
    }
}

bool is_finite(const ValueView& value) {
    switch (value.type->kind) {
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields) {
                if (field.numbers == Numbers::finite && !is_finite(value.field(field))) return false;
            }
            return true;
        case Type::Kind::array:
        case Type::Kind::sequence:
        case Type::Kind::optional: {
            if (value.type->element->is_single() && !value.type->element->is_floating()) return true;
            bool finite = true;
            for_each_element(value, [&](const ValueView& element) { return finite = is_finite(element); });
            return finite;
        }
        case Type::Kind::map: {
            const auto all = entries_of(value);
            return std::all_of(all.begin(), all.end(), [](const auto& entry) { return is_finite(entry.second); });
        }
        case Type::Kind::any: return is_finite(value.as<Value>());
        case Type::Kind::float32: return std::isfinite(value.as<float>());
        case Type::Kind::float64: return std::isfinite(value.as<double>());
        default: return true;
    }
}

std::size_t text_bytes(const ValueView& value) {
    std::size_t bytes = 0;
    visit_leaves(value, [&](const LeafPath&, const ValueView& leaf) {
        if (leaf.type->kind == Type::Kind::text) bytes += leaf.as<std::string>().size();
    });
    return bytes;
}

std::size_t heap_bytes(const ValueView& value) {
    std::size_t bytes = 0;
    switch (value.type->kind) {
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields) bytes += heap_bytes(value.field(field));
            return bytes;
        case Type::Kind::sequence: bytes = value.count() * value.type->element->size; [[fallthrough]];
        case Type::Kind::array:
        case Type::Kind::optional:
            if (value.type->element->kind < Type::Kind::text) return bytes;
            for_each_element(value, [&](const ValueView& element) {
                bytes += heap_bytes(element);
                return true;
            });
            return bytes;
        case Type::Kind::map:
            for_each_entry(value, [&](const std::string& name, const ValueView& element) {
                bytes += name.size() + element.type->size + heap_bytes(element);
            });
            return bytes;
        case Type::Kind::any: {
            const Type& held = value.as<Value>().type();
            return (held.is_scalar() ? 0 : held.size) + heap_bytes(value.as<Value>());
        }
        case Type::Kind::text: return value.as<std::string>().size();
        case Type::Kind::octets: return value.as<Octets>().size();
        default: return bytes;
    }
}

std::uint64_t mix_payload(std::uint64_t seed, const ValueView& value) {
    switch (value.type->kind) {
        case Type::Kind::structure:
            for (const Type::Field& field : value.type->fields) seed = mix_payload(seed, value.field(field));
            return seed;
        case Type::Kind::sequence:
        case Type::Kind::optional: seed = mix(seed, value.count()); [[fallthrough]];
        case Type::Kind::array:
            for_each_element(value, [&](const ValueView& element) {
                seed = mix_payload(seed, element);
                return true;
            });
            return seed;
        case Type::Kind::map:
            for_each_entry(value, [&](const std::string& name, const ValueView& element) {
                seed = mix_payload(mix(seed, std::string_view(name)), element);
            });
            return seed;
        case Type::Kind::enumeration: return mix(seed, value.choice());
        case Type::Kind::any: return mix_payload(seed, value.as<Value>());
        case Type::Kind::nothing: return seed;
        case Type::Kind::text: return mix(seed, std::string_view(value.as<std::string>()));
        case Type::Kind::octets: {
            const auto& octets = value.as<Octets>();
            return mix(seed, std::string_view(reinterpret_cast<const char*>(octets.data()), octets.size()));
        }
        case Type::Kind::other: return seed;
        default:
            return visit_number(value, [&]<class T>(const T& number) {
                if constexpr (std::is_floating_point_v<T>) {
                    // The sign of NaN differs between processors, so all NaN count as the same.
                    constexpr std::uint64_t no_number = 0x7ff8000000000000;
                    const double wide = static_cast<double>(number) + 0.0;
                    return mix(seed, std::isnan(wide) ? no_number : std::bit_cast<std::uint64_t>(wide));
                } else {
                    return mix(seed, static_cast<std::uint64_t>(number));
                }
            });
    }
}

}  // namespace nezumi
