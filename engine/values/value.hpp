// A value whose type is known only at run time, for parameters, acts, files, journals and other hosts.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/values/view.hpp"

namespace nezumi {

/// A value with its type. A default or moved-from object holds nothing (`std::monostate`).
class Value {
public:
    Value() : type_(&type_of<std::monostate>()) {}
    // NOLINTNEXTLINE(google-explicit-constructor): any described value is one
    template <class T>
    requires Tabled<std::remove_cvref_t<T>> Value(T&& value)  // NOLINT(bugprone-forwarding-reference-overload)
        : type_(&type_of<std::remove_cvref_t<T>>()) {
        using Held = std::remove_cvref_t<T>;
        if constexpr (detail::is_scalar<Held>()) {
            new (scalar_) Held(value);
        } else {
            apart_ = ::operator new(sizeof(Held));
            new (apart_) Held(std::forward<T>(value));
        }
    }
    // NOLINTNEXTLINE(google-explicit-constructor): a text as any other
    Value(std::string_view text) : Value(std::string(text)) {}
    // NOLINTNEXTLINE(google-explicit-constructor): the same
    Value(const char* text) : Value(std::string(text)) {}
    /// The default value of this type.
    explicit Value(const Type& type) : type_(&type) {
        if (type.is_scalar()) return;
        apart_ = ::operator new(type.size);
        type.storage.construct(type, apart_);
    }
    /// A copy of a value in other memory.
    explicit Value(const ValueView& view) : type_(view.type) {
        if (type_->is_scalar()) {
            std::memcpy(scalar_, view.at, type_->kind == Type::Kind::nothing ? 0 : type_->size);
        } else {
            apart_ = ::operator new(type_->size);
            type_->storage.copy(*type_, apart_, view.at);
        }
    }
    Value(const Value& other) : Value(ValueView(other)) {}
    Value(Value&& other) noexcept : Value() { swap(other); }
    /// Assigns a value; reuses the memory if the type is the same.
    Value& operator=(const Value& other) {
        if (type_ == other.type_ && !type_->is_scalar()) {
            type_->storage.assign(*type_, apart_, other.apart_);
        } else {
            Value copy(other);
            swap(copy);
        }
        return *this;
    }
    Value& operator=(Value&& other) noexcept {
        Value taken(std::move(other));
        swap(taken);
        return *this;
    }
    ~Value() {
        if (type_->is_scalar()) return;
        type_->storage.destroy(*type_, apart_);
        ::operator delete(apart_);
    }

    const Type& type() const { return *type_; }
    template <class T>
    bool is() const {
        return type_ == &type_of<T>();
    }
    bool is_nothing() const { return type_->kind == Type::Kind::nothing; }
    /// The content if it is a T; otherwise nullptr.
    template <class T>
    const T* get_if() const {
        return is<T>() ? static_cast<const T*>(place()) : nullptr;
    }
    template <class T>
    T* get_if() {
        return is<T>() ? static_cast<T*>(place()) : nullptr;
    }
    /// The content, which must be a T.
    template <class T>
    const T& get() const& {
        assert(is<T>());
        return *static_cast<const T*>(place());
    }
    template <class T>
    T get() && {
        assert(is<T>());
        return std::move(*static_cast<T*>(place()));
    }

    // NOLINTNEXTLINE(google-explicit-constructor): functions that visit values take any type
    operator ValueView() const { return {*type_, place()}; }
    // NOLINTNEXTLINE(google-explicit-constructor): functions that read into values take any type
    operator ValuePlace() { return {*type_, place()}; }

    /// Whether value and type are equal.
    bool operator==(const Value& other) const;

private:
    void swap(Value& other) noexcept {
        std::swap(type_, other.type_);
        std::byte kept[sizeof scalar_];
        std::memcpy(kept, scalar_, sizeof kept);
        std::memcpy(scalar_, other.scalar_, sizeof kept);
        std::memcpy(other.scalar_, kept, sizeof kept);
    }
    const void* place() const { return type_->is_scalar() ? static_cast<const void*>(scalar_) : apart_; }
    void* place() { return type_->is_scalar() ? static_cast<void*>(scalar_) : apart_; }

    const Type* type_;
    // A scalar is stored inside this object, any other value in allocated memory.
    union {
        alignas(8) std::byte scalar_[8]{};  // NOLINT(readability-identifier-naming): private, as all here
        void* apart_;                       // NOLINT(readability-identifier-naming)
    };
};

}  // namespace nezumi
