// Clients that are slow, silent, gone or out of their mind never keep the thread that ticks waiting.
#include "bindings/console/transport.hpp"

#include <catch2/catch.hpp>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bindings/console/client.hpp"
#include "bindings/console/put_text.hpp"

using namespace nezumi;
using Incoming = Transport::Incoming;

namespace {

using Clock = std::chrono::steady_clock;

struct Pair {
    Descriptor system, client;
};

Pair make_pair() {
    int ends[2] = {-1, -1};
    REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
    return {Descriptor(ends[0]), Descriptor(ends[1])};
}

void write_text(const Descriptor& socket, std::string_view text) {
    while (!text.empty()) {
        const ssize_t sent = ::send(socket.get(), text.data(), text.size(), MSG_NOSIGNAL);
        REQUIRE(sent > 0);
        text.remove_prefix(static_cast<std::size_t>(sent));
    }
}

// What comes until there is something of this kind, which is the last.
std::vector<Incoming> take_until(Transport& transport, Incoming::What what) {
    std::vector<Incoming> all;
    const auto end = Clock::now() + std::chrono::seconds(10);
    while (Clock::now() < end) {
        pollfd file{.fd = transport.file(), .events = POLLIN, .revents = 0};
        poll(&file, 1, 1000);
        for (Incoming& incoming : transport.take()) {
            all.push_back(std::move(incoming));
            if (all.back().what == what) return all;
        }
    }
    FAIL("nothing of the kind came");
    return all;
}

}  // namespace

TEST_CASE("a request reaches the system, and its answer the client", "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    const ClientId id = transport.add(std::move(pair.system), Transport::Flow::lossy);
    ConsoleClient client(std::move(pair.client));
    const std::int64_t asked = client.send({.kind = Request::Kind::eval, .text = "ls()"});
    const auto all = take_until(transport, Incoming::What::request);
    REQUIRE(all.size() == 2);
    CHECK(all[0].what == Incoming::What::opened);
    CHECK(all[1].client == id);
    CHECK(all[1].request.text == "ls()");
    transport.send(id, {.kind = Event::Kind::answer, .id = all[1].request.id, .text = {}});
    const auto answer = client.next(10000);
    REQUIRE(answer);
    CHECK(answer->id == asked);
}

TEST_CASE("a line that can't be read is answered with an error, and the next request works", "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    transport.add(std::move(pair.system), Transport::Flow::lossy);
    write_text(pair.client, std::string("\0\xFF\n", 3) + "{\"do\":\"dance\"}\n");
    write_text(pair.client, std::string(3 * max_line, 'x'));
    write_text(pair.client, "\n{\"do\":\"eval\",\"te");
    write_text(pair.client, "xt\":\"1\"}\n");
    const auto all = take_until(transport, Incoming::What::request);
    CHECK(all.back().request.text == "1");
    ConsoleClient client(std::move(pair.client));
    for (const std::string message :
         {"not understood: expected one JSON object on a line, got \\x00\xEF\xBF\xBD",
          "not understood: 'do' must be one of hello eval complete is_complete interrupt key",
          "not understood: a line of more than 1048576 bytes was left out"}) {
        const auto event = client.next(10000);
        REQUIRE(event);
        CHECK(event->kind == Event::Kind::error);
        CHECK(event->text == message);
    }
}

TEST_CASE("a client that disconnects in the middle of a line is removed, and nothing else happens",
          "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    const ClientId id = transport.add(std::move(pair.system), Transport::Flow::lossy);
    write_text(pair.client, "{\"do\":\"ev");
    pair.client.close();
    const auto all = take_until(transport, Incoming::What::closed);
    REQUIRE(all.size() == 2);
    CHECK(all.back().client == id);
    transport.send(id, {.text = "to nobody"});
}

TEST_CASE("nothing remains of a client that has left", "[console][transport]") {
    const auto open_files = [] {
        const std::filesystem::directory_iterator files("/proc/self/fd");
        return std::distance(begin(files), end(files));
    };
    Transport transport;
    const auto before = open_files();
    for (int i = 0; i < 5; ++i) {
        Pair pair = make_pair();
        transport.add(std::move(pair.system), Transport::Flow::lossy);
        write_text(pair.client, "{\"do\":\"eval\",\"id\":1,\"text\":\"1\"}\n");
        pair.client.close();
        take_until(transport, Incoming::What::closed);
    }
    CHECK(open_files() == before);
}

TEST_CASE("a client that closes its sending side still gets its answer", "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    const ClientId id = transport.add(std::move(pair.system), Transport::Flow::lossy);
    write_text(pair.client, "{\"do\":\"eval\",\"id\":3,\"text\":\"1\"}\n");
    shutdown(pair.client.get(), SHUT_WR);
    take_until(transport, Incoming::What::request);
    transport.send(id, {.kind = Event::Kind::answer, .id = 3, .text = {}});
    transport.finish_request(id);
    ConsoleClient client(std::move(pair.client));
    const auto answer = client.next(10000);
    REQUIRE(answer);
    CHECK(answer->id == 3);
    take_until(transport, Incoming::What::closed);
}

TEST_CASE("a client that does not read loses output, gets the number of lost events, and delays nothing",
          "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    const ClientId id = transport.add(std::move(pair.system), Transport::Flow::lossy);
    const std::string text(1000, 'x');
    constexpr std::size_t sent = 20000;
    for (std::size_t count = 0; count < sent; ++count) transport.send(id, {.text = text});
    transport.send(id, {.kind = Event::Kind::answer, .id = 1, .text = {}});

    ConsoleClient client(std::move(pair.client));
    std::size_t shown = 0;
    std::size_t lost = 0;
    bool answered = false;
    while (shown + lost < sent || !answered) {
        const auto event = client.next(10000);
        REQUIRE(event);
        if (event->kind == Event::Kind::output) ++shown;
        if (event->kind == Event::Kind::lost) lost += event->count;
        answered = answered || event->kind == Event::Kind::answer;
        // The count comes with the first event that there is room for.
        if (answered && shown + lost < sent) transport.send(id, {.kind = Event::Kind::keys, .text = {}});
    }
    CHECK(shown + lost == sent);
    CHECK(lost > 10000);
    CHECK(shown * text.size() < 3 * Transport::max_backlog);
}

TEST_CASE("the number of lost events is sent before the answer", "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    const ClientId id = transport.add(std::move(pair.system), Transport::Flow::lossy);
    CHECK(transport.takes_more(id));
    for (int i = 0; i < 5000; ++i) transport.send(id, {.kind = Event::Kind::output, .text = std::string(1000, 'x')});
    CHECK_FALSE(transport.takes_more(id));
    transport.send(id, {.kind = Event::Kind::answer, .id = 1, .text = {}});
    ConsoleClient client(std::move(pair.client));
    std::size_t shown = 0;
    std::size_t lost = 0;
    for (auto event = client.next(10000); event && event->kind != Event::Kind::answer; event = client.next(10000)) {
        if (event->kind == Event::Kind::output) ++shown;
        if (event->kind == Event::Kind::lost) lost += event->count;
    }
    CHECK(lost > 0);
    CHECK(shown + lost == 5000);
    CHECK(transport.takes_more(id));
}

TEST_CASE("a lossless client gets everything if the run waits for it", "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    const ClientId id = transport.add(std::move(pair.system), Transport::Flow::lossless);
    CHECK_FALSE(transport.is_behind());
    constexpr std::size_t sent = 5000;
    for (std::size_t count = 0; count < sent; ++count) transport.send(id, {.text = std::string(1000, 'x')});
    CHECK(transport.is_behind());
    CHECK_FALSE(transport.takes_more(id));
    ConsoleClient client(std::move(pair.client));
    std::size_t shown = 0;
    while (shown < sent && client.next(10000)) ++shown;
    CHECK(shown == sent);
    CHECK_FALSE(transport.is_behind());
    CHECK(transport.takes_more(id));
}

TEST_CASE("a lossless client that never reads delays nothing, and its lost events are counted",
          "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    const ClientId id = transport.add(std::move(pair.system), Transport::Flow::lossless);
    const std::string text(1'000'000, 'x');
    constexpr std::size_t sent = 100;
    for (std::size_t count = 0; count < sent; ++count) transport.send(id, {.text = text});
    transport.send(id, {.kind = Event::Kind::answer, .id = 1, .text = {}});
    ConsoleClient client(std::move(pair.client));
    std::size_t shown = 0;
    std::size_t lost = 0;
    for (auto event = client.next(10000); event && event->kind != Event::Kind::answer; event = client.next(10000)) {
        if (event->kind == Event::Kind::output) ++shown;
        if (event->kind == Event::Kind::lost) lost += event->count;
    }
    CHECK(lost > 0);
    CHECK(shown + lost == sent);
}

TEST_CASE("unfinished requests of a client are limited", "[console][transport]") {
    Transport transport;
    Pair pair = make_pair();
    const ClientId id = transport.add(std::move(pair.system), Transport::Flow::lossy);
    const std::string request = "{\"do\":\"eval\",\"text\":\"" + std::string(60000, 'x') + "\"}\n";
    constexpr std::size_t sent = 200;
    std::thread writer([&] {
        for (std::size_t count = 0; count < sent; ++count) write_text(pair.client, request);
    });
    std::size_t taken = 0;
    std::size_t most = 0;
    while (taken < sent) {  // however long that takes: the writer can't be left waiting
        if (taken == 0) std::this_thread::sleep_for(std::chrono::milliseconds(200));
        std::size_t more = 0;
        for (const Incoming& incoming : transport.take()) more += incoming.what == Incoming::What::request ? 1 : 0;
        taken += more;
        most = std::max(most, more);
        for (std::size_t count = 0; count < more; ++count) transport.finish_request(id);
    }
    writer.join();
    CHECK(taken == sent);
    CHECK(most <= Transport::max_requests + 2);
}

TEST_CASE("a client of another user is refused with a message", "[console][attach]") {
    char name[] = "/tmp/nezumi-other-XXXXXX";
    const std::filesystem::path folder = mkdtemp(name);
    {
        Transport transport;
        auto listener = Listener::open("mine", folder);
        REQUIRE(listener);
        transport.listen(std::move(*listener), geteuid() + 1);
        auto reached = connect_to_system("mine", folder);
        REQUIRE(reached);
        ConsoleClient client(std::move(reached->socket));
        client.send({.kind = Request::Kind::eval, .text = "quit()"});
        const auto event = client.next(10000);
        REQUIRE(event);
        CHECK(event->kind == Event::Kind::bye);
        CHECK(event->text == "the system belongs to another user");
        CHECK_FALSE(client.next(10000));
        CHECK_FALSE(client.is_open());
        CHECK(transport.take().empty());
    }
    std::filesystem::remove_all(folder);
}

TEST_CASE("silent clients do not block new ones: the oldest is disconnected first", "[console][attach]") {
    char name[] = "/tmp/nezumi-idle-XXXXXX";
    const std::filesystem::path folder = mkdtemp(name);
    {
        Transport transport;
        auto listener = Listener::open("it", folder);
        REQUIRE(listener);
        transport.listen(std::move(*listener), geteuid());
        const auto attach = [&] {
            auto reached = connect_to_system("it", folder);
            REQUIRE(reached);
            return ConsoleClient(std::move(reached->socket));
        };
        const auto speak = [&](ConsoleClient& client) {
            client.send({.kind = Request::Kind::hello, .text = {}});
            const auto incoming = take_until(transport, Incoming::What::request);
            transport.finish_request(incoming.back().client);
        };
        ConsoleClient first = attach();
        speak(first);
        std::vector<ConsoleClient> silent;
        for (int i = 0; i < 100; ++i) silent.push_back(attach());
        std::vector<ConsoleClient> speaking;
        for (std::size_t i = 1; i < Transport::max_clients; ++i) {
            speaking.push_back(attach());
            speak(speaking.back());
        }
        // All speak by now: they keep their places.
        ConsoleClient one_more = attach();
        const auto event = one_more.next(10000);
        REQUIRE(event);
        CHECK(event->kind == Event::Kind::bye);
        CHECK(event->text == "too many consoles are attached");
        speak(first);
        CHECK_FALSE(silent.front().next(10000));
        CHECK_FALSE(silent.front().is_open());
    }
    std::filesystem::remove_all(folder);
}

TEST_CASE("clients get a message when the system ends, and do not delay the end", "[console][transport]") {
    Pair reads = make_pair();
    Pair sleeps = make_pair();
    const auto begin = Clock::now();
    {
        Transport transport;
        transport.add(std::move(reads.system), Transport::Flow::lossy);
        const ClientId id = transport.add(std::move(sleeps.system), Transport::Flow::lossy);
        for (int count = 0; count < 5000; ++count) transport.send(id, {.text = std::string(1000, 'x')});
    }
    CHECK(Clock::now() - begin < std::chrono::seconds(5));
    ConsoleClient client(std::move(reads.client));
    const auto event = client.next(10000);
    REQUIRE(event);
    CHECK(event->kind == Event::Kind::bye);
    CHECK(event->text == "the system has ended");
}

TEST_CASE("the end does not wait for clients that have received everything", "[console][transport][wallclock]") {
    auto quickest = std::chrono::steady_clock::duration::max();
    for (int attempt = 0; attempt < 5; ++attempt) {  // the farewell of one that does not read takes 300 ms
        auto transport = std::make_unique<Transport>();
        Pair one = make_pair();
        transport->add(std::move(one.system), Transport::Flow::lossy);
        const auto begin = Clock::now();
        transport.reset();
        quickest = std::min(quickest, Clock::now() - begin);
    }
    CHECK(quickest < std::chrono::milliseconds(200));
}

TEST_CASE("only the answer to the request counts as an answer of the system", "[console][client]") {
    Pair pair = make_pair();
    ConsoleClient client(std::move(pair.client));
    write_text(pair.system, "{\"is\":\"output\",\"id\":99,\"text\":\"of another\"}\n");
    CHECK_FALSE(client.is_answered(50));
    write_text(pair.system, "{\"is\":\"answer\",\"id\":2,\"ok\":true}\n");
    CHECK(client.is_answered(10'000));
    pair.system.close();
    CHECK_FALSE(client.is_answered(10'000));
}

TEST_CASE("writing text reports whether everything was written", "[console]") {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
    REQUIRE(file != nullptr);
    CHECK(put_text(file.get(), "some text"));
    CHECK(put_text(file.get(), ""));
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> full(std::fopen("/dev/full", "w"), std::fclose);
    REQUIRE(full != nullptr);
    std::setbuf(full.get(), nullptr);
    CHECK_FALSE(put_text(full.get(), "some text"));
}
