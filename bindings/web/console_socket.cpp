// Non-blocking sockets.
#include "bindings/web/console_socket.hpp"

#include <sys/socket.h>

#include <cerrno>

namespace nezumi::web {

Expected<bool> send_line(const Descriptor& socket, const std::string& line) {
    const ssize_t sent = ::send(socket.get(), line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(line.size())) return true;
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) return false;
    return failure("console buffer full; session restarted");
}

std::string take_some(const Descriptor& socket) {
    std::string piece(65536, '\0');
    const ssize_t got = recv(socket.get(), piece.data(), piece.size(), MSG_DONTWAIT);
    piece.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return piece;
}

}  // namespace nezumi::web
