// `--record`: what a system carried, as CSV with a row for every tick, written beside the ticks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/file_writer.hpp"
#include "engine/base/error.hpp"
#include "engine/trace/trace.hpp"
#include "engine/trace/trace_table.hpp"

namespace nezumi::cli {

/// The first column is `time` [s], the tick's; the others are those of a `TraceTable`. A tick in which a port published
/// several messages has as many rows of the same time.
class Recorder {
public:
    /// Opens the file for these channels of the system ("mouse.ir_sensor_out", "mouse.truth", "controller.config"), or
    /// for every out-port when there are none. An error names what is not there, or says why the file can't be written;
    /// then the file is as it was. The trace must outlive the recorder.
    static Expected<Recorder> open(const std::string& file, Trace& trace, const System& system,
                                   const std::vector<std::string>& names);
    Recorder(Recorder&&) noexcept = default;
    Recorder& operator=(Recorder&&) = delete;
    ~Recorder() = default;

    /// Adds what the tick that has just passed brought.
    void add_rows(const System& system);
    /// From now on rows are ignored.
    void seal() { sealed_ = true; }
    /// Completes the file, or takes it away and says what kept it from being written.
    Expected<void> finish();
    /// Takes the file away.
    void discard();
    /// What keeps the file from being written, as soon as something does.
    const std::optional<Error>& error() const { return error_; }

private:
    // From which row on the columns are these, by their ids.
    struct Layout {
        std::uint64_t row;
        std::vector<std::size_t> ids;
    };

    explicit Recorder(const std::vector<const Channel*>& channels) : table_(channels) {}
    void begin_layout();
    void flush();
    void fail(int code);
    Expected<void> align_rows();

    std::string file_;            // as it was given
    std::filesystem::path real_;  // without links; empty: no file that could be taken away or read again
    std::unique_ptr<FileWriter> writer_;
    TraceTable table_;
    std::vector<Layout> layouts_;  // the last one is today's
    std::size_t width_ = 0;        // of the table in the last one
    bool sealed_ = false;
    std::uint64_t rows_ = 0;
    std::string buffer_;
    std::optional<Error> error_;
};

}  // namespace nezumi::cli
