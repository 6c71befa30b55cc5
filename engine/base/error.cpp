// Texts of errors, and the most similar name for a misspelt one.
#include "engine/base/error.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "engine/base/visible.hpp"

namespace nezumi {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Optimal string alignment distance (Damerau-Levenshtein without overlapping swaps).
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = previous[j - 1] + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
                current[j] = std::min(current[j], before[j - 2] + 1);
            }
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

// Whether `whole` contains `part`, ignoring case: "TimedVelocity2D" contains "velocity".
bool has_part(std::string_view whole, std::string_view part) {
    const auto same = [](char a, char b) { return lower(a) == lower(b); };
    return std::search(whole.begin(), whole.end(), part.begin(), part.end(), same) != whole.end();
}

// The length of the common beginning, ignoring case.
std::size_t begins_alike(std::string_view a, std::string_view b) {
    std::size_t count = 0;
    while (count < std::min(a.size(), b.size()) && lower(a[count]) == lower(b[count])) ++count;
    return count;
}

}  // namespace

std::string describe(const Error& error) {
    if (error.place.file.empty()) return error.message;
    std::string text = error.place.file;
    if (error.place.line > 0) text += ":" + std::to_string(error.place.line);
    if (error.place.line > 0 && error.place.column > 0) text += ":" + std::to_string(error.place.column);
    return text + ": " + error.message;
}

std::string shown(std::string_view name) {
    constexpr std::size_t most = 60;  // [bytes]
    std::string text;
    for (const char c : visible(name.substr(0, most))) {
        if (c == '\n' || c == '\t') {
            text += c == '\n' ? "\\x0a" : "\\x09";
        } else {
            text += c;
        }
    }
    return name.size() > most ? text + "..." : text;
}

std::string_view nearest(std::string_view name, const std::vector<std::string_view>& candidates) {
    std::string_view best;
    constexpr std::size_t longest = 200;  // longer names are not misspellings, and the comparison takes quadratic time
    if (name.size() > longest) return best;
    std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
    for (const std::string_view candidate : candidates) {
        const std::size_t d = distance(name, candidate);
        // A name without any common character is not a misspelling. Of two equally similar names, the one with the
        // longer common beginning is chosen.
        const bool nearer = d < best_distance || (d == best_distance && !best.empty() &&
                                                  begins_alike(name, candidate) > begins_alike(name, best));
        if (nearer && d < std::max(name.size(), candidate.size())) {
            best_distance = d;
            best = candidate;
        }
    }
    if (!best.empty()) return best;
    constexpr std::size_t least = 4;  // a shorter name is part of too many others
    std::size_t least_difference = static_cast<std::size_t>(-1);
    for (const std::string_view candidate : candidates) {
        const auto [shorter, longer] = std::minmax(name, candidate, [](auto a, auto b) { return a.size() < b.size(); });
        if (shorter.size() < least || longer.size() - shorter.size() >= least_difference) continue;
        if (!has_part(longer, shorter)) continue;
        least_difference = longer.size() - shorter.size();
        best = candidate;
    }
    return best;
}

std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates) {
    const std::string_view near = nearest(name, candidates);
    return near.empty() ? std::string() : " (did you mean '" + std::string(near) + "'?)";
}

}  // namespace nezumi
