// Connections to the ORB's port that do nothing exclude no other connection.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>

#include "tests/unit/openrtm/wire_rig.hpp"

using namespace nezumi;

namespace {

using namespace std::chrono_literals;

// The port of TCP that this process listens at.
std::uint16_t listening_port() {
    for (const auto& each : std::filesystem::directory_iterator("/proc/self/fd")) {
        const int file = std::stoi(each.path().filename().string());
        int listens = 0;
        socklen_t size = sizeof listens;
        sockaddr_in own{};
        socklen_t own_size = sizeof own;
        if (getsockopt(file, SOL_SOCKET, SO_ACCEPTCONN, &listens, &size) != 0 || listens == 0) continue;
        if (getsockname(file, reinterpret_cast<sockaddr*>(&own), &own_size) == 0 && own.sin_family == AF_INET)
            return ntohs(own.sin_port);
    }
    return 0;
}

// Another process that opens connections, and says nothing or some bytes on each; they stay until it goes.
class Opener {
public:
    Opener(std::uint16_t port, int count, std::string_view said = "") {
        int to[2], from[2];
        if (pipe2(to, O_CLOEXEC) != 0 || pipe2(from, O_CLOEXEC) != 0) return;
        child_ = fork();
        if (child_ == 0) serve(to[0], from[1], port, count, said);
        close(to[0]);
        close(from[1]);
        to_ = to[1];
        from_ = from[0];
        opened_ = answer();
    }
    ~Opener() {
        kill(child_, SIGKILL);
        waitpid(child_, nullptr, 0);
        close(to_);
        close(from_);
    }
    Opener(const Opener&) = delete;
    Opener& operator=(const Opener&) = delete;
    int opened() const { return opened_; }
    /// Those that the other side has not ended.
    int open() const { return write(to_, "?", 1) == 1 ? answer() : -1; }

private:
    static constexpr int most = 1010;

    int answer() const {
        int count = -1;
        return read(from_, &count, sizeof count) == sizeof count ? count : -1;
    }
    // In the child, which has one of our threads alone: system calls and nothing else.
    [[noreturn]] static void serve(int questions, int answers, std::uint16_t port, int count, std::string_view said) {
        std::array<int, most> files{};
        for (int file = 3; file < 1024; ++file) {
            if (file != questions && file != answers) close(file);
        }
        int opened = 0;
        for (; opened < count; ++opened) {
            const int file = socket(AF_INET, SOCK_STREAM, 0);
            sockaddr_in address{};
            address.sin_family = AF_INET;
            address.sin_port = htons(port);
            address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
            if (file < 0) break;
            fcntl(file, F_SETFL, O_NONBLOCK);
            if (connect(file, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 && errno != EINPROGRESS)
                break;
            files[static_cast<std::size_t>(opened)] = file;
            pollfd polled{file, POLLOUT, 0};
            poll(&polled, 1, 20);  // one that is not accepted waits
            if (!said.empty() && send(file, said.data(), said.size(), MSG_NOSIGNAL) < 0) continue;
        }
        int left = opened;
        char asked = 0;
        do {
            if (write(answers, &left, sizeof left) != sizeof left) break;
            if (read(questions, &asked, 1) != 1) break;
            left = 0;
            for (int i = 0; i < opened; ++i) {
                char byte = 0;
                const bool is_open =
                    recv(files[static_cast<std::size_t>(i)], &byte, 1, MSG_PEEK) < 0 && errno == EAGAIN;
                left += is_open ? 1 : 0;
            }
        } while (true);
        _exit(0);
    }

    pid_t child_ = -1;
    int to_ = -1, from_ = -1;
    int opened_ = -1;
};

std::size_t own_files() {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

}  // namespace

TEST_CASE("silent connections are limited in number and time", "[openrtm][gate][wallclock]") {
    WireRig rig;
    REQUIRE(rig.tells("relay is "));
    const std::size_t before = own_files();
    const Opener opener(listening_port(), 1005);
    CHECK(opener.opened() > 0);
    CHECK(rig.until([&] { return own_files() <= before + 16 && opener.open() <= 16 + 33; }));
    // An RTC is served meanwhile.
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.answer(*out, "connect relay0 in", "connected ") == "connected 0");
    CHECK(rig.answer(*out, "send " + hex_of(std::int32_t{9}, std::endian::little), "sent ") == "sent 0");
    CHECK(rig.until([&] { return rig.arrived() == Value(std::int32_t{9}); }));
    CHECK(rig.until([&] { return opener.open() == 0; }, 30));
    CHECK(rig.answer(*out, "send " + hex_of(std::int32_t{8}, std::endian::little), "sent ") == "sent 0");
}

TEST_CASE("an RTC can connect while others open endless connections", "[openrtm][gate][wallclock]") {
    WireRig rig;
    REQUIRE(rig.tells("relay is "));
    std::size_t most = 0;
    std::atomic<bool> ends = false;
    const std::uint16_t port = listening_port();
    std::thread watcher([&] {
        while (!ends) {
            most = std::max(most, own_files());
            std::this_thread::sleep_for(1ms);
        }
    });
    {
        const Opener first(port, 1005), second(port, 1005);
        const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
        CHECK(rig.answer(*out, "state relay0", "state ") == "state 2");
    }
    ends = true;
    watcher.join();
    CHECK(most < 400);
}

TEST_CASE("an incomplete message closes its connection", "[openrtm][gate][wallclock]") {
    WireRig rig;
    REQUIRE(rig.tells("relay is "));
    // A request of GIOP 1.2 that is said to have 100 bytes more.
    const std::string_view begun("GIOP\1\2\1\0\x64\0\0\0", 12);
    const Opener opener(listening_port(), 20, begun);
    REQUIRE(opener.opened() == 20);
    CHECK(rig.until([&] { return opener.open() == 0; }, 30));
}

TEST_CASE("a used connection stays open while others come", "[openrtm][gate][wallclock]") {
    WireRig rig;
    const auto out = rig.rtc("Out0", "out", "TimedLong", "out");
    REQUIRE(rig.answer(*out, "connect relay0 in", "connected ") == "connected 0");
    const Opener opener(listening_port(), 100);
    for (std::int32_t i = 0; i < 50; ++i) {
        CHECK(rig.answer(*out, "send " + hex_of(i, std::endian::little), "sent ") == "sent 0");
        std::this_thread::sleep_for(10ms);
    }
}
