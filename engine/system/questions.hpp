// What components of other hosts can be asked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/error.hpp"
#include "engine/components/plain_data.hpp"

namespace nezumi {

struct Question {
    enum class What : std::uint8_t {
        look,  ///< what it is and how it stands: a table
        activate,
        deactivate,
        reset,
        use,      ///< of a named set
        set,      ///< of a parameter
        command,  ///< whose results are the answer
    };
    std::string host;
    std::string component;
    What what = What::look;
    std::string name{};  ///< of the set, the parameter or the command
    PlainData values{};  ///< the parameter's, or the command's arguments
};

/// A network (`System::network`) whose hosts answer. To ask changes nothing of this system, and waits for nothing.
class HostQuestions {
public:
    virtual ~HostQuestions() = default;
    /// Asks a host; returns the question's number. An error when that host is not there.
    virtual Expected<std::uint64_t> ask(const Question& question) const = 0;
    /// The answer, once, and an error where the host refuses or has not answered in time; nothing as long as it is to
    /// come, with one of the next `Network::between_ticks`.
    virtual std::optional<Expected<PlainData>> answer(std::uint64_t number) const = 0;
};

}  // namespace nezumi
