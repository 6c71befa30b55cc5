// Components of other programs, which a console can look at and act on by their names, "rtm:ConsoleOut0".
#pragma once

#include <functional>
#include <future>
#include <string>

#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi {

/// A request to one of them, or to all.
struct PeerRequest {
    enum class What : unsigned char {
        look,  ///< at one of them, or at all
        activate,
        deactivate,
        reset,
        use,        ///< a set of its configuration
        configure,  ///< values of the set in use
    };
    What what = What::look;
    std::string name{};  ///< without "rtm:"; "": all
    std::string set{};
    ParameterValues values{};
};

/// Asks, between two ticks, and waits for nobody. The answer, which comes in the end, is what to show; its error says
/// what was wrong.
using PeerAsker = std::function<std::future<Expected<std::string>>(const PeerRequest& request)>;

}  // namespace nezumi
