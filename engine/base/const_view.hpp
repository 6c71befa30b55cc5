// A read-only view of a vector of unique pointers.
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

namespace nezumi {

/// The elements of a vector of unique pointers, as pointers to constants. The vector must outlive the view.
/// (`std::views::transform` would do the same, but clang 14 can't compile that of libstdc++.)
template <class T>
class ConstView {
public:
    class Iterator {
    public:
        using iterator_category = std::forward_iterator_tag;
        using difference_type = std::ptrdiff_t;
        using value_type = const T*;
        using pointer = const value_type*;
        using reference = value_type;

        Iterator() = default;
        explicit Iterator(const std::unique_ptr<T>* at) : at_(at) {}
        const T* operator*() const { return at_->get(); }
        Iterator& operator++() {
            ++at_;
            return *this;
        }
        Iterator operator++(int) { return Iterator(at_++); }
        bool operator==(const Iterator&) const = default;

    private:
        const std::unique_ptr<T>* at_ = nullptr;
    };

    explicit ConstView(const std::vector<std::unique_ptr<T>>& owners) : owners_(owners) {}

    Iterator begin() const { return Iterator(owners_.data()); }
    Iterator end() const { return Iterator(owners_.data() + owners_.size()); }
    std::size_t size() const { return owners_.size(); }
    bool empty() const { return owners_.empty(); }
    const T* operator[](std::size_t index) const { return owners_[index].get(); }

private:
    const std::vector<std::unique_ptr<T>>& owners_;
};

}  // namespace nezumi
