// Reads anything as an MCAP file: what is wrong with it is an error of one line.
#include <cstdint>
#include <string_view>

#include "bindings/record/mcap_reader.hpp"
#include "bindings/record/recorded_run.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto file = record::read_mcap(bytes, "x.mcap");
    if (!file) {
        require_line(file.error().message);
        return 0;
    }
    for (const record::RecordedMessage& each : file->messages) require(file->channels.contains(each.channel));
    const auto journal = record::journal_of(*file, "x.mcap");
    if (!journal) require_line(journal.error().message);
    return 0;
}
