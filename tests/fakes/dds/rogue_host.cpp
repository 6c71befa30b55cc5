// A host among others that does not behave.
//
// Usage: rogue_host INTERFACE SECRET|- version VERSION PROTOCOL
//        rogue_host INTERFACE SECRET|- flood VICTIM
//
// Without a secret (-) it speaks on the topics of those that have one, in random octets. `version`: it announces itself
// as `future`, of another version, and wants to drive the host `follower`; what it is told of others is said. `flood`:
// it publishes announcements, values and requests for VICTIM as fast as it can, such that are well and such that are
// not, and says every second how many. It runs in the domain 7 until it is killed.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "bindings/dds/cyclone.hpp"
#include "bindings/dds/domain_xml.hpp"
#include "bindings/dds/host_table.hpp"
#include "bindings/dds/port_topic.hpp"
#include "bindings/dds/request.hpp"
#include "bindings/dds/sealed_transport.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/values/cdr.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

constexpr CdrFormat on_the_wire{.order = std::endian::little, .header = true};
constexpr std::uint64_t own_run = 4711;

[[noreturn]] void fail(const std::string& why) {
    std::fprintf(stderr, "rogue_host: %s\n", why.c_str());
    std::exit(1);
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

template <class Message>
Octets cdr(const Message& message) {
    Octets bytes;
    write_cdr(bytes, on_the_wire, message);
    return bytes;
}

/// A place in the domain, with the secret or without.
class Access {
public:
    Access(const std::string& interface, const std::string& secret) {
        auto opened = open_cyclone({.domain = 7, .xml = domain_xml(interface, {})});
        if (!opened) fail(opened.error().message);
        plain_ = std::move(*opened);
        if (secret == "-") return;
        const auto text = read_whole(secret, secret);
        const auto key = text ? secret_from(*text) : Expected<Secret>(Unexpected(text.error()));
        if (!key) fail(key.error().message);
        sealed_ = make_sealed_transport(*plain_, *key);
    }
    bool knows_secret() const { return sealed_ != nullptr; }
    std::unique_ptr<Writer> write(Topic topic) const {
        if (sealed_ != nullptr) return sealed_->write(topic);
        topic.name = "sealed/" + topic.name;
        topic.type = "nezumi::Sealed";
        return plain_->write(topic);
    }
    std::unique_ptr<Reader> read(const Topic& topic) const { return (sealed_ ? *sealed_ : *plain_).read(topic); }

private:
    std::unique_ptr<DdsTransport> plain_;
    std::unique_ptr<DdsTransport> sealed_;
};

/// This host's announcement, and those of others.
class Presence {
public:
    Presence(const Access& place, AnnouncementHead head)
        : table_(head, own_run, true), reader_(place.read(announcement_topic())) {
        said.head = std::move(head);
        said.run = own_run;
    }
    void look() {
        for (const TopicSample& sample : reader_->take()) table_.heard(sample.writer, sample.bytes, now());
        table_.keep(reader_->writers(), now());
        for (const HostTable::News& news : table_.take_news()) std::printf("%s\n", news.text.c_str());
        std::fflush(stdout);
        said.heard = table_.heard_runs();
    }
    std::uint64_t run_of(std::string_view host) const {
        const Announcement* its = table_.find(host);
        return its != nullptr ? its->run : 0;
    }

    Announcement said;

private:
    HostTable table_;
    std::unique_ptr<Reader> reader_;
};

[[noreturn]] void be_of_another_version(const Access& place, const std::string& version, std::uint32_t its_protocol) {
    Presence presence(place, {.protocol = its_protocol, .host = "future", .version = version});
    presence.said.ports = {{"driver.out", "TimedVelocity2D", false}};
    presence.said.wants = {{"future/driver.out", "follower/mouse.target_velocity_in"}};
    const auto announcer = place.write(announcement_topic());
    const auto driver = place.write(topic_of("future", "driver.out", message_of<Velocity2D>()));
    for (std::uint64_t number = 1;; ++number) {
        presence.look();
        if (number % 10 == 1) {
            ++presence.said.number;
            announcer->write(write_announcement(presence.said));
        }
        Octets bytes;
        write_cdr(bytes, on_the_wire, MessageHead{.run = own_run, .number = number, .stamp = now()},
                  Velocity2D{.vx = 0.3});
        driver->write(bytes);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

/// What a flood is made of.
class Flood {
public:
    Flood(const Access& place, std::string victim)
        : victim_(std::move(victim)),
          is_known_(place.knows_secret()),
          presence_(place, {.host = "rogue", .version = "0.1.0"}),
          announcer_(place.write(announcement_topic())),
          babbler_(place.write(announcement_topic())),
          values_(place.write(topic_of("rogue", "flood.out", message_of<std::int32_t>()))),
          leaders_(place.write(topic_of("leader", "vehicle.current_vel", message_of<Velocity2D>()))),
          requests_(place.write(request_topic(victim_))) {
        for (int i = 0; i < 2000; ++i)
            presence_.said.ports.push_back({fmt::format("flood.port{}", i), "TimedLong", i % 2 == 0});
        presence_.said.ports.push_back({"flood.out", "TimedLong", false});
    }

    /// One of each. Returns how many were sent.
    int send() {
        ++round_;
        if (round_ % 64 == 1) presence_.look();
        int sent = 0;
        const auto put = [&](const std::unique_ptr<Writer>& writer, const Octets& bytes) {
            sent += writer->write(is_known_ ? bytes : noise(bytes.size())) ? 1 : 0;
        };
        if (round_ % 16 == 1) put(announcer_, announcement());
        put(babbler_, noise(random_() % 2000 + 4));
        for (int i = 0; i < 8; ++i) put(values_, value());
        put(values_, noise(random_() % 100 + 4));
        if (!is_known_) put(leaders_, noise(random_() % 100 + 4));  // who knows the secret may drive, and would
        put(requests_, request());
        put(requests_, noise(random_() % 300 + 4));
        return sent;
    }

private:
    // Random, but for the header of CDR.
    Octets noise(std::size_t size) {
        Octets bytes(size);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
        bytes[0] = 0;
        bytes[1] = 1;
        return bytes;
    }
    // Connections that can't be, others each time, and one that can.
    Octets announcement() {
        ++presence_.said.number;
        presence_.said.wants = {{"rogue/flood.out", victim_ + "/witness.flood"}};
        for (int i = 0; i < 200; ++i)
            presence_.said.wants.push_back(
                {fmt::format("rogue/flood.port{}", 2 * (random_() % 1000) + 1), victim_ + "/mouse.target_velocity_in"});
        return write_announcement(presence_.said);
    }
    Octets value() {
        Octets bytes;
        ++number_;
        write_cdr(bytes, on_the_wire, MessageHead{.run = own_run, .number = number_, .stamp = now()},
                  static_cast<std::int32_t>(number_));
        return bytes;
    }
    Octets request() {
        return cdr(RemoteRequest{.from = own_run,
                                 .to = presence_.run_of(victim_),
                                 .number = ++asked_,
                                 .what = static_cast<std::uint8_t>(asked_ % 9),
                                 .component = "witness",
                                 .name = "nothing_that_is_there"});
    }

    std::string victim_;
    bool is_known_;
    Presence presence_;
    std::unique_ptr<Writer> announcer_, babbler_, values_, leaders_, requests_;
    std::minstd_rand random_{1};
    std::uint64_t round_ = 0, number_ = 0, asked_ = 0;
};

[[noreturn]] void flood(const Access& place, const std::string& victim) {
    Flood flood(place, victim);
    for (;;) {
        int sent = 0;
        for (const double end = now() + 1; now() < end;) sent += flood.send();
        std::printf("%d messages a second\n", sent);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int count, char** words) {
    const std::vector<std::string> given(words + 1, words + count);
    const bool is_version = given.size() == 5 && given[2] == "version";
    if (!is_version && (given.size() != 4 || given[2] != "flood"))
        fail("usage: rogue_host INTERFACE SECRET|- version VERSION same|other | flood VICTIM");
    const Access place(given[0], given[1]);
    if (is_version) be_of_another_version(place, given[3], given[4] == "same" ? protocol : protocol + 1);
    flood(place, given[3]);
}
