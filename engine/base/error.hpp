// An error of the outside world: a message in one plain sentence, with its location.
#pragma once

#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <type_traits>
#include <utility>
#include <vector>

namespace nezumi {

/// A location in a file that a person wrote. All parts are optional: an empty file means "no file", 0 means "not
/// known".
struct Place {
    std::string file;  ///< as it is shown to the person, usually the path that they gave
    int line = 0;      ///< from 1
    int column = 0;    ///< from 1

    bool operator==(const Place&) const = default;
};

/// The calls that were active in a script when an error occurred (`engine/components/inside.hpp`).
struct ErrorFrames;

/// An error of the outside world: wrong input, a missing file, a device that is gone. Never a mistake of this program.
struct Error {
    enum class Kind {
        ordinary,
        out_of_time,  ///< a script ran longer than its time limit, so the result depends on the machine
    };

    std::string message;  ///< one plain sentence: what was found, what was expected, what to do
    Place place{};        ///< where it was found, if it is in a file
    Kind kind = Kind::ordinary;
    std::shared_ptr<const ErrorFrames> frames{};  ///< the calls of a running script; null: none

    bool operator==(const Error& other) const {
        return message == other.message && place == other.place && kind == other.kind;
    }
};

template <class T>
using Expected = tl::expected<T, Error>;
using Unexpected = tl::unexpected<Error>;

/// Returns an `Unexpected` that converts to any `Expected<T>`.
inline Unexpected failure(std::string message, Place place = {}) {
    return Unexpected(Error{std::move(message), std::move(place)});
}

/// "file:line:column: message", without unknown parts.
std::string describe(const Error& error);

/// A name from outside, fit for a message: one line, no control characters, at most 60 bytes.
std::string shown(std::string_view name);

/// The candidate nearest to `name` by edit distance (insert, delete, replace, swap of neighbours); case does not count.
/// The distance must be at most a third of the name's length, and at least 1. If there is none, the most similar
/// candidate that contains `name`, or is contained in it; otherwise empty.
std::string_view nearest(std::string_view name, const std::vector<std::string_view>& candidates);

/// " (did you mean 'near'?)" for the nearest candidate, or an empty string if none is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates);
/// The same for any list of texts.
template <class Texts>
std::string did_you_mean(std::string_view name, const Texts& texts) {
    return did_you_mean(name, std::vector<std::string_view>(std::begin(texts), std::end(texts)));
}
/// The same for things with names: `did_you_mean("tsak", tasks, &Task::name)`.
template <class Things, class Name>
std::string did_you_mean(std::string_view name, const Things& things, Name name_of) {
    std::vector<std::string_view> candidates;
    for (const auto& thing : things) {
        static_assert(!std::is_same_v<decltype(std::invoke(name_of, thing)), std::string>,
                      "the returned copy would be destroyed too early");
        candidates.emplace_back(std::invoke(name_of, thing));
    }
    return did_you_mean(name, candidates);
}

}  // namespace nezumi
