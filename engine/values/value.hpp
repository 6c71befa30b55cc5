// A value of a type that is only known at run time: what acts, files, journals and other hosts carry.
#pragma once

#include <cassert>
#include <memory>
#include <utility>

#include "engine/values/view.hpp"

namespace nezumi {

/// A value and its type. It is never empty: by itself it is `false`, and one that was moved from can only be assigned
/// to or destroyed.
class Value {
public:
    Value() : Value(false) {}
    // NOLINTNEXTLINE(google-explicit-constructor): any described value is one
    template <class T>
    requires Tabled<std::remove_cvref_t<T>> Value(T&& value)  // NOLINT(bugprone-forwarding-reference-overload)
        : type_(&type_of<std::remove_cvref_t<T>>()),
          held_(new std::remove_cvref_t<T>(std::forward<T>(value)), {type_}) {}
    /// A value of this type, as it is by itself.
    explicit Value(const Type& type) : type_(&type), held_(type.storage.make(type), {type_}) {}
    Value(const Value& other) : type_(other.type_), held_(type_->storage.copy(*type_, other.held_.get()), {type_}) {}
    Value(Value&&) noexcept = default;
    Value& operator=(const Value& other) { return *this = Value(other); }
    Value& operator=(Value&&) noexcept = default;
    ~Value() = default;

    const Type& type() const { return *type_; }
    template <class T>
    bool is() const {
        return type_ == &type_of<T>();
    }
    /// What it holds, if that is a T; else nullptr.
    template <class T>
    const T* get_if() const {
        return is<T>() ? static_cast<const T*>(held_.get()) : nullptr;
    }
    /// What it holds. It must be a T.
    template <class T>
    const T& get() const& {
        assert(is<T>());
        return *static_cast<const T*>(held_.get());
    }
    template <class T>
    T get() && {
        assert(is<T>());
        return std::move(*static_cast<T*>(held_.get()));
    }

    // NOLINTNEXTLINE(google-explicit-constructor): a walker takes any value
    operator ValueView() const { return {*type_, held_.get()}; }
    // NOLINTNEXTLINE(google-explicit-constructor): a reader takes any value
    operator ValuePlace() { return {*type_, held_.get()}; }

    /// The same value of the same type.
    bool operator==(const Value& other) const;

private:
    struct Destroy {
        const Type* type;
        void operator()(void* value) const { type->storage.destroy(*type, value); }
    };

    const Type* type_;
    std::unique_ptr<void, Destroy> held_;
};

}  // namespace nezumi
