// Recent numbers and texts of a channel: a ring of samples.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nezumi {

class Series {
public:
    static constexpr std::size_t usual_samples = 6000;  ///< a minute at 100 Hz
    static constexpr std::size_t most_values = 16;      ///< largest number of values in a sample

    /// From now on keeps this many samples, at least 1; the oldest are dropped.
    void keep(std::size_t samples);
    std::size_t most_samples() const { return most_samples_; }
    /// Memory of its samples [bytes].
    std::size_t bytes() const { return rows_.size() * sizeof(double); }

    /// The labels of the values of a sample: "vx", "[1]"; "" for a single value.
    const std::vector<std::string>& labels() const { return labels_; }
    std::size_t size() const { return size_; }
    /// Whether older samples were dropped to make room.
    bool has_dropped() const { return has_dropped_; }
    /// [s] time stamp of a sample; 0 is the oldest.
    double seconds(std::size_t sample) const { return row(sample)[0]; }
    /// The value of a sample for a label: 0 and 1 for booleans, the index in `texts` for a text, NaN if the sample
    /// has fewer values.
    double value(std::size_t sample, std::size_t label) const { return row(sample)[label + 1]; }

    /// Whether the values for a label are texts.
    bool is_text(std::size_t label) const { return label < are_texts_.size() && are_texts_[label]; }
    /// The different texts so far, cut to `longest_text`. After the first `most_texts`, all others count as the last
    /// one.
    const std::vector<std::string>& texts() const { return texts_; }
    static constexpr std::size_t most_texts = 64;
    static constexpr std::size_t longest_text = 40;  ///< [bytes]
    /// The index of a text in `texts`; adds it if necessary.
    std::size_t place_of(std::string_view text);

    /// Replaces the labels by at least as many. `are_texts`: which of the values are texts; missing elements count as
    /// false.
    void set_labels(std::vector<std::string> labels, std::vector<bool> are_texts = {});
    /// Adds a sample with at most as many values as there are labels.
    void add(double seconds, std::span<const double> values);
    /// Removes all samples.
    void clear() { rows_.clear(), first_ = size_ = 0, has_dropped_ = false; }

private:
    std::size_t stride() const { return labels_.size() + 1; }
    const double* row(std::size_t sample) const { return &rows_[(first_ + sample) % most_samples_ * stride()]; }

    std::vector<std::string> labels_;
    std::vector<bool> are_texts_;
    std::vector<std::string> texts_;
    std::vector<double> rows_;  // a time stamp, and a value for each label
    std::size_t most_samples_ = usual_samples;
    std::size_t first_ = 0;  // row of the oldest sample
    std::size_t size_ = 0;
    bool has_dropped_ = false;
};

}  // namespace nezumi
