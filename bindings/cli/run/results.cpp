// The recording is written during the run; the other results are taken and written at its end.
#include "bindings/cli/run/results.hpp"

#include <fmt/format.h>

#include <utility>

#include "bindings/cli/files/output_files.hpp"
#include "bindings/cli/run/recorder.hpp"
#include "sim/picture.hpp"

namespace nezumi::cli {

Expected<void> RunResults::prepare(const RunOptions& options) {
    if (!options.record.ends_with(".mcap")) return {};
    auto recorder = McapRecorder::create(options.record);
    if (!recorder) return Unexpected(recorder.error());
    mcap_ = recorder->get();
    recorder_ = std::move(*recorder);
    return {};
}

JournalSink RunResults::journal_sink() { return mcap_ != nullptr ? mcap_->journal_sink() : JournalSink(); }

Expected<void> RunResults::open(const RunOptions& options, RunningSystem& live) {
    live_ = &live;
    picture_file_ = options.picture;
    if (!picture_file_.empty()) {
        if (auto ok = check_can_write(picture_file_); !ok) return ok;
    }
    if (mcap_ != nullptr) return mcap_->begin(live, options.ports, options.every);
    if (options.record.empty()) return {};
    auto recorder = Recorder::open(options.record, live.trace(), live.system(), options.ports, options.every);
    if (!recorder) return Unexpected(recorder.error());
    recorder_ = std::make_unique<Recorder>(std::move(*recorder));
    return {};
}

void RunResults::follow(RunLoop& loop) {
    loop_ = &loop;
    if (recorder_ || !picture_file_.empty()) loop.after_tick([this] { after_tick(); });
}

void RunResults::after_tick() {
    if (recorder_) {
        recorder_->add_rows(live_->system());
        if (recorder_->error()) loop_->quit();
    }
    if (picture_file_.empty()) return;
    if (starts_ != live_->generation()) trajectories_.clear();
    starts_ = live_->generation();
    trajectories_.add(live_->system(), live_->trace());
}

void RunResults::take(const std::string& title) {
    if (recorder_) recorder_->seal();
    hash_ = live_->trace_hash();
    if (!picture_file_.empty()) picture_ = draw::look_at(*live_, trajectories_, title);
}

Expected<void> RunResults::write() {
    if (recorder_) {
        if (auto ok = recorder_->finish(); !ok) return ok;
    }
    if (picture_) return draw::draw_picture(std::move(*picture_), picture_file_, sim::read_picture);
    return {};
}

std::string RunResults::discard(const std::string& why) {
    if (!recorder_) return "";
    recorder_->end_here(why);
    const std::string older = recorder_->told_of_older();
    return older.empty() ? "" : fmt::format(" (the recording ends there{})", older);
}

}  // namespace nezumi::cli
