// Connections without a token: limited in number, so that they don't exclude others.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace nezumi::web {

class Unadmitted {
public:
    /// The most connections at a time, and the most from one address.
    static constexpr std::size_t most = 64, most_of_source = 32;
    /// The longest time without a request, or without receiving its answer.
    static constexpr std::chrono::seconds longest_stay{5};

    using Connection = const void*;

    /// Adds a connection from the address `source`. If there are too many now, removes one and returns it, to be
    /// closed: the oldest of `source` if that has too many, otherwise the oldest of the address with most. Else returns
    /// null.
    Connection add(Connection connection, std::string source) {
        ++counts_[source];
        waiting_.push_back({connection, std::move(source)});
        const bool has_too_many = counts_[waiting_.back().source] > most_of_source;
        if (!has_too_many && waiting_.size() <= most) return nullptr;
        const auto largest = std::max_element(counts_.begin(), counts_.end(), [](const auto& left, const auto& right) {
            return left.second < right.second;
        });
        const std::string& from = has_too_many ? waiting_.back().source : largest->first;
        const auto oldest =
            std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& each) { return each.source == from; });
        const Connection goes = oldest->connection;
        remove(goes);
        return goes;
    }
    /// Removes a connection that was closed or that has shown a token.
    void remove(Connection connection) {
        const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                        [&](const Waiting& each) { return each.connection == connection; });
        if (found == waiting_.end()) return;
        const auto count = counts_.find(found->source);
        if (--count->second == 0) counts_.erase(count);
        waiting_.erase(found);
    }

private:
    struct Waiting {
        Connection connection;
        std::string source;
    };

    std::vector<Waiting> waiting_;  // oldest first
    std::map<std::string, std::size_t> counts_;
};

}  // namespace nezumi::web
