// `--record`: what ports published, as CSV with a row for every tick, written beside the ticks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/file_writer.hpp"
#include "engine/base/error.hpp"
#include "engine/system/system.hpp"

namespace nezumi::cli {

/// The first column is `time` [s]; then a column for each number, truth value (0 or 1) and text of each port, called as
/// a script would: `mouse.current_pose_out.position.x`, `mouse.ir_sensor_out[1]`. A cell holds what was published last,
/// and is empty before anything was, and where a sequence is shorter than it was at its longest. Texts stand in double
/// quotes. Pictures' pixels are left out.
class Recorder {
public:
    /// Opens the file for these ports "name.port", or for every out-port when there are none. An error names a port
    /// that is not there, or says why the file can't be written; then the file is as it was.
    static Expected<Recorder> open(const std::string& file, const System& system,
                                   const std::vector<std::string>& ports);
    Recorder(Recorder&&) noexcept = default;
    Recorder& operator=(Recorder&&) = delete;
    ~Recorder() = default;

    /// Adds a row for the tick that has just passed.
    void add_row(const System& system);
    /// From now on rows are ignored.
    void seal() { sealed_ = true; }
    /// Completes the file, or takes it away and says what kept it from being written.
    Expected<void> finish();
    /// Takes the file away.
    void discard();
    /// What keeps the file from being written, as soon as something does.
    const std::optional<Error>& error() const { return error_; }

private:
    struct Column {
        std::string name;
        std::size_t id;  // in the order in which columns came to be
    };
    struct Recorded {
        std::string component;
        std::string port;
        bool is_input;
        std::size_t component_at, port_at;  // where they were found last
        std::vector<Column> columns;
    };
    // From which row on the columns are these, by their ids.
    struct Layout {
        std::uint64_t row;
        std::vector<std::size_t> ids;
    };

    Recorder() = default;
    static const Port* find(Recorded& recorded, const System& system);
    void add_cells(Recorded& recorded, const Port& port);
    void set_cell(Recorded& recorded, std::size_t& at, const std::string& path, std::string text);
    void begin_layout();
    void write_header(std::string& text) const;
    void flush();
    void fail(int code);
    Expected<void> align_rows();

    std::string file_;            // as it was given
    std::filesystem::path real_;  // without links; empty: no file that could be taken away or read again
    std::unique_ptr<FileWriter> writer_;
    std::vector<Recorded> ports_;
    std::vector<Layout> layouts_;     // the last one is today's
    std::vector<std::string> cells_;  // of the row that is being made, by column id
    bool columns_grew_ = true;
    bool sealed_ = false;
    std::uint64_t rows_ = 0;
    std::string buffer_;
    std::optional<Error> error_;
};

}  // namespace nezumi::cli
