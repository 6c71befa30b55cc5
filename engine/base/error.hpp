// What went wrong in the outside world: a place, one plain sentence, and the alias that carries it.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace nezumi {

/// A place in a file that a person wrote. All parts are optional: an empty file means "no file", 0 means "not known".
struct Place {
    std::string file;  ///< as it is shown to the person, usually the path they gave
    int line = 0;      ///< from 1
    int column = 0;    ///< from 1

    bool operator==(const Place&) const = default;
};

/// An error of the outside world: bad input, a missing file, a device that is gone. Never a mistake of this program.
struct Error {
    enum class Kind {
        ordinary,
        out_of_time,  ///< a script ran longer than its budget: what comes after would depend on the machine
    };

    std::string message;  ///< one plain sentence: what was found, what was expected, what to do
    Place place{};        ///< where it was found, if it is in a file
    Kind kind = Kind::ordinary;

    bool operator==(const Error&) const = default;
};

template <class T>
using Expected = tl::expected<T, Error>;
using Unexpected = tl::unexpected<Error>;

/// Returns an `Unexpected` that converts to any `Expected<T>`.
inline Unexpected failure(std::string message, Place place = {}) {
    return Unexpected(Error{std::move(message), std::move(place), Error::Kind::ordinary});
}

/// "file:line:column: message", leaving out what is not known.
std::string describe(const Error& error);

/// A name that somebody else chose, as a message may show it: one line, no control characters, at most 60 bytes.
std::string shown(std::string_view name);

/// The candidate nearest to `name` by edit distance (insert, delete, replace, swap of neighbours), or an empty view
/// when none is near enough to be a slip: at most a third of the name's length, and at least 1, case not counted. Where
/// there is no slip, of those that have `name` as a part, or are a part of it, the one that differs least.
std::string_view nearest(std::string_view name, const std::vector<std::string_view>& candidates);

/// " (did you mean 'near'?)" for the nearest candidate, or an empty string when none is near.
std::string did_you_mean(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace nezumi
