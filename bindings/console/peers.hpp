// Components of other programs, which the console shows and changes by names such as "rtm:ConsoleOut0".
#pragma once

#include <functional>
#include <future>
#include <string>

#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi {

/// A request to one component, or to all.
struct PeerRequest {
    enum class What : unsigned char {
        look,  ///< shows one component, or all
        activate,
        deactivate,
        reset,
        use,        ///< selects a configuration set
        configure,  ///< sets values of the configuration set in use
        exit,       ///< ends the component
        forget,     ///< removes the name of a component that is gone
        connect,    ///< connects two ports of other programs
        disconnect,
    };
    What what = What::look;
    std::string name{};  ///< without "rtm:"; "": all
    std::string set{};
    ParameterValues values{};
    std::string from{}, to{};  ///< for `connect` and `disconnect`: "ConsoleIn0.out", without "rtm:"
};

/// Sends a request between two ticks, without waiting. The future gives the text to show, or the error.
using PeerAsker = std::function<std::future<Expected<std::string>>(const PeerRequest& request)>;

}  // namespace nezumi
