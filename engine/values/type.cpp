// The parts of a type's table that do not depend on its C++ type.
#include "engine/values/type.hpp"

namespace nezumi {

std::pair<std::int64_t, std::int64_t> Type::integer_range() const {
    const bool is_signed = kind <= Kind::int64;
    const auto most = std::numeric_limits<std::uint64_t>::max() >> (64 - 8 * size + (is_signed ? 1 : 0));
    if (!is_signed && size == sizeof most) return {0, std::numeric_limits<std::int64_t>::max()};
    const auto largest = static_cast<std::int64_t>(most);
    return {is_signed ? -largest - 1 : 0, largest};
}

void detail::add_fields(Type& type, std::span<const FieldSeed> fields) {
    type.fields.reserve(fields.size());
    for (const FieldSeed& field : fields) {
        type.fields.push_back({std::string(field.name), field.offset, &field.type(), std::string(field.unit),
                               std::string(field.doc), field.numbers});
    }
}

}  // namespace nezumi
