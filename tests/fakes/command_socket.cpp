// A thread for each client: a test, and the program that it tries.
#include "tests/fakes/command_socket.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <thread>
#include <utility>

namespace nezumi::fakes {
namespace {

void serve(int client, const std::function<std::string(const std::string& line)>& answer) {
    std::string waiting;
    char buffer[4096];
    for (;;) {
        const ssize_t length = read(client, buffer, sizeof buffer);
        if (length <= 0) return;
        waiting.append(buffer, static_cast<std::size_t>(length));
        for (std::size_t end = waiting.find('\n'); end != std::string::npos; end = waiting.find('\n')) {
            std::string text = answer(waiting.substr(0, end));
            waiting.erase(0, end + 1);
            if (!text.empty() && text.back() != '\n') text += '\n';
            text += ".\n";
            if (send(client, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size())) return;
        }
    }
}

}  // namespace

bool serve_commands(const std::string& path, std::function<std::string(const std::string& line)> answer) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) return false;
    std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
    const int listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (listener < 0 || bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
        listen(listener, 4) != 0)
        return false;
    std::thread([listener, answer = std::move(answer)] {
        for (;;) {
            const int client = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
            if (client < 0) return;
            std::thread([client, answer] {
                serve(client, answer);
                close(client);
            }).detach();
        }
    }).detach();
    return true;
}

}  // namespace nezumi::fakes
