// Cyclone DDS itself, on the loopback: octets as they were written, and who is there.
#include <arpa/inet.h>
#include <linux/filter.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <thread>

#include "bindings/dds/cyclone.hpp"
#include "bindings/dds/domain_xml.hpp"
#include "bindings/dds/port_topic.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

// Waits for at most 10 s.
bool comes(const std::function<bool()>& what) {
    for (int i = 0; i < 1000; ++i) {
        if (what()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

std::unique_ptr<DdsTransport> join(std::uint32_t domain) {
    auto place = open_cyclone({.domain = domain, .xml = domain_xml("", {})});
    INFO((place ? std::string() : place.error().message));
    REQUIRE(place.has_value());
    return std::move(*place);
}

// CDR of any length that begins as CDR does.
Octets cdr(std::size_t size) {
    Octets bytes(size, 0x5a);
    bytes[0] = 0;
    bytes[1] = 1;
    bytes[2] = bytes[3] = 0;
    bytes.back() = 0x77;
    return bytes;
}

}  // namespace

TEST_CASE("messages of any length arrive unchanged", "[dds][cyclone][wallclock]") {
    const auto place = join(211);
    Topic topic = topic_of("a", "b.c", message_of<std::string>());
    topic.depth = 16;
    const auto reader = place->read(topic);
    const auto writer = place->write(topic);
    REQUIRE(reader != nullptr);
    REQUIRE(writer != nullptr);
    REQUIRE(comes([&] { return writer->readers() == 1 && reader->writers().size() == 1; }));
    const std::vector<std::size_t> sizes{5, 6, 7, 8, 1200, 65537, 921604};
    for (const std::size_t size : sizes) REQUIRE(writer->write(cdr(size)));
    std::vector<TopicSample> got;
    REQUIRE(comes([&] {
        for (TopicSample& sample : reader->take()) got.push_back(std::move(sample));
        return got.size() == sizes.size();
    }));
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        CAPTURE(sizes[i]);
        CHECK(got[i].bytes == cdr(sizes[i]));
        CHECK(got[i].writer == reader->writers().front());
    }
}

TEST_CASE("a reader wakes a waiting thread, and a writer that keeps all reports a full queue",
          "[dds][cyclone][wallclock]") {
    const auto place = join(220);
    const Topic topic{.name = "nezumi/a/steps/b",
                      .type = "nezumi::Step",
                      .reliable = true,
                      .keeps_all = true,
                      .wakes = true,
                      .depth = 8};
    const auto reader = place->read(topic);
    const auto writer = place->write(topic);
    REQUIRE(reader != nullptr);
    REQUIRE(writer != nullptr);
    REQUIRE(comes([&] { return writer->readers() == 1 && reader->writers().size() == 1; }));
    pollfd polled{.fd = reader->file(), .events = POLLIN, .revents = 0};
    CHECK(poll(&polled, 1, 0) == 0);
    REQUIRE(writer->write(cdr(100)));
    CHECK(poll(&polled, 1, 10'000) == 1);
    CHECK(reader->take().size() == 1);
    CHECK(poll(&polled, 1, 0) == 0);
    int written = 0;
    while (written < 1000 && writer->write(cdr(100))) ++written;
    CHECK(written >= topic.depth);
    CHECK(written < 1000);
    int taken = 0;
    CHECK(comes([&] {
        taken += static_cast<int>(reader->take().size());
        return taken == written;
    }));
}

TEST_CASE("a message that a reader rejects does not displace waiting ones", "[dds][cyclone][wallclock]") {
    const auto place = join(216);
    Topic topic = topic_of("a", "b.c", message_of<std::string>());
    topic.depth = 1;
    const auto writer = place->write(topic);
    std::atomic<int> asked = 0;
    topic.admits = [&](std::span<const std::uint8_t> bytes) {
        ++asked;
        return bytes.size() != 70'001;
    };
    const auto reader = place->read(topic);
    REQUIRE(comes([&] { return writer->readers() == 1; }));
    for (const std::size_t size : {std::size_t{9}, std::size_t{11}, std::size_t{70'001}})
        REQUIRE(writer->write(cdr(size)));
    REQUIRE(comes([&] { return asked == 3; }));
    const auto got = reader->take();
    REQUIRE(got.size() == 1);
    CHECK(got[0].bytes == cdr(11));
}

TEST_CASE("a late reader gets the stored message", "[dds][cyclone][wallclock]") {
    const auto place = join(212);
    const Topic topic{.name = "nezumi/hosts", .type = "nezumi::Announcement", .reliable = true, .keeps_last = true};
    const auto writer = place->write(topic);
    REQUIRE(writer->write(cdr(9)));
    REQUIRE(writer->write(cdr(10)));
    const auto reader = place->read(topic);
    std::vector<TopicSample> got;
    REQUIRE(comes([&] {
        for (TopicSample& sample : reader->take()) got.push_back(std::move(sample));
        return !got.empty();
    }));
    CHECK(got.back().bytes == cdr(10));
}

TEST_CASE("writers and readers in a domain are listed until they end", "[dds][cyclone][wallclock]") {
    const auto place = join(213);
    const auto is_seen = [&](bool writes) {
        for (const SeenEndpoint& each : place->seen()) {
            if (each.topic == "rt/cmd_vel" && each.writes == writes)
                return each.type == "geometry_msgs::msg::dds_::Twist_" && each.own;
        }
        return false;
    };
    const Topic topic{.name = "rt/cmd_vel", .type = "geometry_msgs::msg::dds_::Twist_"};
    auto writer = place->write(topic);
    CHECK(comes([&] { return is_seen(true); }));
    CHECK_FALSE(is_seen(false));
    writer.reset();
    CHECK(comes([&] { return !is_seen(true); }));
}

TEST_CASE("on the loopback messages of other computers are ignored", "[dds][cyclone]") {
    const auto filtered = [](bool loopback) {
        const auto place = open_cyclone({.domain = 215, .xml = domain_xml("", {}), .loopback = loopback});
        REQUIRE(place.has_value());
        std::vector<bool> all;  // of the sockets that every address of this computer reaches
        for (int descriptor = 0; descriptor < 256; ++descriptor) {
            sockaddr_in address{};
            socklen_t size = sizeof address;
            if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) continue;
            const int port = ntohs(address.sin_port);
            if (address.sin_family != AF_INET || address.sin_addr.s_addr != INADDR_ANY || port < 7400 + 250 * 215)
                continue;
            std::array<sock_filter, 16> program{};
            socklen_t length = program.size();  // in instructions
            REQUIRE(getsockopt(descriptor, SOL_SOCKET, SO_GET_FILTER, program.data(), &length) == 0);
            all.push_back(length > 0 && program[1].k == if_nametoindex("lo"));
        }
        return all;
    };
    CHECK(filtered(true) == std::vector<bool>{true, true});
    CHECK(filtered(false) == std::vector<bool>{false, false});
}

TEST_CASE("a missing interface is reported in one line", "[dds][cyclone]") {
    const auto place = open_cyclone({.domain = 214, .xml = domain_xml("none9", {})});
    REQUIRE_FALSE(place.has_value());
    CHECK(place.error().message.find("none9") != std::string::npos);
    CHECK(place.error().message.find('\n') == std::string::npos);
}
