// Where `nezumi run` serves its page, and where it does not.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/unit/cli/pty_program.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

namespace {

struct WebSystem {
    Scratch scratch;
    std::string file = (scratch.write("behaviors/it.lua", "param('x', 1)\n"),
                        scratch.write("s.lua", "behavior 'it' { script = 'it' }\n"))
                           .string();

    Outcome run(std::vector<std::string> options) const {
        options.insert(options.begin(), {"run", file});
        return run_nezumi(std::move(options));
    }
};

// A port that somebody else listens on.
class TakenPort {
public:
    explicit TakenPort(std::uint16_t port) : file_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        address_.sin_family = AF_INET;
        address_.sin_port = htons(port);
        address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        taken_ =
            bind(file_, reinterpret_cast<const sockaddr*>(&address_), sizeof address_) == 0 && listen(file_, 1) == 0;
        socklen_t size = sizeof address_;
        getsockname(file_, reinterpret_cast<sockaddr*>(&address_), &size);
    }
    ~TakenPort() { close(file_); }
    TakenPort(const TakenPort&) = delete;
    TakenPort& operator=(const TakenPort&) = delete;
    bool is_taken() const { return taken_; }
    int number() const { return ntohs(address_.sin_port); }

private:
    int file_;
    sockaddr_in address_{};
    bool taken_ = false;
};

// The port of the address that was printed, 0 for none.
int port_in(const std::string& error) {
    const std::string begin = "in a browser: http://127.0.0.1:";
    const auto at = error.find(begin);
    return at == std::string::npos ? 0 : std::atoi(error.c_str() + at + begin.size());
}

// What the page's server answers.
std::string get(int port, const std::string& path) {
    const int file = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    std::string said;
    if (connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
        const std::string request = "GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
        static_cast<void>(send(file, request.data(), request.size(), MSG_NOSIGNAL));
        char piece[4096];
        for (ssize_t got = 0; (got = recv(file, piece, sizeof piece, 0)) > 0;)
            said.append(piece, static_cast<std::size_t>(got));
    }
    close(file);
    return said;
}

}  // namespace

TEST_CASE("a run prints where its page is, and serves it while it runs", "[cli][web]") {
    const WebSystem system;
    Program run({"run", system.file});
    REQUIRE(run.wait_for_error("\n"));
    const int port = port_in(run.error);
    REQUIRE(port > 0);
    CHECK(run.error.find('#') + 33 == run.error.find('\n'));
    const std::string page = get(port, "/");
    CHECK(page.rfind("HTTP/1.1 200", 0) == 0);
    CHECK(page.find("<html") != std::string::npos);
    CHECK(get(port, "/../README.md").find("nezumi") == std::string::npos);
    run.send(SIGINT);
    CHECK(run.wait() == 0);
    CHECK(get(port, "/").empty());
}

TEST_CASE("a run that is repeated has a page as well, unless it is headless", "[cli][web]") {
    const WebSystem system;
    const std::string journal = system.scratch.path("run.journal").string();
    REQUIRE(system.run({"--headless", "--speed", "max", "--duration", "3", "--journal", journal}).status == 0);
    Program again({"run", "--replay", journal, "--speed", "0.1"});
    REQUIRE(again.wait_for_error("\n"));
    CHECK(get(port_in(again.error), "/").rfind("HTTP/1.1 200", 0) == 0);
    // One that is ended before its end is not compared with the journal.
    again.send(SIGINT);
    CHECK(again.wait() == 0);
    const Outcome headless = run_nezumi({"run", "--replay", journal, "--headless"});
    CHECK(headless.status == 0);
    CHECK(headless.error.find("http") == std::string::npos);
}

TEST_CASE("the next free port is taken if one is used, and the run goes on without a page if all are used",
          "[cli][web]") {
    const WebSystem system;
    const TakenPort taken(0);
    REQUIRE(taken.is_taken());
    const int next = port_in(system.run({"--duration", "0.05", "--port", std::to_string(taken.number())}).error);
    CHECK(next > taken.number());
    CHECK(next < taken.number() + 20);

    const TakenPort last(65535);
    const Outcome without = system.run({"--duration", "0.05", "--port", "65535"});
    CHECK(without.status == 0);
    CHECK(without.error.find("no page for browsers: can't listen on 127.0.0.1:65535: Address already in use\n") == 0);
    CHECK(without.error.find("0.05 s simulated") != std::string::npos);
}

TEST_CASE("a headless run, and a run with --no-web, serve no page", "[cli][web]") {
    const WebSystem system;
    CHECK(system.run({"--duration", "0.05", "--no-web"}).error.find("http") == std::string::npos);
    CHECK(system.run({"--duration", "0.05", "--headless"}).error.find("http") == std::string::npos);
    const auto refused = [&](const std::vector<std::string>& options) {
        const Outcome outcome = system.run(options);
        CHECK(outcome.status == 2);
        return outcome.error;
    };
    CHECK(refused({"--port", "0"}) == "nezumi: --port: expected a whole number from 1 to 65535, got '0'\n");
    CHECK(refused({"--port", "65536"}) == "nezumi: --port: expected a whole number from 1 to 65535, got '65536'\n");
    CHECK(refused({"--port", "8765", "--headless"}) ==
          "nezumi: --port: a headless run has no page: leave out this option\n");
    CHECK(refused({"--port", "8765", "--no-web"}) ==
          "nezumi: --port: --no-web serves no page: leave out one of them\n");
    for (const std::string address : {"0.0.0.0", "robot", "::1", "192.168.1"})
        CHECK(refused({"--listen", address}) ==
              "nezumi: --listen: expected the IPv4 address at which others reach this computer, as in 192.168.1.20, "
              "got '" +
                  address + "'\n");
}

TEST_CASE("other computers connect only by TLS, with a certificate whose fingerprint is printed", "[cli][web]") {
    const WebSystem system;
    const std::string state = system.scratch.path("state").string();
    setenv("XDG_STATE_HOME", state.c_str(), 1);
    Program run({"run", system.file, "--listen", "127.0.0.1"});
    REQUIRE(run.wait_for_error("must be this one\n"));
    REQUIRE(run.wait_for_error(":"));
    const std::string begin = "in a browser: https://127.0.0.1:";
    REQUIRE(run.error.find(begin) == 0);
    const std::string port = run.error.substr(begin.size(), run.error.find('/', begin.size()) - begin.size());
    // Asks for the page as a client that is not ours, and says the fingerprint that it was shown.
    const std::string script =
        "import hashlib, socket, ssl\n"
        "context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)\n"
        "context.check_hostname, context.verify_mode = True, ssl.CERT_REQUIRED\n"
        "context.set_alpn_protocols(['h2', 'http/1.1'])\n"  // as browsers do
        "context.load_verify_locations('" +
        state +
        "/nezumi/page_certificate.pem')\n"
        "with context.wrap_socket(socket.create_connection(('127.0.0.1', " +
        port +
        ")), server_hostname='127.0.0.1') as link:\n"
        "    paper = link.getpeercert(True)\n"
        "    link.sendall(b'GET / HTTP/1.1\\r\\nHost: 127.0.0.1\\r\\nConnection: close\\r\\n\\r\\n')\n"
        "    print(link.recv(12).decode(), hashlib.sha256(paper).hexdigest())\n";
    const std::string file = system.scratch.write("ask.py", script).string();
    std::string said;
    if (FILE* const asked = popen(("/usr/bin/python3 " + file).c_str(), "r")) {
        char piece[256];
        while (fgets(piece, sizeof piece, asked) != nullptr) said += piece;
        pclose(asked);
    }
    REQUIRE(said.rfind("HTTP/1.1 200 ", 0) == 0);
    std::string fingerprint;
    for (std::size_t i = 13; i < 13 + 64; ++i) {
        if (i > 13 && i % 2 == 1) fingerprint += ':';
        fingerprint += static_cast<char>(std::toupper(static_cast<unsigned char>(said[i])));
    }
    // While it runs: afterwards the port can be another program's.
    CHECK(get(std::atoi(port.c_str()), "/").find("200") == std::string::npos);
    run.send(SIGINT);
    CHECK(run.wait() == 0);
    CHECK(run.error.find("\n" + fingerprint + "\n") != std::string::npos);
    unsetenv("XDG_STATE_HOME");
}

TEST_CASE("unfinished TLS handshakes do not exclude browsers with a token", "[cli][web]") {
    const WebSystem system;
    setenv("XDG_STATE_HOME", system.scratch.path("state").c_str(), 1);
    Program run({"run", system.file, "--listen", "127.0.0.1"});
    REQUIRE(run.wait_for_error("must be this one\n"));
    unsetenv("XDG_STATE_HOME");
    const std::string address = run.error.substr(run.error.find("127.0.0.1:"));
    const std::string port = std::to_string(std::atoi(address.c_str() + 10));
    const std::string token = address.substr(address.find('#') + 1, 32);
    // Half of them say nothing, and half the beginning of a greeting.
    const std::string script =
        "import socket, ssl\n"
        "at, token = ('127.0.0.1', " +
        port + "), '" + token +
        "'\n"
        "idle = [socket.create_connection(at) for _ in range(120)]\n"
        "for each in idle[::2]: each.send(b'\\x16\\x03\\x01\\x02\\x00\\x01')\n"
        "context = ssl._create_unverified_context()\n"
        "browsers = []\n"
        "for _ in range(20):\n"
        "    link = context.wrap_socket(socket.create_connection(at))\n"
        "    host = '127.0.0.1:' + str(at[1])\n"
        "    link.sendall(('GET /ws HTTP/1.1\\r\\nHost: ' + host + '\\r\\nConnection: Upgrade\\r\\nUpgrade: "
        "websocket\\r\\n'\n"
        "        'Sec-WebSocket-Version: 13\\r\\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\\r\\nOrigin: https://' + "
        "host +\n"
        "        '\\r\\nSec-WebSocket-Protocol: nezumi, token.' + token + '\\r\\n\\r\\n').encode())\n"
        "    print(link.recv(12).decode())\n"
        "    browsers.append(link)\n";
    const std::string file = system.scratch.write("ask.py", script).string();
    std::string said;
    if (FILE* const asked = popen(("/usr/bin/python3 " + file).c_str(), "r")) {
        char piece[256];
        while (fgets(piece, sizeof piece, asked) != nullptr) said += piece;
        pclose(asked);
    }
    std::string expected;
    for (int i = 0; i < 20; ++i) expected += "HTTP/1.1 101\n";
    CHECK(said == expected);
}

TEST_CASE("a run with --open shows the desktop's browser the page by a file, so that no command line has its token",
          "[cli][web]") {
    const WebSystem system;
    const std::string told = system.scratch.path("told").string();
    REQUIRE(mkfifo(told.c_str(), 0600) == 0);
    const auto browser = system.scratch.write("bin/xdg-open", "#!/bin/sh\n(echo \"$1\"; cat \"$1\") > " + told + "\n");
    std::filesystem::permissions(browser, std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (browser.parent_path().string() + ":" + path).c_str(), 1);
    setenv("DISPLAY", ":77", 1);
    const int file = open(told.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    Program run({"run", system.file, "--open"});
    setenv("PATH", path.c_str(), 1);
    unsetenv("DISPLAY");
    REQUIRE(run.wait_for_error("\n"));
    const std::string begin = "in a browser: ";
    const std::string url = run.error.substr(begin.size(), run.error.find('\n') - begin.size());
    std::string said;
    pollfd waits{.fd = file, .events = POLLIN, .revents = 0};
    for (char piece[4096]; said.find("</a>") == std::string::npos && poll(&waits, 1, 30'000) == 1;) {
        const ssize_t got = read(file, piece, sizeof piece);
        if (got <= 0) break;
        said.append(piece, static_cast<std::size_t>(got));
    }
    close(file);
    const std::string address = said.substr(0, said.find('\n'));
    CHECK(address.rfind(".html") == address.size() - 5);
    CHECK(address.find(url.substr(url.find('#') + 1)) == std::string::npos);
    CHECK(said.find("url=" + url + "\"") != std::string::npos);
    run.send(SIGINT);
    CHECK(run.wait() == 0);
}

TEST_CASE("the prompt begins with the page's address", "[cli][web][prompt]") {
    const WebSystem system;
    system.scratch.write("home/.keep", "");
    PtyProgram it({"run", system.file}, system.scratch.path("home").string(), 120);
    REQUIRE(it.wait_for_prompt("nezumi>"));
    REQUIRE(it.screen.rows().size() >= 2);
    CHECK(it.screen.rows()[0] == "s is running; help() shows the commands, Ctrl-D ends it");
    CHECK(port_in(it.screen.rows()[1]) > 0);
}
