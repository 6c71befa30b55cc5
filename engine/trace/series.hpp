// The numbers and texts that a channel carried lately: a ring of samples.
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
    static constexpr std::size_t most_samples = 6000;  ///< a minute at 100 Hz; beyond them the oldest goes
    static constexpr std::size_t most_values = 16;     ///< of each message

    /// "vx", "[1]", "" for a single value: one for each value that a sample can have.
    const std::vector<std::string>& labels() const { return labels_; }
    std::size_t size() const { return size_; }
    /// [s] the stamp of a sample; 0 is the oldest.
    double seconds(std::size_t sample) const { return row(sample)[0]; }
    /// Its value under a label, 0 and 1 for truth values, of a text its place in `texts`; not a number when it has
    /// fewer.
    double value(std::size_t sample, std::size_t label) const { return row(sample)[label + 1]; }

    /// Whether the values under a label are texts.
    bool is_text(std::size_t label) const { return label < are_texts_.size() && are_texts_[label]; }
    /// The different texts so far, cut to `longest_text`; those after the first `most_texts` are all the last of these.
    const std::vector<std::string>& texts() const { return texts_; }
    static constexpr std::size_t most_texts = 64;
    static constexpr std::size_t longest_text = 40;  ///< [bytes]
    /// The place of a text in `texts`, where it is from now on.
    std::size_t place_of(std::string_view text);

    /// Replaces the labels by at least as many; `are_texts` says which have texts, none where it is shorter.
    void set_labels(std::vector<std::string> labels, std::vector<bool> are_texts = {});
    /// Adds a sample with at most as many values as there are labels.
    void add(double seconds, std::span<const double> values);
    /// Forgets the samples.
    void clear() { rows_.clear(), first_ = size_ = 0; }

private:
    std::size_t stride() const { return labels_.size() + 1; }
    const double* row(std::size_t sample) const { return &rows_[(first_ + sample) % most_samples * stride()]; }

    std::vector<std::string> labels_;
    std::vector<bool> are_texts_;
    std::vector<std::string> texts_;
    std::vector<double> rows_;  // the stamp and a value for each label
    std::size_t first_ = 0;     // row of the oldest sample
    std::size_t size_ = 0;
};

}  // namespace nezumi
