// Memory functions for types that are made at run time, by their tables.
#include "engine/values/layout.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

namespace nezumi {
namespace {

std::byte* at_offset(void* at, std::size_t offset) { return static_cast<std::byte*>(at) + offset; }
const std::byte* at_offset(const void* at, std::size_t offset) { return static_cast<const std::byte*>(at) + offset; }

// Visits each part of a structure or an array: `visit(type, offset)`.
template <class Visit>
void for_each_part(const Type& type, const Visit& visit) {
    for (const Type::Field& field : type.fields) visit(*field.type, field.offset);
    if (type.kind != Type::Kind::array) return;
    for (std::size_t i = 0; i < type.length; ++i) visit(*type.element, i * type.element->size);
}

void construct_parts(const Type& type, void* at) {
    if (type.initial != nullptr) return type.storage.copy(type, at, ValueView(*type.initial).at);
    if (type.is_flat) std::memset(at, 0, type.size);
    for_each_part(type,
                  [&](const Type& part, std::size_t offset) { part.storage.construct(part, at_offset(at, offset)); });
}

void copy_parts(const Type& type, void* at, const void* from) {
    if (type.is_flat) return static_cast<void>(std::memcpy(at, from, type.size));
    for_each_part(type, [&](const Type& part, std::size_t offset) {
        part.storage.copy(part, at_offset(at, offset), at_offset(from, offset));
    });
}

void assign_parts(const Type& type, void* to, const void* from) {
    if (type.is_flat) return static_cast<void>(std::memmove(to, from, type.size));
    for_each_part(type, [&](const Type& part, std::size_t offset) {
        part.storage.assign(part, at_offset(to, offset), at_offset(from, offset));
    });
}

void destroy_parts(const Type& type, void* at) {
    if (type.is_flat) return;
    for_each_part(type,
                  [&](const Type& part, std::size_t offset) { part.storage.destroy(part, at_offset(at, offset)); });
}

constexpr Type::Storage storage_of_parts{construct_parts, copy_parts, assign_parts, destroy_parts};

// A sequence in memory.
struct Run {
    std::byte* first = nullptr;
    std::size_t count = 0;
    std::size_t capacity = 0;
};

Run& run_at(void* at) { return *static_cast<Run*>(at); }
const Run& run_at(const void* at) { return *static_cast<const Run*>(at); }

void resize_run(const Type& type, void* value, std::size_t count) {
    Run& run = run_at(value);
    const Type& element = *type.element;
    for (std::size_t i = count; i < run.count; ++i) element.storage.destroy(element, run.first + i * element.size);
    run.count = std::min(run.count, count);
    if (count > run.capacity) {
        const std::size_t capacity = std::max(count, 2 * run.capacity);
        auto* grown = static_cast<std::byte*>(::operator new(capacity* element.size));
        for (std::size_t i = 0; i < run.count; ++i) {
            std::byte* old = run.first + i * element.size;
            element.storage.copy(element, grown + i * element.size, old);
            element.storage.destroy(element, old);
        }
        ::operator delete(run.first);
        run.first = grown;
        run.capacity = capacity;
    }
    for (; run.count < count; ++run.count) element.storage.construct(element, run.first + run.count * element.size);
}

void assign_run(const Type& type, void* to, const void* from) {
    if (to == from) return;
    const Run& source = run_at(from);
    const Type& element = *type.element;
    resize_run(type, to, source.count);
    for (std::size_t i = 0; i < source.count; ++i)
        element.storage.assign(element, run_at(to).first + i * element.size, source.first + i * element.size);
}

constexpr Type::Storage storage_of_run{
    .construct = [](const Type&, void* at) { new (at) Run{}; },
    .copy =
        [](const Type& type, void* at, const void* from) {
            new (at) Run{};
            assign_run(type, at, from);
        },
    .assign = assign_run,
    .destroy =
        [](const Type& type, void* at) {
            resize_run(type, at, 0);
            ::operator delete(run_at(at).first);
        },
};

constexpr Type::Elements elements_of_run{
    .count = [](const void* value) { return run_at(value).count; },
    .resize = resize_run,
    .first = [](const void* value) -> const void* { return run_at(value).first; },
};

// The C++ sequence for these elements; null if there is none.
const Type* compiled_sequence_of(const Type& element) {
    static const std::array all{&type_of<std::vector<bool>>(),          &type_of<std::vector<std::int8_t>>(),
                                &type_of<std::vector<std::int16_t>>(),  &type_of<std::vector<std::int32_t>>(),
                                &type_of<std::vector<std::int64_t>>(),  &type_of<std::vector<std::uint16_t>>(),
                                &type_of<std::vector<std::uint32_t>>(), &type_of<std::vector<std::uint64_t>>(),
                                &type_of<std::vector<float>>(),         &type_of<std::vector<double>>(),
                                &type_of<std::vector<std::string>>()};
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Type* each) { return each->element == &element; });
    return found != all.end() ? *found : nullptr;
}

}  // namespace

Type& Types::add(Type type) { return all_.emplace_back(std::move(type)); }

const Type& Types::sequence_of(const Type& element) {
    if (&element == &type_of<std::uint8_t>()) return type_of<Octets>();
    if (const Type* compiled = compiled_sequence_of(element)) return *compiled;
    return add({.kind = Type::Kind::sequence,
                .size = sizeof(Run),
                .alignment = alignof(Run),
                .element = &element,
                .elements = elements_of_run,
                .storage = storage_of_run});
}

const Type& Types::array_of(const Type& element, std::size_t length) {
    assert(length > 0);
    return add({.kind = Type::Kind::array,
                .size = length * element.size,
                .alignment = element.alignment,
                .element = &element,
                .length = length,
                .storage = storage_of_parts,
                .is_flat = element.is_flat});
}

const Type& Types::enumeration_of(std::vector<std::string> choices) {
    Type type = detail::table_for<std::uint32_t>();
    type.kind = Type::Kind::enumeration;
    type.choices = std::move(choices);
    return add(std::move(type));
}

Type& Types::structure_of(std::string name, std::vector<Type::Field> fields) {
    Type type{.kind = Type::Kind::structure,
              .name = std::move(name),
              .fields = std::move(fields),
              .storage = storage_of_parts,
              .is_flat = true};
    for (Type::Field& field : type.fields) {
        const std::size_t alignment = field.type->alignment;
        field.offset = (type.size + alignment - 1) / alignment * alignment;
        type.size = field.offset + field.type->size;
        type.alignment = std::max(type.alignment, alignment);
        type.is_flat = type.is_flat && field.type->is_flat;
    }
    // A structure without fields takes a byte, as any other object.
    type.size = std::max((type.size + type.alignment - 1) / type.alignment * type.alignment, std::size_t{1});
    return add(std::move(type));
}

Type& Types::like(const Type& other) { return add(other); }

void set_initial(Type& type, Value value) {
    assert(&value.type() == &type && type.initial == nullptr);
    type.initial = std::make_shared<const Value>(std::move(value));
}

void ValuePlace::reset() const {
    if (type->initial != nullptr) return type->storage.assign(*type, at, ValueView(*type->initial).at);
    type->storage.destroy(*type, at);
    type->storage.construct(*type, at);
}

}  // namespace nezumi
