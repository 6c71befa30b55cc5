// Loads the module with libwebsockets.
#include "bindings/web/sockets.hpp"

#include "bindings/web/relay.hpp"
#include "engine/base/module.hpp"

namespace nezumi::web {

Expected<std::unique_ptr<Sockets>> open_sockets(const SocketOptions& options, Site& site) {
    if (options.relay >= 0) return open_relay(options.relay, site);
    static const auto opens =
        load_function({.file = web_module, .function = open_in_module, .part = "browsers", .needs = "libwebsockets17"});
    if (!opens) return failure(opens.error().message);
    std::string problem;
    std::unique_ptr<Sockets> sockets(reinterpret_cast<OpenInModule*>(*opens)(options, site, problem));
    if (sockets == nullptr) return failure(problem);
    return sockets;
}

}  // namespace nezumi::web
