// A list that usually has one element, and needs no allocated memory for one.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace nezumi {

/// Like a vector of default-constructible elements, but the first element is stored in the list itself. With a second
/// element all elements move to the heap, and stay there.
template <class T>
class Few {
public:
    bool empty() const { return size() == 0; }
    std::size_t size() const { return many_ != nullptr ? many_->size() : std::size_t{has_one_}; }
    T* data() { return many_ != nullptr ? many_->data() : &one_; }
    const T* data() const { return many_ != nullptr ? many_->data() : &one_; }
    T* begin() { return data(); }
    T* end() { return data() + size(); }
    const T* begin() const { return data(); }
    const T* end() const { return data() + size(); }
    T& operator[](std::size_t index) { return data()[index]; }
    const T& operator[](std::size_t index) const { return data()[index]; }

    void push_back(T element) {
        if (many_ == nullptr && !has_one_) {
            one_ = std::move(element);
            has_one_ = true;
            return;
        }
        if (many_ == nullptr) {
            many_ = std::make_unique<std::vector<T>>();
            many_->push_back(std::move(one_));
        }
        many_->push_back(std::move(element));
    }
    /// Removes this element; later elements move up.
    void erase(T* element) {
        if (many_ != nullptr) {
            many_->erase(many_->begin() + (element - many_->data()));
        } else {
            one_ = T{};
            has_one_ = false;
        }
    }

private:
    T one_{};
    bool has_one_ = false;
    std::unique_ptr<std::vector<T>> many_;  // all elements, after there have been two
};

}  // namespace nezumi
