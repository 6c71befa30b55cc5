// Reads announcements; a host that can't be understood is told by the part that never changes.
#include "bindings/dds/host_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/names.hpp"
#include "engine/ports/cdr.hpp"

namespace nezumi::dds {
namespace {

constexpr CdrFormat on_the_wire{.order = std::endian::little, .header = true};

std::string shown_version(const AnnouncementHead& head) {
    return fmt::format("nezumi {}, protocol {}", shown(head.version), head.protocol);
}

}  // namespace

Topic announcement_topic() {
    // A reader keeps what so many hosts said last.
    constexpr int most_hosts = 256;
    return {.name = "nezumi/hosts",
            .type = "nezumi::Announcement",
            .reliable = true,
            .keeps_last = true,
            .depth = most_hosts};
}

std::vector<std::uint8_t> write_announcement(const Announcement& announcement) {
    Octets bytes;
    write_cdr(bytes, on_the_wire, announcement);
    return bytes;
}

void HostTable::heard(std::uint64_t writer, std::span<const std::uint8_t> cdr, double now) {
    // Only the head: the rest may be of another protocol, and then nothing is known of it.
    AnnouncementHead head{};
    detail::CdrReader reader(cdr, on_the_wire);
    reader.read(head);
    if (!is_identifier(head.host)) return;
    Announcement whole;
    const bool understood = head.protocol == protocol && read_cdr(cdr, on_the_wire, whole).has_value();
    if (understood && (whole.run == own_run_ || ended_.contains(whole.run))) return;  // its own; or kept from earlier
    const bool is_new = !said_.contains(writer);
    Said& said = said_[writer];
    if (understood && said.understood && said.announcement.run == whole.run && whole.number <= said.announcement.number)
        return;
    if (is_new) said.since = now;
    const bool told = !is_new && said.head == head;
    said.head = std::move(head);
    said.understood = understood;
    said.announcement = std::move(whole);
    const std::string& host = said.head.host;
    if (host != own_.host && understood) {
        std::uint64_t& run = runs_[host];
        if (run != 0 && run != said.announcement.run) ended_.insert(run);
        run = said.announcement.run;
    }
    const std::vector<std::uint64_t>& heard = said.announcement.heard;
    const bool counts = understood && (!answered_ || std::find(heard.begin(), heard.end(), own_run_) != heard.end());
    if (understood && !counts) {
        here_.erase(host);
        return;
    }
    if (!told || (counts && !here_.contains(host))) tell_of(said);
    if (host == own_.host || !counts) return;
    const auto before = here_.find(host);
    if (before == here_.end() || said_.at(before->second).since <= said.since) here_[host] = writer;
}

std::vector<std::uint64_t> HostTable::heard_runs() const {
    std::set<std::uint64_t> runs;
    for (const auto& [writer, said] : said_) {
        if (said.understood) runs.insert(said.announcement.run);
    }
    return {runs.begin(), runs.end()};
}

void HostTable::keep(std::span<const std::uint64_t> writers, double now) {
    std::erase_if(said_, [&](const auto& each) {
        return std::find(writers.begin(), writers.end(), each.first) == writers.end();
    });
    for (auto host = here_.begin(); host != here_.end();) {
        if (said_.contains(host->second)) {
            ++host;
            continue;
        }
        // Another of its name may be there still.
        const auto other = std::find_if(said_.begin(), said_.end(), [&](const auto& each) {
            return each.second.understood && each.second.head.host == host->first;
        });
        if (other != said_.end()) {
            host->second = other->first;
            ++host;
        } else {
            news_.push_back({LogLevel::warn, fmt::format("host {} has gone", host->first)});
            host = here_.erase(host);
        }
    }
    tell_namesakes(now);
}

void HostTable::tell_of(const Said& said) {
    if (said.head.host == own_.host) return;  // told when it stays: mostly it is this host before it was killed
    if (!said.understood) {
        news_.push_back({LogLevel::error, fmt::format("host {} can't be understood: it runs {}, this one {}",
                                                      said.head.host, shown_version(said.head), shown_version(own_))});
    } else if (said.head.version != own_.version) {
        news_.push_back({LogLevel::warn, fmt::format("host {} is here; it runs {}, this one {}", said.head.host,
                                                     shown_version(said.head), shown_version(own_))});
    } else {
        news_.push_back({LogLevel::info, fmt::format("host {} is here", said.head.host)});
    }
}

void HostTable::tell_namesakes(double now) {
    for (auto& [writer, said] : said_) {
        if (said.told_twice || now - said.since < patience) continue;
        const bool is_own = said.head.host == own_.host;
        const auto of_its_name =
            std::count_if(said_.begin(), said_.end(), [&, host = said.head.host](const auto& each) {
                return each.second.head.host == host && now - each.second.since >= patience;
            });
        if (!is_own && of_its_name < 2) continue;
        said.told_twice = true;
        news_.push_back(
            {LogLevel::error,
             is_own
                 ? fmt::format("another host is called {} as this one: neither reaches the other; give one of them "
                               "another name: network {{ name = ... }}",
                               own_.host)
                 : fmt::format("two hosts are called {}: the one that came last counts; give one of them another name",
                               said.head.host)});
    }
}

const Announcement* HostTable::find(std::string_view host) const {
    const auto found = here_.find(host);
    return found != here_.end() ? &said_.at(found->second).announcement : nullptr;
}

std::vector<const Announcement*> HostTable::all() const {
    std::vector<const Announcement*> hosts;
    for (const auto& [name, writer] : here_) hosts.push_back(&said_.at(writer).announcement);
    return hosts;
}

}  // namespace nezumi::dds
