// In place of sockets.cpp in a static program, which can load no module.
#include "bindings/web/sockets.hpp"

namespace nezumi::web {

Expected<std::unique_ptr<Sockets>> open_sockets(const SocketOptions& /*options*/, Site& /*site*/) {
    return failure("this nezumi is one static program, without the part that serves them");
}

}  // namespace nezumi::web
