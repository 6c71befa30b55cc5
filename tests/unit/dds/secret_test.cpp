// Messages that only those write and read who have a secret, and announcements that were kept from earlier.
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <thread>
#include <vector>

#include "bindings/dds/host_table.hpp"
#include "bindings/dds/network_maker.hpp"
#include "bindings/dds/network_word.hpp"
#include "bindings/dds/sealed_transport.hpp"
#include "bindings/dds/user_secret.hpp"
#include "tests/unit/dds/host_rig.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

const Topic topic{.name = "nezumi/hosts", .type = "nezumi::Announcement", .reliable = true, .depth = 8};
const Octets message{0, 1, 0, 0, 7, 8, 9};

Octets announced(const std::string& host, std::uint64_t run, std::uint64_t number, std::vector<std::uint64_t> heard) {
    Announcement all;
    all.head = {.protocol = protocol, .host = host, .version = "1.0"};
    all.run = run;
    all.number = number;
    all.heard = std::move(heard);
    return write_announcement(all);
}

}  // namespace

TEST_CASE("a message is decrypted only with the same secret for the same topic", "[dds][secret]") {
    const Secret secret = make_secret();
    const Octets sealed = seal(message, topic, secret);
    CHECK(unseal(sealed, topic, secret) == message);
    CHECK(seal(message, topic, secret) != sealed);
    CHECK_FALSE(unseal(sealed, topic, make_secret()).has_value());
    Topic other = topic;
    other.name = "nezumi/others";
    CHECK_FALSE(unseal(sealed, other, secret).has_value());
    for (std::size_t i = 0; i < sealed.size(); ++i) {
        CAPTURE(i);
        Octets changed = sealed;
        changed[i] ^= 1;
        const auto opened = unseal(changed, topic, secret);
        CHECK((!opened || *opened == message));  // the header's last two bytes mean nothing
        changed.resize(i);
        CHECK_FALSE(unseal(changed, topic, secret).has_value());
    }
    CHECK(std::search(sealed.begin(), sealed.end(), message.begin() + 4, message.end()) == sealed.end());
}

TEST_CASE("a secret is a line of text in a file", "[dds][secret]") {
    const Secret secret = make_secret();
    const std::string text = secret_text(secret);
    CHECK(text.starts_with("nezumi secret 1\n"));
    CHECK(secret_from(text) == secret);
    CHECK(make_secret() != secret);
    for (const std::string& wrong : {std::string(), std::string("nezumi secret 1\n"), text.substr(16),
                                     text.substr(0, text.size() - 5), text + "AAAA"}) {
        CAPTURE(wrong);
        CHECK(secret_from(wrong).error().message ==
              "is not valid: make one with `nezumi network secret FILE`, and copy it to each host");
    }
}

TEST_CASE("hosts with different secrets, or without one, do not receive each other's messages", "[dds][secret]") {
    FakeDomain domain;
    const auto one = domain.join(), two = domain.join(), open = domain.join();
    const Secret secret = make_secret();
    const auto sealed_one = make_sealed_transport(*one, secret);
    const auto sealed_two = make_sealed_transport(*two, secret);
    const auto stranger = make_sealed_transport(*open, make_secret());
    const auto reader = sealed_two->read(topic);
    const auto others = open->read(topic);
    const auto writer = sealed_one->write(topic);
    writer->write(message);
    auto got = reader->take();
    REQUIRE(got.size() == 1);
    CHECK(got[0].bytes == message);
    CHECK(others->take().empty());
    stranger->write(topic)->write(message);
    open->write(topic)->write(message);
    CHECK(reader->take().empty());
}

TEST_CASE("messages without encryption do not displace encrypted ones", "[dds][secret]") {
    FakeDomain domain;
    const auto inner = domain.join(), stranger = domain.join();
    const auto place = make_sealed_transport(*inner, make_secret());
    Topic newest = topic;
    newest.depth = 1;
    const auto reader = place->read(newest);
    place->write(newest)->write(message);
    Topic sealed = newest;
    sealed.name = "sealed/" + newest.name;
    sealed.type = "nezumi::Sealed";
    const auto writer = stranger->write(sealed);
    writer->write(message);
    writer->write(seal(message, newest, make_secret()));
    const auto samples = reader->take();
    REQUIRE(samples.size() == 1);
    CHECK(samples[0].bytes == message);
}

TEST_CASE("a stored and replayed announcement is ignored", "[dds][secret]") {
    const std::uint64_t own = 77;
    HostTable hosts({.protocol = protocol, .host = "me", .version = "1.0"}, own, true);
    hosts.heard(1, announced("ev3", 5, 1, {}), 0);  // of a time before this run
    CHECK(hosts.find("ev3") == nullptr);
    CHECK(hosts.heard_runs() == std::vector<std::uint64_t>{5});
    hosts.heard(1, announced("ev3", 5, 2, {own}), 0);
    REQUIRE(hosts.find("ev3") != nullptr);
    hosts.heard(1, announced("ev3", 5, 1, {}), 0);  // an older one of the same run
    REQUIRE(hosts.find("ev3") != nullptr);
    hosts.heard(2, announced("ev3", 6, 1, {own}), 1);  // it has started again
    REQUIRE(hosts.find("ev3") != nullptr);
    CHECK(hosts.find("ev3")->run == 6);
    hosts.heard(3, announced("ev3", 5, 9, {own}), 2);  // and what it said before is sent again
    CHECK(hosts.find("ev3")->run == 6);
}

TEST_CASE("the secret of a user is made once and readable only by the user", "[dds][secret]") {
    const Scratch scratch;
    const auto file = scratch.path() / "state" / "nezumi" / "network.secret";
    std::vector<Expected<Secret>> made(8, failure("not asked"));
    std::vector<std::thread> askers;
    for (auto& each : made) askers.emplace_back([&] { each = user_secret(file); });
    for (std::thread& each : askers) each.join();
    REQUIRE(made[0]);
    for (const auto& each : made) CHECK(each == made[0]);
    CHECK(user_secret(file) == made[0]);
    struct stat status {};
    REQUIRE(stat(file.c_str(), &status) == 0);
    CHECK((status.st_mode & 0777) == 0600);
    CHECK(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}) == 1);
    chmod(file.c_str(), 0644);
    CHECK(user_secret(file).error().message ==
          "the secret '" + file.string() + "' can be read by others: chmod 600 " + file.string());
}

TEST_CASE("a secret that can't be stored is an error with advice", "[dds][secret]") {
    const Scratch scratch;
    scratch.write("file", "");
    const auto refused = user_secret(scratch.path() / "file" / "network.secret");
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message == "no secret for the hosts of this user in '" +
                                         (scratch.path() / "file/network.secret").string() +
                                         "': Not a directory; set `secret = FILE` (`nezumi network secret FILE` makes "
                                         "one), or `open = true` to let every user of this computer drive");
    CHECK(user_secret("").error().message.find("this user has no home") != std::string::npos);
    std::filesystem::create_directory(scratch.path() / "network.secret");
    CHECK(user_secret(scratch.path() / "network.secret").error().message.find("it is not a file of this user") !=
          std::string::npos);
}

namespace {

// Hosts of systems, each made as a run makes it, and for a user of its own.
struct UsersHost {
    UsersHost(FakeDomain& domain, const Scratch& scratch, const std::string& user, NetworkSpec network)
        : domains([&domain](const DomainOptions&) { return Expected<std::unique_ptr<DdsTransport>>(domain.join()); }),
          system({}, [this](const LogLine& line) {
              if (line.level >= LogLevel::warn) log.push_back(line.text);
          }) {
        setenv("XDG_STATE_HOME", (scratch.path() / user).c_str(), 1);
        SystemSpec spec;
        network_word().put(spec, std::move(network));
        auto made = make_networks(domains, "1.0")(spec, system);
        if (!made) FAIL(made.error().message);
        system.take_network(std::move(*made));
    }
    void look() {
        system.network()->between_ticks([](const Act&, const Actor&) { return ActResult{}; },
                                        [](const Question&, bool, const Actor&) { return PlainData{}; });
    }
    bool hears(const std::string& name) {
        for (const Host& host : system.network()->hosts()) {
            if (host.name == name && host.here) return true;
        }
        return false;
    }
    Domains domains;
    std::vector<std::string> log;
    System system;
};

void meet(UsersHost& one, UsersHost& two) {
    for (int i = 0; i < 30; ++i) {
        one.look();
        two.look();
        std::this_thread::sleep_for(std::chrono::milliseconds(60));
    }
}

}  // namespace

TEST_CASE("on the loopback only hosts of the same user communicate", "[dds][secret][wallclock]") {
    const Scratch scratch;
    FakeDomain domain;
    UsersHost one(domain, scratch, "first", {.name = "one"});
    SECTION("the same user") {
        UsersHost two(domain, scratch, "first", {.name = "two"});
        meet(one, two);
        CHECK(one.hears("two"));
        CHECK(two.hears("one"));
        CHECK(one.log == std::vector<std::string>{});
    }
    SECTION("another user") {
        UsersHost two(domain, scratch, "second", {.name = "two"});
        meet(one, two);
        CHECK_FALSE(one.hears("two"));
        CHECK_FALSE(two.hears("one"));
        const std::vector<std::string> told{
            "network: a host with another secret (for example of another user) was found, but refused: set the "
            "same `secret = FILE` on both, or `open = true` on both"};
        CHECK(one.log == told);
        CHECK(two.log == told);
    }
    SECTION("a host without a secret") {
        UsersHost two(domain, scratch, "first", {.name = "two", .open = true});
        meet(one, two);
        CHECK_FALSE(one.hears("two"));
        CHECK(one.log ==
              std::vector<std::string>{"network: a host without a secret (open = true) was found, but refused: set the "
                                       "same `secret = FILE` on both, or `open = true` on both"});
        CHECK(two.log == std::vector<std::string>{"network: a host with a secret was found, but refused: set "
                                                  "the same `secret = FILE` on both, or `open = true` on both"});
    }
    unsetenv("XDG_STATE_HOME");
}

TEST_CASE("two hosts with open = true on the loopback communicate, also of different users",
          "[dds][secret][wallclock]") {
    const Scratch scratch;
    FakeDomain domain;
    UsersHost one(domain, scratch, "first", {.name = "one", .open = true});
    UsersHost two(domain, scratch, "second", {.name = "two", .open = true});
    meet(one, two);
    CHECK(one.hears("two"));
    CHECK(two.hears("one"));
    unsetenv("XDG_STATE_HOME");
}
