// `--record`: messages and values of a system as CSV, with a row for every tick, written on a separate thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/run/run_recording.hpp"
#include "engine/base/error.hpp"
#include "engine/base/file_writer.hpp"
#include "engine/base/mutex.hpp"
#include "engine/base/result_file.hpp"
#include "engine/trace/trace.hpp"
#include "engine/trace/trace_table.hpp"

namespace nezumi::cli {

/// Follows the channels with these names ("mouse.ir_sensor_out", "mouse.truth", "controller.config") from now on. A
/// name may contain * and ?, which stand for any characters except dots. An error names what does not exist.
Expected<std::vector<const Channel*>> follow_channels(Trace& trace, const System& system,
                                                      const std::vector<std::string>& names);

/// The first column is the `time` [s] of the tick; the others are those of a `TraceTable`. If a port published several
/// messages in a tick, the tick has one row for each of them, all with the same time.
class Recorder final : public RunRecording {
public:
    /// Opens the file for these channels of the system (`follow_channels`). If `names` is empty, all out-ports are
    /// recorded, also of components that are added later. Only ticks whose number is a multiple of `every` are
    /// recorded. An error names what does not exist, or says why the file can't be written; then the file is unchanged.
    /// The trace must outlive the recorder.
    static Expected<Recorder> open(const std::string& file, Trace& trace, const System& system,
                                   const std::vector<std::string>& names, std::int64_t every = 1);
    Recorder(Recorder&&) noexcept = default;
    Recorder& operator=(Recorder&&) = delete;
    ~Recorder() override = default;

    void add_rows(const System& system) override;
    void seal() override { sealed_ = true; }
    /// A file that can't be written ends with a line that begins with # and says why.
    Expected<void> finish() override;
    void end_here(std::string_view why) override;
    std::string told_of_older() const override { return file_.told_of_older(); }
    const std::optional<Error>& error() const override { return error_; }
    bool is_behind() const override { return writer_->is_behind(); }
    void give_up() override { writer_->give_up(); }

private:
    // The columns from row `row` on, by their ids.
    struct Layout {
        std::uint64_t row;
        std::vector<std::size_t> ids;
        std::string header;
    };
    using Clock = std::chrono::steady_clock;

    explicit Recorder(Trace& trace) : trace_(&trace), table_({}) {}
    void follow_ports(const System& system);
    void empty_what_stays(std::vector<std::string>& cells);
    void begin_layout();
    void flush();
    void fail(const std::string& why);
    void complete(std::chrono::milliseconds patience);
    void align_rows();
    void end_with_note(std::string_view why);

    std::unique_ptr<Mutex> mutex_ = std::make_unique<Mutex>();  // for all members below
    std::string name_;                                          // of the file, as it was given
    ResultFile file_;
    std::unique_ptr<FileWriter> writer_;
    Trace* trace_;
    std::set<std::string> followed_;                // the out-ports, if all of them are recorded
    std::optional<std::uint64_t> followed_layout_;  // `System::layout` at the last search; none: not all are recorded
    TraceTable table_;
    std::vector<Layout> layouts_;  // the last one is the present one
    std::size_t width_ = 0;        // of the table in the last layout
    std::int64_t every_ = 1;
    // By column id: the last written value of a column that seldom changes; none for other columns.
    std::vector<std::optional<std::string>> kept_;
    bool sealed_ = false;
    std::uint64_t rows_ = 0;
    std::string buffer_;
    Clock::time_point flushed_{};
    bool aligned_ = false;  // all rows have the columns of the last layout
    bool complete_ = false;
    std::optional<Error> error_;
};

}  // namespace nezumi::cli
