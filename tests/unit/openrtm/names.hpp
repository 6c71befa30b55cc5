// A CORBA name service of a test's own, and the program that is an RTC.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/openrtm/peer.hpp"

namespace nezumi {

/// Where the RTC's program lies: beside the test that runs.
inline std::string fake_rtc() {
    return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "fake_rtc").string();
}

/// Omits a test where what it needs is not installed.
inline void need_omniorb() {
    if (std::system("command -v omniNames > /dev/null 2>&1") != 0)
        throw std::runtime_error("SKIPPED: omniNames is not installed: sudo apt install omniorb-nameserver");
    if (!std::filesystem::exists(fake_rtc()))
        throw std::runtime_error("SKIPPED: nezumi was built without omniORB: sudo apt install libomniorb4-dev omniidl");
}

inline int free_port() {
    const int file = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    int port = 0;
    if (bind(file, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
        getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) == 0)
        port = ntohs(address.sin_port);
    close(file);
    return port;
}

/// A name service, which may go and come back.
class Names {
public:
    Names() : port_((need_omniorb(), free_port())) { start(); }
    std::string address() const { return "localhost:" + std::to_string(port_); }
    void start() {
        const std::string port = std::to_string(port_);
        std::vector<std::string> words{"omniNames", "-datadir", folder_.path().string(), "-ORBendPoint",
                                       "giop:tcp:127.0.0.1:" + port};
        // What it has begun with once it must not be told again.
        if (std::filesystem::is_empty(folder_.path())) words.insert(words.begin() + 1, {"-start", port});
        service_ = std::make_unique<Peer>(std::move(words));
        // It serves when it has written its names.
        std::string line;
        do {
            line = service_->heard("omniNames");
            REQUIRE_FALSE(line.empty());
        } while (line.find("Checkpointing completed") == std::string::npos);
    }
    void kill() { service_.reset(); }
    /// One that begins again has no names.
    void forget() {
        for (const auto& file : std::filesystem::directory_iterator(folder_.path()))
            std::filesystem::remove(file.path());
    }

private:
    Scratch folder_;
    int port_;
    std::unique_ptr<Peer> service_;
};

}  // namespace nezumi
