// The writes of a file are a step function: a value holds until the next write.
#include "hw/log/write_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/number_in.hpp"

namespace nezumi::hw {
namespace {

using Write = WriteComparison::Write;

// The first write after `tm`.
auto after(const std::vector<Write>& writes, double tm) {
    return std::upper_bound(writes.begin(), writes.end(), tm, [](double t, const Write& each) { return t < each.tm; });
}

bool is_like(const Write& write, const std::vector<Write>& other) {
    auto from = after(other, write.tm - WriteComparison::window);
    const auto to = after(other, write.tm + WriteComparison::window);
    if (from != other.begin()) --from;  // the value at the start of the window
    if (std::any_of(from, to, [&](const Write& each) { return each.text == write.text; })) return true;
    const auto wanted = finite_in(write.text);
    if (!wanted) return false;
    std::optional<double> smallest, largest;
    for (auto each = from; each != to; ++each) {
        const auto value = finite_in(each->text);
        if (!value) continue;
        smallest = std::min(smallest.value_or(*value), *value);
        largest = std::max(largest.value_or(*value), *value);
    }
    if (!smallest) return false;
    const double size = std::max({std::abs(*wanted), std::abs(*smallest), std::abs(*largest)});
    const double slack = std::max(WriteComparison::least, WriteComparison::part * size);
    return *wanted >= *smallest - slack && *wanted <= *largest + slack;
}

}  // namespace

void WriteComparison::wrote(const std::string& path, double tm, std::string text) {
    written_[path].push_back({.tm = tm, .text = std::move(text)});
}

void WriteComparison::move_written(double seconds) {
    for (auto& [path, writes] : written_) {
        for (Write& each : writes) each.tm += seconds;
    }
}

std::string WriteComparison::in_force(const std::vector<Write>& writes, double tm) const {
    const auto next = after(writes, tm);
    if (next == writes.begin()) return "nothing";
    const Write& last = *std::prev(next);
    return last.line == 0 ? fmt::format("'{}'", shown(last.text))
                          : fmt::format("'{}' (line {})", shown(last.text), last.line);
}

void WriteComparison::judge(Progress& progress, bool is_like, std::vector<std::string>& told, std::string line) {
    ++compared_;
    if (!is_like && !progress.differs) {
        ++differences_;
        told.push_back(std::move(line));
    }
    progress.differs = !is_like;
}

std::vector<std::string> WriteComparison::compare(double now) {
    std::vector<std::string> told;
    // Adds the paths that only the log has.
    for (const auto& [path, writes] : logged_) written_[path];
    for (const auto& [path, writes] : written_) logged_[path];
    for (auto& [path, written] : written_) {
        const std::vector<Write>& logged = logged_[path];
        Progress& progress = progress_[path];
        // Compares the writes of both runs in order of time.
        for (;;) {
            const Write* was = progress.logged < logged.size() ? &logged[progress.logged] : nullptr;
            const Write* is = progress.written < written.size() ? &written[progress.written] : nullptr;
            // Writes near the end are not compared yet, because the later half of their window is missing.
            if (was != nullptr && (was->tm > now - window || was->tm > end_ - window)) was = nullptr;
            if (is != nullptr && is->tm > now - window) is = nullptr;
            if (was == nullptr && is == nullptr) break;
            const bool is_logged = is == nullptr || (was != nullptr && was->tm <= is->tm);
            const Write& write = is_logged ? *was : *is;
            ++(is_logged ? progress.logged : progress.written);
            if (write.tm < start_ || write.tm > end_) continue;
            const bool alike = is_like(write, is_logged ? written : logged);
            judge(progress, alike, told,
                  is_logged
                      ? fmt::format("{}:{}: at {:.3f} s '{}' was written to {}, but now it has {}", file_, write.line,
                                    write.tm, shown(write.text), shown(path), in_force(written, write.tm))
                      : fmt::format("{}: at {:.3f} s '{}' is written to {}, and the log has {}", file_, write.tm,
                                    shown(write.text), shown(path), in_force(logged, write.tm)));
        }
    }
    return told;
}

}  // namespace nezumi::hw
