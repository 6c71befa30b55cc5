// A recording is recognized by its first bytes, not by its name.
#include "bindings/cli/files/run_file.hpp"

#include "bindings/journal/replay.hpp"
#include "bindings/record/recorded_run.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {

Expected<std::string> read_run(const std::filesystem::path& file) {
    auto text = read_whole(file, file.string(), Replay::largest);
    if (!text || !record::is_mcap(*text)) return text;
    const auto recording = record::read_mcap(*text, file.string());
    if (!recording) return Unexpected(recording.error());
    return record::journal_of(*recording, file.string());
}

}  // namespace nezumi::cli
