// Reads anything as a device log: what comes out is written as it was read, and plays; or there is one line that says
// where and why not.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "hw/log/device_log.hpp"
#include "hw/log/write_comparison.hpp"
#include "tests/fuzz/require.hpp"

using namespace nezumi;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto log = hw::read_device_log(text, "any.log");
    if (!log) {
        check(log.error());
        return 0;
    }
    require(log->start >= 0 && log->start <= log->length);
    hw::WriteComparison::Writes writes;
    std::string again = hw::device_log_header();
    for (const hw::DeviceCall& call : log->calls) {
        require(call.begin >= 0 && call.took >= 0 && (call.error == 0 || call.error < 4096));
        again += hw::to_line(call);
        if (call.kind == hw::DeviceCall::Kind::write)
            writes[call.path].push_back({.tm = call.begin, .text = call.text, .line = call.line});
    }
    for (auto& [path, each] : writes)
        std::stable_sort(each.begin(), each.end(), [](const auto& a, const auto& b) { return a.tm < b.tm; });
    const auto read = hw::read_device_log(again, "again.log");
    require(read && read->calls.size() == log->calls.size());
    for (std::size_t i = 0; i < log->calls.size(); ++i) {
        hw::DeviceCall as_read = read->calls[i], as_was = log->calls[i];
        // Written to the microsecond, on a line of its own.
        require(std::abs(as_read.begin - as_was.begin) < 1e-5);
        as_read.begin = as_was.begin;
        as_read.took = as_was.took;
        as_read.line = as_was.line;
        require(as_read == as_was);
    }
    hw::WriteComparison comparison("any.log", std::move(writes), log->start, log->length);
    for (const std::string& line : comparison.compare(log->length + 1)) require_line(line);
    return 0;
}
