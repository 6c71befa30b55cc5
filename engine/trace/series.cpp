// Rows of equal length in one block: when the ring buffer is full, a new sample needs no allocation.
#include "engine/trace/series.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace nezumi {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::size_t Series::place_of(std::string_view text) {
    text = text.substr(0, longest_text);
    const auto known = std::find(texts_.begin(), texts_.end(), text);
    if (known != texts_.end()) return static_cast<std::size_t>(known - texts_.begin());
    if (texts_.size() + 1 == most_texts) text = "...";
    if (texts_.size() < most_texts) texts_.emplace_back(text);
    return texts_.size() - 1;
}

void Series::keep(std::size_t samples) {
    const auto row_at = [&](std::size_t index) {
        return rows_.begin() + static_cast<std::ptrdiff_t>(index * stride());
    };
    std::rotate(rows_.begin(), row_at(first_), rows_.end());
    first_ = 0;
    if (size_ > samples) {
        rows_.erase(rows_.begin(), row_at(size_ - samples));
        size_ = samples;
        has_dropped_ = true;
    }
    most_samples_ = samples;
}

void Series::set_labels(std::vector<std::string> labels, std::vector<bool> are_texts) {
    assert(labels.size() >= labels_.size());
    std::vector<double> rows;
    rows.reserve(size_ * (labels.size() + 1));
    for (std::size_t i = 0; i < size_; ++i) {
        rows.insert(rows.end(), row(i), row(i) + stride());
        rows.resize((i + 1) * (labels.size() + 1), nothing);
    }
    rows_ = std::move(rows);
    labels_ = std::move(labels);
    are_texts_ = std::move(are_texts);
    first_ = 0;
}

void Series::add(double seconds, std::span<const double> values) {
    assert(values.size() <= labels_.size());
    std::size_t place = 0;
    if (size_ < most_samples_) {
        place = size_++ * stride();
        rows_.resize(place + stride());
    } else {
        has_dropped_ = true;
        place = first_ * stride();
        if (++first_ == most_samples_) first_ = 0;
    }
    rows_[place] = seconds;
    const auto rest = std::copy(values.begin(), values.end(), rows_.begin() + static_cast<std::ptrdiff_t>(place) + 1);
    std::fill(rest, rows_.begin() + static_cast<std::ptrdiff_t>(place + stride()), nothing);
}

}  // namespace nezumi
