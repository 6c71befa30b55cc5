// A journal is written while the loop runs; a replay performs its acts before each tick.
#include "bindings/cli/run/journal.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <utility>

#include "bindings/cli/base/version.hpp"
#include "bindings/cli/files/run_file.hpp"
#include "bindings/record/mcap_reader.hpp"
#include "bindings/scenario/margins.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {

Expected<std::unique_ptr<RunningSystem>> RunJournal::load(const RunOptions& options, LiveOptions live,
                                                          JournalSink recording) {
    if (!options.replay.empty()) {
        file_ = options.replay;
        if (options.opens_replay) {
            if (auto told = find_failure(); !told) return Unexpected(told.error());
            auto other = open_recorded(live);
            if (!other) return Unexpected(other.error());
            if (*other != nullptr) return other;
        }
        auto text = read_run(file_);
        if (!text) return Unexpected(text.error());
        auto replay = Replay::of_text(*text, file_, version());
        if (!replay) return Unexpected(replay.error());
        replay_ = std::move(*replay);
        if (!replay_->other_version().empty()) {
            notes_.push_back(fmt::format(
                "{}: the run of nezumi {} is repeated by nezumi {}, until a difference between both versions stops it",
                file_, replay_->other_version(), version()));
        }
        // A recording of the replay gets the same journal.
        if (recording) recording(text->size(), [text = std::move(*text)] { return text; });
        if (!options.file.empty()) {
            if (auto ok = replay_->check_system(options.file); !ok) return Unexpected(ok.error());
        }
        if (replay_->torn_line() > 0)
            notes_.push_back(
                fmt::format("{}:{}: the last line is incomplete and is ignored", file_, replay_->torn_line()));
        if (!replay_->end())
            notes_.push_back(fmt::format(
                "{}: has no end: the original run was interrupted, so this one stops at the same tick", file_));
        if (options.opens_replay && replay_->end() == RunEnd::error)
            notes_.push_back(fmt::format("{}: an error ended that run: {}", file_, replay_->end_message()));
        auto loaded = replay_->load(std::move(live));
        if (!loaded) return loaded;
        live_ = loaded->get();
        if (!options.only_repeats.empty()) live_->refuse_acts(options.only_repeats);
        return loaded;
    }
    if (options.journal.empty() && !recording) return RunningSystem::load(options.file, std::move(live));
    std::unique_ptr<Journal> journal;
    if (options.journal.empty()) {
        journal = Journal::of_sink(std::move(recording));
    } else {
        auto created = Journal::create(options.journal);
        if (!created) return Unexpected(created.error());
        journal = std::move(*created);
        if (recording) journal->add_sink(std::move(recording));
    }
    auto loaded = RunningSystem::load(options.file, std::move(live));
    if (!loaded) return loaded;
    journal_ = std::move(journal);
    live_ = loaded->get();
    journal_->begin(*live_, version(), options.hardware.has_value());
    return loaded;
}

// If `file_` is the folder of a failed scenario, finds the journal or the recording of the failed run.
Expected<void> RunJournal::find_failure() {
    namespace fs = std::filesystem;
    std::error_code none;
    if (!fs::is_directory(file_, none)) return {};
    const fs::path folder = file_;
    file_ = (folder / failure_journal).string();
    if (fs::is_regular_file(folder / failed_recording, none)) {
        if (auto found = find_failed_recording(folder / failed_recording); !found) return found;
    } else if (!fs::is_regular_file(file_, none)) {
        if (fs::exists(folder / "failure.txt", none))
            return failure("this scenario failed without a run that can be repeated: read failure.txt in this folder",
                           {folder.string()});
        return failure(fmt::format("has no {}: open the folder of a scenario that failed, which the report of nezumi "
                                   "test names",
                                   failure_journal),
                       {folder.string()});
    }
    if (auto text = read_whole(folder / "failure.txt", "failure.txt", std::size_t{1} << 20)) {
        while (text->ends_with('\n')) text->pop_back();
        const std::string heading = fmt::format("\n{}\n", conditions_heading);
        if (const auto found = text->find(heading); found != std::string::npos) {
            std::istringstream lines(text->substr(found + heading.size()));
            for (std::string line; std::getline(lines, line);)
                conditions_.push_back(line.substr(line.find_first_not_of(' ')));
        }
        notes_.push_back(std::move(*text));
    }
    return {};
}

Expected<void> RunJournal::find_failed_recording(const std::filesystem::path& note) {
    const auto text = read_whole(note, note.string(), std::size_t{1} << 16);
    if (!text) return Unexpected(text.error());
    std::istringstream lines(*text);
    Seek where;
    if (!std::getline(lines, file_) || !(lines >> where.start >> where.tick))
        return failure("expected the path of a recording, and below it the start and the tick of the failure",
                       {note.string()});
    failed_at_ = where;
    return {};
}

// Opens a recording that can't be repeated as a run: its messages are played. Null for other files.
Expected<std::unique_ptr<RunningSystem>> RunJournal::open_recorded(const LiveOptions& live) {
    const auto bytes = read_whole(file_, file_, Replay::largest);
    if (!bytes) return Unexpected(bytes.error());
    if (!record::is_mcap(*bytes)) return std::unique_ptr<RunningSystem>();
    auto recorded = RecordedSystem::open(file_, {}, live);
    if (!recorded) return Unexpected(recorded.error());
    if ((*recorded)->replay() != nullptr) return std::unique_ptr<RunningSystem>();
    recorded_ = std::move(*recorded);
    notes_.insert(notes_.end(), recorded_->notes().begin(), recorded_->notes().end());
    auto loaded = recorded_->take();
    live_ = loaded.get();
    return loaded;
}

Expected<void> RunJournal::go_to_end(const volatile std::sig_atomic_t& end) {
    for (;;) {
        const auto more = recorded_ ? recorded_->before_tick(*live_) : replay_->before_tick(*live_);
        if (!more) return Unexpected(more.error());
        if (!*more || end != 0) break;
        live_->tick();
    }
    opened_ = std::move(replay_);
    if (!failed_at_ || end != 0) return {};
    return live_->act(*failed_at_, {}).map([](const ActResult&) {});
}

void RunJournal::follow(RunLoop& loop) {
    loop_ = &loop;
    if (journal_) loop.add(*this);
    if (replay_) loop.before_tick([this] { before_tick(); });
}

bool RunJournal::serve(Pacer::Clock::time_point /*until*/) {
    journal_->serve();
    if (journal_->error() && !error_) {
        error_ = journal_->error();
        loop_->quit();
    }
    return false;
}

void RunJournal::before_tick() {
    const auto more = replay_->before_tick(*live_);
    if (!more) error_ = more.error();
    if (!more || !*more) loop_->quit();
    if (more && !*more && replay_->end() == RunEnd::error) error_ = Error{replay_->end_message()};
}

void RunJournal::stop() {
    if (live_ == nullptr) return;
    live_->observe_acts(nullptr);
    stopped_ = live_->when();
}

bool RunJournal::is_of_given_length(bool here) const { return replay_ ? replay_->end() != RunEnd::stopped : here; }

Expected<void> RunJournal::finish(bool of_given_length, std::uint64_t hash) {
    if (journal_) {
        journal_->end(of_given_length ? RunEnd::duration : RunEnd::stopped, "", stopped_, hash);
        if (journal_->error()) return Unexpected(*journal_->error());
    }
    // If the user has ended the replay early, there is nothing to compare.
    if (!replay_ || !replay_->is_over() || !replay_->hash() || *replay_->hash() == hash) return {};
    return failure(fmt::format("{}: this run differs from the journal's run: its hash was {}, not {}{}", file_,
                               hash_text(*replay_->hash()), hash_text(hash), replay_->written_by()));
}

void RunJournal::give_up(const std::string& why) {
    if (journal_) journal_->end(RunEnd::error, why, live_->when(), live_->trace_hash());
}

}  // namespace nezumi::cli
