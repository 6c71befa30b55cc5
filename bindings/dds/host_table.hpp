// Which other hosts there are, from what they say of themselves.
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

/// [s] after which a host that was killed is no longer there; two that are there for longer under one name are two.
inline constexpr double patience = 6;

class HostTable {
public:
    /// `own`: this host's name and version; `own_run`: of what it announces itself. `answered`: who has not heard this
    /// run is not there, so that announcements that somebody has kept from earlier are none.
    HostTable(AnnouncementHead own, std::uint64_t own_run, bool answered = false)
        : own_(std::move(own)), own_run_(own_run), answered_(answered) {}

    /// What a writer has announced. `now` [s] by a clock that never falls. False: it is dropped, and what the writer
    /// said before counts.
    bool heard(std::uint64_t writer, std::span<const std::uint8_t> cdr, double now);
    /// The writers there are: what others said is forgotten.
    void keep(std::span<const std::uint64_t> writers, double now);

    /// nullptr when it is not there. Of two that call themselves so the one that came last counts: mostly the other one
    /// was killed and is not missed yet.
    const Announcement* find(std::string_view host) const;
    /// The port that is called so, "name.port"; nullptr: there is none. `host` as from here: its ports are sorted.
    static const AnnouncedPort* find_port(const Announcement& host, std::string_view name);
    /// Those that are there, by name.
    std::vector<const Announcement*> all() const;

    /// The runs of those that were heard, sorted: what this host answers.
    std::vector<std::uint64_t> heard_runs() const;

    struct News {
        LogLevel level;
        std::string text;
    };
    /// What a person should hear since the last call.
    std::vector<News> take_news() { return std::exchange(news_, {}); }

private:
    struct Said {
        AnnouncementHead head;
        Announcement announcement;  // empty when it can't be understood
        bool understood = false;
        bool counts = false;  // it is there: understood, and where that is asked for it has heard this run
        double since = 0;     // [s]
        bool told_twice = false;
    };
    void follow(const std::string& host, std::uint64_t run);
    void tell_of(const Said& said);
    void tell_namesakes(double now);

    AnnouncementHead own_;
    std::uint64_t own_run_;
    bool answered_;
    std::map<std::string, std::uint64_t, std::less<>> runs_;  // by name: the newest
    std::set<std::uint64_t> ended_;                           // runs that a newer one of their host has followed
    std::map<std::uint64_t, Said> said_;                      // by writer
    std::map<std::string, std::uint64_t, std::less<>> here_;  // by name: the writer that counts
    std::vector<News> news_;
};

/// The topic on which hosts announce themselves.
Topic announcement_topic();

/// An announcement as it travels.
std::vector<std::uint8_t> write_announcement(const Announcement& announcement);

}  // namespace nezumi::dds
