// Words that connect and disconnect ports.
#include <fmt/format.h>

#include "bindings/console/words.hpp"

namespace nezumi {
namespace {

Expected<PortAt> port(const Session::Parts& parts, const WordArguments& arguments, int index) {
    if (index > arguments.count) return failure("expected a port or \"name.port\", got nothing");
    return parts.objects->to_port(arguments.lua, index);
}

}  // namespace

Expected<WordEnd> word_connect(Session::Parts& parts, const WordArguments& arguments) {
    const auto from = port(parts, arguments, 1);
    if (!from) return Unexpected(from.error());
    const auto to = port(parts, arguments, 2);
    if (!to) return Unexpected(to.error());
    if (auto ok = parts.live.system().connect(from->path(), to->path()); !ok) return Unexpected(ok.error());
    return WordEnd::done;
}

Expected<WordEnd> word_disconnect(Session::Parts& parts, const WordArguments& arguments) {
    System& system = parts.live.system();
    const auto first = port(parts, arguments, 1);
    if (!first) return Unexpected(first.error());
    if (!arguments.has(2)) {
        if (system.disconnect_all(*first->port).empty()) return failure(first->path() + " is not connected");
        return WordEnd::done;
    }
    const auto second = port(parts, arguments, 2);
    if (!second) return Unexpected(second.error());
    if (auto ok = system.disconnect(first->path(), second->path()); !ok) return Unexpected(ok.error());
    return WordEnd::done;
}

}  // namespace nezumi
