// A list that mostly has one element, which lies within it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace nezumi {

/// As a vector of elements that can be made from nothing, but the first needs no memory of its own: who looks at the
/// list has it already. When a second one comes all move, and stay together from then on.
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
    /// Takes out this element; what comes after it moves up.
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
    std::unique_ptr<std::vector<T>> many_;  // all, once there have been two
};

}  // namespace nezumi
