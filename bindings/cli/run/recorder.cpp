// Rows are written as they come. When a sequence grows, the later rows have more cells, and `finish` adds the missing
// cells to the earlier rows.
#include "bindings/cli/run/recorder.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <thread>
#include <utility>

#include "engine/base/csv.hpp"
#include "engine/base/staged_file.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

constexpr std::size_t flush_at = 16384;  // bytes
// A crash loses at most 0.1 s of the recording: this time, a tick, and the time to write.
constexpr std::chrono::milliseconds longest_unwritten{50};
// How long `end_here` waits for a tick that is adding its rows, and then for a slow disk.
constexpr std::chrono::milliseconds longest_wait{400};
constexpr std::chrono::milliseconds longest_end{200};

// Follows all channels that match a pattern. The part after the dot names any member of a component ("mouse_*.truth"),
// or, if it has * or ?, only out-ports ("mouse.*").
std::vector<const Channel*> follow_fitting(Trace& trace, const System& system, const std::string& pattern) {
    const std::size_t dot = std::min(pattern.find('.'), pattern.size());
    const std::string name = pattern.substr(0, dot), what = pattern.substr(std::min(dot + 1, pattern.size()));
    const bool is_name = what.find_first_of("*?") == what.npos;
    const auto fits = [](const std::string& its, const std::string& given) {
        return fnmatch(given.c_str(), its.c_str(), FNM_NOESCAPE) == 0;
    };
    std::vector<const Channel*> found;
    const auto follow = [&](const std::string& path) {
        if (const auto channel = trace.follow(path)) found.push_back(*channel);
    };
    for (const auto& component : system.components()) {
        if (!fits(component->name(), name)) continue;
        if (is_name && !what.empty()) follow(component->name() + "." + what);
        for (const auto& port : component->out_ports()) {
            if (!is_name && fits(port->name(), what)) follow(component->name() + "." + port->name());
        }
    }
    return found;
}

}  // namespace

Expected<std::vector<const Channel*>> follow_channels(Trace& trace, const System& system,
                                                      const std::vector<std::string>& names) {
    std::vector<const Channel*> channels;
    for (const std::string& name : names) {
        if (name.find_first_of("*?") != name.npos) {
            const auto fitting = follow_fitting(trace, system, name);
            if (fitting.empty()) return failure(fmt::format("--ports: no port or value matches '{}'", shown(name)));
            channels.insert(channels.end(), fitting.begin(), fitting.end());
            continue;
        }
        const auto channel = trace.follow(name);
        if (!channel) return failure("--ports: " + channel.error().message);
        channels.push_back(*channel);
    }
    return channels;
}

Expected<Recorder> Recorder::open(const std::string& file, Trace& trace, const System& system,
                                  const std::vector<std::string>& names, std::int64_t every) {
    Recorder recorder(trace);
    recorder.every_ = every;
    if (names.empty()) recorder.follow_ports(system);
    const auto channels = follow_channels(trace, system, names);
    if (!channels) return Unexpected(channels.error());
    for (const Channel* each : *channels) recorder.table_.follow(*each);
    auto opened = ResultFile::open(file);
    if (!opened) return Unexpected(opened.error());
    recorder.name_ = file;
    recorder.file_ = std::move(*opened);
    recorder.writer_ = std::make_unique<FileWriter>(recorder.file_.descriptor());
    return recorder;
}

// Empties the cells of values that seldom change (the position and the limits of a ranger), unless they have changed.
void Recorder::empty_what_stays(std::vector<std::string>& cells) {
    const std::vector<std::string>& names = table_.names();
    for (std::size_t id = kept_.size(); id < names.size(); ++id) {
        const std::string& name = names[id];
        // True for "mouse.scan.config.maxRange", but not for a parameter such as "mouse.config.range".
        const auto port = name.find('.', name.find('.') + 1);
        const bool seldom_changes =
            port != name.npos && (name.compare(port, 10, ".geometry.") == 0 || name.compare(port, 8, ".config.") == 0);
        kept_.push_back(seldom_changes ? std::optional(std::string()) : std::nullopt);
    }
    for (std::size_t id = 0; id < cells.size(); ++id) {
        if (!kept_[id]) continue;
        if (*kept_[id] == cells[id]) {
            cells[id].clear();
        } else {
            kept_[id] = cells[id];
        }
    }
}

// Follows new out-ports; the others keep their columns.
void Recorder::follow_ports(const System& system) {
    followed_layout_ = system.layout();
    for (const auto& component : system.components()) {
        for (const auto& port : component->out_ports()) {
            std::string name = component->name() + "." + port->name();
            if (followed_.contains(name)) continue;
            if (const auto channel = trace_->follow(name)) table_.follow(**channel);
            followed_.insert(std::move(name));
        }
    }
}

void Recorder::begin_layout() {
    layouts_.push_back({rows_, table_.order(), table_.header()});
    width_ = table_.width();
    if (layouts_.size() > 1) return;
    buffer_ += layouts_.back().header + "\n";
    // An output that can't be read again, such as a pipe, keeps its first columns.
    if (file_.path().empty()) table_.fix_columns();
}

void Recorder::add_rows(const System& system) {
    const std::lock_guard lock(*mutex_);
    if (sealed_ || error_) return;
    if (followed_layout_ && *followed_layout_ != system.layout()) follow_ports(system);
    const std::string time = fmt::format("{}", system.last_tick().seconds);
    const auto add = [&](std::vector<std::string> cells) {
        if (layouts_.empty() || table_.width() > width_) begin_layout();
        empty_what_stays(cells);
        buffer_ += TraceTable::row(time, layouts_.back().ids, cells) + "\n";
        ++rows_;
    };
    if (every_ == 1) {
        table_.read(add);
    } else if (system.last_tick().tick % every_ == 0) {
        table_.read_latest(add);
    }
    if (buffer_.size() >= flush_at || Clock::now() - flushed_ > longest_unwritten) flush();
}

void Recorder::fail(const std::string& why) { error_ = Error{"can't be written: " + why, {name_}}; }

void Recorder::flush() {
    flushed_ = Clock::now();
    writer_->put(std::exchange(buffer_, {}));
    if (const int problem = writer_->problem(); problem != 0 && !error_) fail(why_not_written(problem));
}

void Recorder::align_rows() {
    StagedFile aligned(file_.path());
    std::ifstream in(file_.path(), std::ios::binary);
    std::string row;
    std::string text = layouts_.back().header + "\n";
    int problem = aligned.problem();
    const auto write = [&] {
        if (problem == 0) problem = write_all(aligned.descriptor(), std::exchange(text, {}));
        if (problem == 0 && writer_->is_given_up()) problem = ECANCELED;
    };
    read_csv_row(in, row);  // skips the old header
    std::size_t layout = 0;
    std::vector<std::string> by_id;
    for (std::uint64_t number = 0; problem == 0 && read_csv_row(in, row); ++number) {
        if (layout + 1 < layouts_.size() && layouts_[layout + 1].row == number) ++layout;
        const auto cells = split_csv_row(row).value_or(std::vector<std::string_view>{""});
        by_id.assign(table_.width(), {});
        const auto& ids = layouts_[layout].ids;
        for (std::size_t i = 0; i < ids.size() && i + 1 < cells.size(); ++i) by_id[ids[i]] = cells[i + 1];
        text += TraceTable::row(cells.front(), layouts_.back().ids, by_id) + "\n";
        if (text.size() >= flush_at) write();
    }
    write();
    if (problem == 0) problem = aligned.commit();
    if (problem != 0) fail(why_not_written(problem));
}

void Recorder::complete(std::chrono::milliseconds patience) {
    sealed_ = complete_ = true;
    if (layouts_.empty()) begin_layout();  // no tick has passed: the header alone
    flush();
    if (const int problem = writer_->close(patience); problem != 0 && !error_) fail(why_not_written(problem));
    if (!error_ && layouts_.size() > 1) align_rows();
    aligned_ = !error_;
}

void Recorder::end_with_note(std::string_view why) {
    std::string note;
    for (std::size_t i = 1; i < layouts_.size() && !aligned_; ++i)
        note += fmt::format("# from row {} on the columns are {}\n", layouts_[i].row + 1, layouts_[i].header);
    note += fmt::format("# the recording ends here: {}\n", why);
    file_.cut_to_rows(aligned_ && layouts_.size() > 1 ? 0 : writer_->last_whole_piece(), note);
}

Expected<void> Recorder::finish() {
    const std::lock_guard lock(*mutex_);
    if (complete_) return {};
    complete(FileWriter::forever);
    if (!error_) {
        file_.replace_older();
        return {};
    }
    if (!file_.path().empty()) {
        end_with_note(error_->message);
        error_->message += ": complete rows are kept" + file_.told_of_older();
    }
    return Unexpected(*error_);
}

void Recorder::end_here(std::string_view why) {
    Lock lock(*mutex_, std::try_to_lock);
    for (const auto until = Clock::now() + longest_wait; !lock && Clock::now() < until;) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        static_cast<void>(lock.try_lock());
    }
    if (!lock || complete_) return;
    complete(longest_end);
    end_with_note(error_ ? error_->message : why);
}

}  // namespace nezumi::cli
