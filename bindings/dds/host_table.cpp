// Reads announcements. For an incompatible host only the part common to all versions is used.
#include "bindings/dds/host_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings/dds/announced_types.hpp"
#include "engine/base/list.hpp"
#include "engine/base/names.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::dds {
namespace {

// Limits on what hosts announce, because they are not trusted.
constexpr std::size_t most_hosts = 256;
constexpr std::size_t most_announcement_bytes = std::size_t{1} << 20, most_ports = 16'384, most_connections = 1024;
constexpr std::size_t most_ended = 4096;

constexpr auto by_name = [](const AnnouncedPort& a, const AnnouncedPort& b) { return a.name < b.name; };

// "vehicle.current_vel", or with the host of a connection "ev3/vehicle.current_vel".
bool is_path(std::string_view path, bool of_host) {
    if (path.size() > longest_name) return false;
    if (of_host) {
        const std::size_t slash = path.find('/');
        if (slash == path.npos || !is_identifier(path.substr(0, slash))) return false;
        path.remove_prefix(slash + 1);
    }
    const std::size_t dot = path.find('.');
    if (dot == path.npos || !is_identifier(path.substr(0, dot))) return false;
    const std::string_view port = path.substr(dot + 1);
    return is_identifier(port) || is_keyword(port);  // such as "in"
}

bool is_bounded(const AnnouncementHead& head) {
    return is_identifier(head.host) && head.host.size() <= longest_name && head.version.size() <= longest_name;
}

bool is_bounded(const Announcement& said) {
    const auto fits = [](const AnnouncedConnection& each) {
        return is_path(each.from, true) && is_path(each.to, true) && each.why.size() <= longest_reason;
    };
    std::size_t fields = 0;
    for (const AnnouncedType& type : said.types) fields += type.fields.size();
    const auto is_short = [](const AnnouncedField& field) {
        return field.path.size() <= longest_name && field.values.size() <= longest_name;
    };
    return said.ports.size() <= most_ports && said.types.size() <= most_types && fields <= most_fields &&
           std::all_of(said.types.begin(), said.types.end(),
                       [&](const AnnouncedType& type) {
                           return type.type.size() <= longest_name && type.name.size() <= longest_name &&
                                  std::all_of(type.fields.begin(), type.fields.end(), is_short);
                       }) &&
           said.heard.size() <= 4 * most_hosts && said.wants.size() <= most_connections &&
           said.refusals.size() <= most_connections && std::isfinite(said.lockstep) && said.lockstep >= 0 &&
           said.partners.size() <= most_hosts &&
           std::all_of(said.partners.begin(), said.partners.end(),
                       [](const std::string& name) { return is_identifier(name) && name.size() <= longest_name; }) &&
           std::all_of(said.ports.begin(), said.ports.end(),
                       [](const AnnouncedPort& port) {
                           return is_path(port.name, false) && is_identifier(port.type) &&
                                  port.type.size() <= longest_name;
                       }) &&
           std::all_of(said.wants.begin(), said.wants.end(), fits) &&
           std::all_of(said.refusals.begin(), said.refusals.end(), fits);
}

std::string shown_version(const AnnouncementHead& head) {
    return fmt::format("nezumi {}, protocol {}", shown(head.version), head.protocol);
}

}  // namespace

Topic announcement_topic() {
    // The depth allows one waiting announcement per host.
    return {.name = "nezumi/hosts",
            .type = "nezumi::Announcement",
            .reliable = true,
            .keeps_last = true,
            .depth = static_cast<int>(most_hosts)};
}

std::vector<std::uint8_t> write_announcement(const Announcement& announcement) {
    Octets bytes;
    write_cdr(bytes, on_the_wire, announcement);
    return bytes;
}

bool HostTable::heard(std::uint64_t writer, std::span<const std::uint8_t> cdr, double now) {
    // Reads only the head at first, because the rest may belong to another protocol version.
    AnnouncementHead head{};
    detail::CdrReader reader(cdr, on_the_wire);
    reader.read(head);
    if (!is_bounded(head)) return false;
    Announcement whole;
    const bool understood = cdr.size() <= most_announcement_bytes && head.protocol == protocol &&
                            read_cdr(cdr, on_the_wire, whole).has_value() && is_bounded(whole);
    if (understood && (whole.run == own_run_ || ended_.contains(whole.run)))
        return false;  // this host's own message, or an older one that was stored and replayed
    const auto before = said_.find(writer);
    const bool is_new = before == said_.end();
    if (is_new && said_.size() >= most_hosts) return false;
    // A writer belongs to one host and one run, and can't change that.
    if (!is_new && (before->second.head != head || before->second.understood != understood ||
                    before->second.announcement.run != whole.run))
        return false;
    // A message older than another one of the same run was stored and replayed.
    for (const auto& [other, said] : said_) {
        if (!understood || !said.understood || said.announcement.run != whole.run) continue;
        if (whole.number < said.announcement.number || (other == writer && whole.number == said.announcement.number))
            return false;
    }
    std::sort(whole.ports.begin(), whole.ports.end(), by_name);
    HeardHost& said = said_[writer];
    if (is_new) said.since = now;
    said.head = std::move(head);
    said.understood = understood;
    said.announcement = std::move(whole);
    const std::string& host = said.head.host;
    const std::vector<std::uint64_t>& heard = said.announcement.heard;
    said.counts = understood && (!answered_ || contains(heard, own_run_));
    const auto present = here_.find(host);
    if (understood && !said.counts) {
        if (present != here_.end() && present->second == writer) here_.erase(present);
        return true;
    }
    if (is_new || (said.counts && present == here_.end())) tell_of(said);
    if (host == own_.host || !said.counts) return true;
    follow(host, said.announcement.run);
    if (present == here_.end() || said_.at(present->second).since <= said.since) here_[host] = writer;
    return true;
}

// Notes that `run` is the present run of the host; the previous one is over.
void HostTable::follow(const std::string& host, std::uint64_t run) {
    ended_.erase(run);
    std::uint64_t& present = runs_[host];
    if (present != 0 && present != run) ended_.insert(present);
    present = run;
    // So many runs can't be real: a faulty or hostile host has invented them.
    if (ended_.size() > most_ended) ended_.clear();
    if (runs_.size() > most_ended) runs_.clear();
}

std::vector<std::uint64_t> HostTable::heard_runs() const {
    std::set<std::uint64_t> runs;
    for (const auto& [writer, said] : said_) {
        if (said.understood) runs.insert(said.announcement.run);
    }
    return {runs.begin(), runs.end()};
}

void HostTable::keep(std::span<const std::uint64_t> writers, double now) {
    std::erase_if(said_, [&](const auto& each) { return !contains(writers, each.first); });
    for (auto host = here_.begin(); host != here_.end();) {
        if (said_.contains(host->second)) {
            ++host;
            continue;
        }
        // There may be another host with the same name.
        const auto other = std::find_if(said_.begin(), said_.end(), [&](const auto& each) {
            return each.second.counts && each.second.head.host == host->first;
        });
        if (other != said_.end()) {
            host->second = other->first;
            follow(host->first, other->second.announcement.run);
            ++host;
        } else {
            news_.push_back({LogLevel::warn, fmt::format("host {} has left", host->first)});
            host = here_.erase(host);
        }
    }
    tell_namesakes(now);
}

void HostTable::tell_of(const HeardHost& said) {
    if (said.head.host == own_.host)
        return;  // reported only if it stays: usually it is this host's previous run, which was killed
    if (!said.understood) {
        news_.push_back({LogLevel::error, fmt::format("host {} is incompatible: it runs {}, this one {}",
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
             is_own ? fmt::format("another host is also called {}: neither reaches the other; give one of them "
                                  "another name: network {{ name = ... }}",
                                  own_.host)
                    : fmt::format("two hosts have the name {}: the last one is used; give one of them another name",
                                  said.head.host)});
    }
}

const AnnouncedPort* HostTable::find_port(const Announcement& host, std::string_view name) {
    const auto at =
        std::lower_bound(host.ports.begin(), host.ports.end(), name,
                         [](const AnnouncedPort& port, std::string_view wanted) { return port.name < wanted; });
    return at != host.ports.end() && at->name == name ? &*at : nullptr;
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
