// The table of hosts, with any announcements.
#include <array>
#include <catch2/catch.hpp>

#include "bindings/dds/announced_types.hpp"
#include "bindings/dds/host_table.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

constexpr std::uint64_t own = 77;

Announcement announcement(std::uint64_t run, std::uint64_t number, std::vector<std::uint64_t> heard = {}) {
    Announcement all;
    all.head = {.protocol = protocol, .host = "ev3", .version = "1.0"};
    all.run = run;
    all.number = number;
    all.heard = std::move(heard);
    return all;
}

struct Table {
    explicit Table(bool answered) : hosts({.protocol = protocol, .host = "me", .version = "1.0"}, own, answered) {}

    void heard(std::uint64_t writer, const Announcement& said) { hosts.heard(writer, write_announcement(said), 0); }
    // Of the announcement that counts; 0: the host is not there.
    std::uint64_t run() const { return hosts.find("ev3") != nullptr ? hosts.find("ev3")->run : 0; }
    std::uint64_t number() const { return hosts.find("ev3") != nullptr ? hosts.find("ev3")->number : 0; }

    HostTable hosts;
};

}  // namespace

TEST_CASE("recorded announcements do not replace a host that has left", "[dds][secret]") {
    Table table(true);
    table.heard(1, announcement(5, 1));
    table.heard(2, announcement(6, 1, {own}));
    CHECK(table.run() == 6);
    table.hosts.keep(std::array<std::uint64_t, 1>{1}, 1);
    CHECK(table.run() == 0);
}

TEST_CASE("recorded announcements do not end a host's run or undo its later ones", "[dds][secret]") {
    Table table(true);
    table.heard(1, announcement(6, 1, {own}));
    table.heard(2, announcement(5, 9));
    CHECK(table.run() == 6);
    table.heard(1, announcement(6, 3, {own}));
    CHECK(table.number() == 3);
    table.heard(3, announcement(6, 2, {own}));
    CHECK(table.number() == 3);
    table.hosts.keep(std::array<std::uint64_t, 2>{2, 3}, 1);
    CHECK(table.run() == 0);
}

TEST_CASE("the older of two hosts with one name is used again when the newer one has left", "[dds]") {
    Table table(false);
    table.heard(1, announcement(5, 1));
    table.heard(2, announcement(6, 1));
    CHECK(table.run() == 6);
    table.hosts.keep(std::array<std::uint64_t, 1>{1}, 1);
    CHECK(table.run() == 5);
    table.heard(1, announcement(5, 2));
    CHECK(table.number() == 2);
}

TEST_CASE("a writer belongs to one host, one run and one version", "[dds]") {
    Table table(false);
    table.heard(1, announcement(5, 1));
    static_cast<void>(table.hosts.take_news());
    Announcement other = announcement(5, 2);
    other.head.version = "2.0";
    table.heard(1, other);
    table.heard(1, announcement(6, 2));
    CHECK(table.run() == 5);
    CHECK(table.number() == 1);
    CHECK(table.hosts.take_news().empty());
}

TEST_CASE("an announcement that is too large or has invalid names is reported once and rejected", "[dds]") {
    const auto refused = [](const Announcement& said) {
        Table table(false);
        table.heard(1, said);
        const auto news = table.hosts.take_news();
        table.heard(1, said);
        return table.run() == 0 && news.size() == 1 && news[0].level == LogLevel::error &&
               table.hosts.take_news().empty();
    };
    Announcement fits = announcement(5, 1);
    fits.ports = {{"part.out", "TimedVelocity2D", false}, {"part.in", "TimedVelocity2D", true}};
    fits.wants = {{"ev3/part.out", "me/part.in"}};
    CHECK_FALSE(refused(fits));
    Announcement said = fits;
    said.wants.assign(1025, fits.wants[0]);
    CHECK(refused(said));
    said = fits;
    said.ports.assign(16'385, fits.ports[0]);
    CHECK(refused(said));
    said = fits;
    said.refusals = {{"ev3/part.out", "me/part.in", std::string(1001, 'x')}};
    CHECK(refused(said));
    fits.types = {{"Obstacle_0123", "Obstacle", {{"distance", "finite number in m"}}}};
    CHECK_FALSE(refused(fits));
    said = fits;
    said.types.assign(most_types + 1, fits.types[0]);
    CHECK(refused(said));
    said = fits;
    said.types[0].fields.assign(most_fields + 1, fits.types[0].fields[0]);
    CHECK(refused(said));
    said = fits;
    said.types[0].fields[0].values = std::string(longest_name + 1, 'x');
    CHECK(refused(said));
    for (const std::string& wrong : {std::string("part"), std::string("part."), std::string("a b.c"),
                                     std::string("\x1b[2J.x"), std::string(300, 'a') + ".b"}) {
        CAPTURE(wrong);
        said = fits;
        said.ports[0].name = wrong;
        CHECK(refused(said));
        said = fits;
        said.wants[0].from = "ev3/" + wrong;
        CHECK(refused(said));
    }
}
