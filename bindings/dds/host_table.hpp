// The table of other hosts, from their announcements.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/dds/transport.hpp"
#include "bindings/dds/wire.hpp"
#include "engine/base/log.hpp"

namespace nezumi::dds {

/// [s] after which a killed host counts as gone. Two hosts with one name for a longer time are a conflict.
inline constexpr double patience = 6;

class HostTable {
public:
    /// `own`: this host's name and version. `own_run`: the run in its announcements. `answered`: a host counts only if
    /// it has seen this run, so that stored and replayed announcements have no effect.
    HostTable(AnnouncementHead own, std::uint64_t own_run, bool answered = false)
        : own_(std::move(own)), own_run_(own_run), answered_(answered) {}

    /// Takes an announcement of a writer. `now` [s] by a monotonic clock. Returns false if the announcement is
    /// rejected; then the writer's earlier one stays valid.
    bool heard(std::uint64_t writer, std::span<const std::uint8_t> cdr, double now);
    /// Keeps only these writers; the announcements of others are removed.
    void keep(std::span<const std::uint64_t> writers, double now);

    /// Returns nullptr if the host is missing. If two hosts have this name, returns the newer one: usually the older
    /// one was killed, and this is not yet noticed.
    const Announcement* find(std::string_view host) const;
    /// The port named "name.port", or nullptr. `host` as returned by this class: its ports are sorted.
    static const AnnouncedPort* find_port(const Announcement& host, std::string_view name);
    /// The present hosts, by name.
    std::vector<const Announcement*> all() const;

    /// The runs of the hosts whose announcements were received, sorted: part of this host's announcement.
    std::vector<std::uint64_t> heard_runs() const;

    struct News {
        LogLevel level;
        std::string text;
    };
    /// Returns the log messages since the last call.
    std::vector<News> take_news() { return std::exchange(news_, {}); }

private:
    struct HeardHost {
        AnnouncementHead head;
        Announcement announcement;  // empty if incompatible
        bool understood = false;
        bool counts = false;  // compatible, and has seen this run if that is required
        double since = 0;     // [s]
        bool told_twice = false;
    };
    void follow(const std::string& host, std::uint64_t run);
    void tell_of(const HeardHost& said);
    void tell_namesakes(double now);

    AnnouncementHead own_;
    std::uint64_t own_run_;
    bool answered_;
    std::map<std::string, std::uint64_t, std::less<>> runs_;  // by name: the newest run
    std::set<std::uint64_t> ended_;                           // runs that were followed by a newer one of their host
    std::map<std::uint64_t, HeardHost> said_;                 // by writer
    std::map<std::string, std::uint64_t, std::less<>> here_;  // by name: the writer that counts
    std::vector<News> news_;
};

/// The topic on which hosts announce themselves.
Topic announcement_topic();

/// The encoded form of an announcement.
std::vector<std::uint8_t> write_announcement(const Announcement& announcement);

}  // namespace nezumi::dds
