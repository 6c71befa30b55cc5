// Every line is checked before anything runs, except the fields of acts, which need the project's files.
#include "bindings/journal/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bindings/journal/act_json.hpp"
#include "bindings/journal/files_json.hpp"
#include "bindings/journal/value_json.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/live/prepare.hpp"

namespace nezumi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::optional<std::uint64_t> hash_of(const Json& json) {
    if (!json.is_string()) return std::nullopt;
    const auto& text = json.get_ref<const std::string&>();
    return text.size() == 16 ? number_in<std::uint64_t>(text, 16) : std::nullopt;
}

std::optional<ActTime> time_of(const Json& json) {
    const auto found = json.find("at");
    if (found == json.end() || !found->is_array() || found->size() != 3) return std::nullopt;
    for (const Json& number : *found) {
        if (!number.is_number_unsigned()) return std::nullopt;
    }
    return ActTime{(*found)[0].get<int>(), (*found)[1].get<std::int64_t>(), (*found)[2].get<std::int64_t>()};
}

std::optional<FilesSeen> files_of(const Json& json) {
    const auto found = json.find("files");
    return found == json.end() ? FilesSeen() : files_from_json(*found);
}

template <class T>
std::optional<T> field(const Json& json, const char* name) {
    const auto found = json.find(name);
    if (found == json.end()) return std::nullopt;
    if constexpr (std::is_same_v<T, std::string>) {
        auto text = text_from_json(*found);
        return text ? std::optional(std::move(*text)) : std::nullopt;
    } else if constexpr (std::is_same_v<T, bool>) {
        if (!found->is_boolean()) return std::nullopt;
    } else if (!found->is_number_integer()) {
        return std::nullopt;
    }
    return found->get<T>();
}

std::string text_of(const ActTime& when) { return fmt::format("tick {} of start {}", when.tick, when.start); }

}  // namespace

struct Replay::Entry {
    enum class Kind { act, hash, end };
    Kind kind = Kind::act;
    int line = 0;
    ActTime when;
    Actor who;
    std::string name;
    Json fields;
    bool failed = false;
    FilesSeen files;
    std::uint64_t hash = 0;
};

Replay::Replay(fs::path file) : file_(std::move(file)) {}
Replay::~Replay() = default;

Unexpected Replay::wrong(int line, const std::string& what) const {
    return failure(what + written_by(), {.file = file_.string(), .line = line});
}

Expected<std::unique_ptr<Replay>> Replay::read(const fs::path& file, const std::string& version) {
    const auto text = read_whole(file, file.string(), largest);
    if (!text) return Unexpected(text.error());
    return of_text(*text, file, version);
}

Expected<std::unique_ptr<Replay>> Replay::of_text(std::string_view text, const fs::path& file,
                                                  const std::string& version) {
    return parse(text, file, version, false);
}

Expected<std::unique_ptr<Replay>> Replay::of_record(std::string_view text, const fs::path& file,
                                                    const std::string& version) {
    return parse(text, file, version, true);
}

Expected<std::unique_ptr<Replay>> Replay::parse(std::string_view text, const fs::path& file, const std::string& version,
                                                bool takes_hardware) {
    std::unique_ptr<Replay> replay(new Replay(file));
    if (text.empty()) return failure("is empty: it contains no run", {file.string()});
    int number = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find('\n', at);
        ++number;
        if (end == std::string::npos) {
            replay->torn_ = number;
            break;
        }
        const std::string line(text.substr(at, end - at));
        auto ok = number == 1 ? replay->read_header(line, version, takes_hardware) : replay->read_entry(line, number);
        if (!ok) return Unexpected(ok.error());
        at = end + 1;
    }
    if (!replay->files_) return replay->wrong(1, "is not a journal: its first line is incomplete");
    return replay;
}

Expected<void> Replay::read_header(const std::string& line, const std::string& version, bool takes_hardware) {
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object() || !json.contains("journal")) return wrong(1, "is not a journal of nezumi run --journal");
    const std::string written_by = shown(field<std::string>(json, "version").value_or("of an unknown version"));
    const auto format = field<int>(json, "journal");
    if (format != journal_format) {
        return failure(
            fmt::format("{} is a journal of nezumi {} in the format {}: this is nezumi {}, which reads only format {}",
                        file_.string(), written_by, format ? std::to_string(*format) : "?", version, journal_format));
    }
    if (written_by != version) {
        other_version_ = written_by;
        version_ = version;
    }
    is_of_hardware_ = field<bool>(json, "hardware").value_or(false);
    if (is_of_hardware_ && !takes_hardware) {
        return failure(fmt::format("{} is the journal of a run on hardware: it is only a record, and can't be replayed",
                                   file_.string()));
    }
    const auto system = field<std::string>(json, "system");
    const auto working = field<std::string>(json, "working_folder");
    const auto seed = field<std::uint64_t>(json, "seed");
    const auto seed_wins = field<bool>(json, "seed_wins");
    const auto files = files_of(json);
    const auto installed = json.find("installed");
    if (!system || !working || !seed || !seed_wins || !files || installed == json.end() || !installed->is_array())
        return wrong(1, "expected system, working_folder, installed, seed, seed_wins and files");
    for (const Json& folder : *installed) {
        auto path = text_from_json(folder);
        if (!path) return wrong(1, "'installed' must be a list of folders");
        installed_.emplace_back(std::move(*path));
    }
    // Without these fields, no values were given.
    values_.file = field<std::string>(json, "params").value_or("");
    if (const auto set = json.find("set"); set != json.end()) {
        if (!set->is_array()) return wrong(1, "'set' must be a list of strings");
        for (const Json& each : *set) {
            auto text = text_from_json(each);
            if (!text) return wrong(1, "'set' must be a list of strings");
            values_.set.emplace_back(std::move(*text));
        }
    }
    system_ = *system;
    seed_ = *seed;
    seed_wins_ = *seed_wins;
    files_.emplace(*working);
    files_->update(*files);
    return {};
}

Expected<void> Replay::read_entry(const std::string& line, int number) {
    const Json json = Json::parse(line, nullptr, false);
    if (!json.is_object()) return wrong(number, "expected a JSON object");
    if (end_) return wrong(number, "this line is after the end: 'end' must be the last line");
    const auto when = time_of(json);
    if (!when) return wrong(number, "'at' must be the start's number, the tick and the act's number");
    Entry entry{.line = number, .when = *when};
    if (const auto call = json.find("out_of_time"); call != json.end()) return read_out_of_time(*call, *when, number);
    if (!entries_.empty() && entries_.back().name != Describe<Seek>::name) {
        const ActTime& before = entries_.back().when;
        if (std::pair(when->start, when->tick) < std::pair(before.start, before.tick))
            return wrong(number,
                         fmt::format("'at' must not go back, but {} comes after {}", text_of(*when), text_of(before)));
    }
    if (json.contains("do")) {
        const auto name = field<std::string>(json, "do");
        auto who = actor_from(field<std::string>(json, "who").value_or(""));
        auto files = files_of(json);
        if (!name || !files || !json.contains("with")) return wrong(number, "an act must have do and with");
        if (!who) return wrong(number, who.error().message);
        entry.name = *name;
        entry.who = std::move(*who);
        entry.fields = json["with"];
        entry.failed = field<bool>(json, "failed").value_or(false);
        entry.files = std::move(*files);
    } else {
        const auto hash = json.contains("hash") ? hash_of(json["hash"]) : std::nullopt;
        if (!hash) return wrong(number, "expected one of the fields do, out_of_time, or hash (16 hexadecimal digits)");
        entry.hash = *hash;
        entry.kind = json.contains("end") ? Entry::Kind::end : Entry::Kind::hash;
        if (entry.kind == Entry::Kind::end) {
            const auto how = field<std::string>(json, "end");
            if (how != "duration" && how != "stopped" && how != "error")
                return wrong(number, "'end' must be duration, stopped or error");
            end_ = how == "duration" ? RunEnd::duration : how == "stopped" ? RunEnd::stopped : RunEnd::error;
            end_message_ = json.contains("message") ? text_from_json(json["message"]).value_or("") : "";
            hash_ = *hash;
        }
    }
    entries_.push_back(std::move(entry));
    return {};
}

Expected<void> Replay::read_out_of_time(const Json& json, const ActTime& when, int number) {
    const auto component = field<std::string>(json, "component");
    const auto count = field<std::int64_t>(json, "call");
    const auto message = json.contains("message") ? text_from_json(json["message"]) : Expected<std::string>("");
    const auto lost = json.contains("lost") ? text_from_json(json["lost"]) : Expected<std::string>("");
    if (!component || !count || !message || !lost)
        return wrong(number, "'out_of_time' must have component, call and message");
    Error error{*message, {field<std::string>(json, "file").value_or(""), field<int>(json, "line").value_or(0)}};
    error.kind = Error::Kind::out_of_time;
    ended_.push_back({when, *component, *lost});
    Component::LeftState left{.lost = *lost};
    if (json.contains("state")) {
        if (const std::string why = read_plain(json["state"], left.data.emplace()); !why.empty())
            return wrong(number, "state: " + why);
    }
    foreseen_.push_back({when.start, when.tick, *component, {*count, std::move(error), std::move(left)}});
    return {};
}

Expected<void> Replay::check_system(const fs::path& file) const {
    if (file.filename() == fs::path(system_).filename()) return {};
    return failure(fmt::format("{} is a journal of {}, not of {}", file_.string(), system_, file.string()));
}

LiveOptions Replay::with_its_files(LiveOptions options) {
    options.files = &*files_;
    options.installed = installed_;
    options.build.seed = seed_;
    options.build.seed_wins = seed_wins_;
    options.values = values_;
    options.build.out_of_time_is_fatal = false;
    options.watch = false;
    options.is_replay = true;
    options.budget = headless_budget;
    return options;
}

Expected<SystemSpec> Replay::spec(const LiveOptions& given) {
    const LiveOptions options = with_its_files(given);
    return read_spec(system_, Project::of(system_, installed_, *options.files), options);
}

Expected<std::vector<std::pair<std::int64_t, Act>>> Replay::acts_on(const std::string& component) const {
    std::vector<std::pair<std::int64_t, Act>> acts;
    for (const Entry& entry : entries_) {
        if (entry.when.start != 1 || entry.name == Describe<Seek>::name || entry.name == Describe<Restart>::name) break;
        if (entry.kind != Entry::Kind::act || entry.failed) continue;
        const Json its = entry.fields.is_object() ? entry.fields.value("component", Json()) : Json();
        if (its != component) continue;
        const auto act = act_from_json(entry.name, entry.fields, PartReader());
        if (!act) return wrong(entry.line, act.error().message);
        if (is_about(*act, component)) acts.emplace_back(entry.when.tick, *act);
    }
    return acts;
}

Expected<std::unique_ptr<RunningSystem>> Replay::load(LiveOptions options) {
    auto live = RunningSystem::load(system_, with_its_files(std::move(options)));
    if (live) (*live)->foresee(std::exchange(foreseen_, {}));
    return live;
}

std::optional<std::int64_t> Replay::end_tick() const {
    return end_ ? std::optional(entries_.back().when.tick) : std::nullopt;
}

bool Replay::is_over() const { return next_ == entries_.size(); }

std::int64_t Replay::ticks() const {
    std::int64_t all = 0;
    ActTime last{};
    for (const Entry& entry : entries_) {
        // A restart begins at tick 0; a seek continues at an earlier tick.
        if (entry.when.start != last.start) last.tick = 0;
        all += std::max<std::int64_t>(0, entry.when.tick - last.tick);
        last = entry.when;
    }
    return all;
}

Expected<bool> Replay::before_tick(RunningSystem& live) {
    for (; next_ < entries_.size(); ++next_) {
        const Entry& entry = entries_[next_];
        const ActTime now = live.when();
        const auto here = std::pair(now.start, now.tick);
        const auto due = std::pair(entry.when.start, entry.when.tick);
        if (entry.when.start == now.start && due > here) return true;
        if (due != here) {
            return wrong(entry.line, fmt::format("this entry is for {}, which the run never reaches: it is at {}",
                                                 text_of(entry.when), text_of(now)));
        }
        if (entry.kind == Entry::Kind::act) {
            if (auto done = perform(live, entry); !done) return Unexpected(done.error());
        } else if (entry.kind == Entry::Kind::hash && live.trace_hash() != entry.hash) {
            return wrong(entry.line,
                         fmt::format("this run differs from the journal's run: its hash at {} was {}, not {}{}",
                                     text_of(now), hash_text(entry.hash), hash_text(live.trace_hash()), cause(now)));
        }
    }
    return false;
}

std::string Replay::written_by() const {
    if (other_version_.empty()) return "";
    return fmt::format("; the journal is of nezumi {}, this is {}", other_version_, version_);
}

std::string Replay::cause(const ActTime& now) const {
    const auto is_before = [&](const Ended& each) {
        return std::pair(each.when.start, each.when.tick) <= std::pair(now.start, now.tick);
    };
    const auto last = std::find_if(ended_.rbegin(), ended_.rend(), is_before);
    if (last == ended_.rend()) return "";
    return fmt::format(
        "; in the run, a call of {} ran out of time at {}, and the journal does not have the locals that it left{}",
        last->component, text_of(last->when), last->lost.empty() ? "" : ", nor all of its state: " + last->lost);
}

Expected<void> Replay::perform(RunningSystem& live, const Entry& entry) {
    if (entry.name == Describe<Restart>::name) files_->clear();
    files_->update(entry.files);
    const auto act = act_from_json(entry.name, entry.fields, live.part_reader());
    if (!act) return wrong(entry.line, act.error().message);
    const auto done = live.act_again(*act, entry.who);
    if (done.has_value() != entry.failed) return {};
    return wrong(entry.line, entry.failed ? fmt::format("{} failed in the original run, but not now{}", entry.name,
                                                        cause(entry.when))
                                          : fmt::format("{} succeeded in the original run, but fails now: {}{}",
                                                        entry.name, describe(done.error()), cause(entry.when)));
}

}  // namespace nezumi
