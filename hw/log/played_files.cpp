// Replays a device log as device files. Each path has its calls in the log's order; the clock decides which one is due.
#include "hw/log/played_files.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

using Kind = DeviceCall::Kind;

// A call of the log that begins at most this time [s] later than now is already used.
constexpr double patience = 0.02;
// Calls other than reads that took longer [s] in the log hang in the replay too. Shorter ones do not wait.
constexpr double hang = 0.05;

WriteComparison::Writes writes_of(const DeviceLog& log) {
    WriteComparison::Writes writes;
    for (const DeviceCall& call : log.calls) {
        if (call.kind == Kind::write)
            writes[call.path].push_back({.tm = call.begin, .text = call.text, .line = call.line});
    }
    for (auto& [path, each] : writes)
        std::stable_sort(each.begin(), each.end(), [](const auto& a, const auto& b) { return a.tm < b.tm; });
    return writes;
}

}  // namespace

class PlayedFile final : public OpenFile {
public:
    PlayedFile(std::shared_ptr<PlayedFiles> files, std::string path)
        : files_(std::move(files)), path_(std::move(path)) {}
    Answer<std::size_t> read(std::span<char> buffer) override { return files_->read(Kind::read, path_, buffer); }
    Answer<std::size_t> write(std::string_view text) override { return files_->write(path_, text); }
    Answer<std::size_t> keys(std::span<char> down) override { return files_->read(Kind::keys, path_, down); }

private:
    std::shared_ptr<PlayedFiles> files_;
    const std::string path_;
};

PlayedFiles::PlayedFiles(DeviceLog log, const std::string& file)
    : log_(std::move(log)), zero_(clock_seconds()), comparison_(file, writes_of(log_), log_.start, log_.length) {
    for (const DeviceCall& call : log_.calls) tracks_[{call.kind, call.path}].calls.push_back(&call);
    for (auto& [what, track] : tracks_)
        std::stable_sort(track.calls.begin(), track.calls.end(),
                         [](const DeviceCall* a, const DeviceCall* b) { return a->begin < b->begin; });
}

PlayedFiles::~PlayedFiles() = default;

double PlayedFiles::now() const { return clock_seconds() - zero_; }

void PlayedFiles::start() {
    const std::lock_guard lock(mutex_);
    const double before = std::exchange(zero_, clock_seconds() - log_.start);
    comparison_.move_written(before - zero_);
}

bool PlayedFiles::is_over() const {
    const std::lock_guard lock(mutex_);
    return now() >= log_.length;
}

std::vector<std::string> PlayedFiles::take_differences() {
    const std::lock_guard lock(mutex_);
    return comparison_.compare(now());
}

std::vector<std::string> PlayedFiles::finish() {
    const std::lock_guard lock(mutex_);
    is_finished_ = true;
    over_.notify_all();
    return comparison_.compare(std::min(now(), log_.length) + WriteComparison::window);
}

PlayedFiles::Track& PlayedFiles::track(Kind kind, const std::string& path) { return tracks_[{kind, path}]; }

// The last call that has begun by now; before the first call, the first one. Null: there are no calls.
const DeviceCall* PlayedFiles::newest(const Track& track) const {
    if (track.calls.empty()) return nullptr;
    const auto next = std::upper_bound(track.calls.begin(), track.calls.end(), now() + patience,
                                       [](double tm, const DeviceCall* call) { return tm < call->begin; });
    return next == track.calls.begin() ? track.calls.front() : *std::prev(next);
}

void PlayedFiles::wait_for(Lock& lock, const DeviceCall& call) {
    // Does not wait for a call that begins later: its result is returned immediately.
    while (!is_finished_ && call.begin <= now() + patience && now() < call.end()) {
        const double left = std::min(call.end() - now(), 1.0);
        over_.wait_for(lock, std::chrono::duration<double>(left));
    }
}

Answer<std::unique_ptr<OpenFile>> PlayedFiles::open(const std::string& path, Access access) {
    Lock lock(mutex_);
    const DeviceCall* call = newest(track(access == Access::read ? Kind::open_read : Kind::open_write, path));
    if (call == nullptr) return tl::unexpected(ENOENT);
    if (call->took > hang) wait_for(lock, *call);
    if (call->error != 0) return tl::unexpected(call->error);
    return std::make_unique<PlayedFile>(shared_from_this(), path);
}

Answer<std::vector<std::string>> PlayedFiles::list(const std::string& folder) {
    Lock lock(mutex_);
    const DeviceCall* call = newest(track(Kind::list, folder));
    if (call == nullptr) return tl::unexpected(ENOENT);
    if (call->took > hang) wait_for(lock, *call);
    if (call->error != 0) return tl::unexpected(call->error);
    std::vector<std::string> names;
    for (std::string_view rest = call->text; !rest.empty();) {
        const auto end = std::min(rest.find('\n'), rest.size());
        names.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return names;
}

Answer<std::size_t> PlayedFiles::read(Kind kind, const std::string& path, std::span<char> buffer) {
    Lock lock(mutex_);
    Track& its = track(kind, path);
    if (its.calls.empty()) return tl::unexpected(ENODATA);
    const auto count = static_cast<std::ptrdiff_t>(its.calls.size());
    const auto call_at = [&](std::ptrdiff_t i) -> const DeviceCall& { return *its.calls[static_cast<std::size_t>(i)]; };
    std::ptrdiff_t at = its.given;
    while (at + 1 < count && call_at(at + 1).end() <= now()) ++at;
    const bool is_next_due = at + 1 < count && call_at(at + 1).begin <= now() + patience;
    if (at < 0 || (at == its.given && is_next_due)) ++at;
    its.given = at;
    const DeviceCall& call = call_at(at);
    wait_for(lock, call);
    if (call.error != 0) return tl::unexpected(call.error);
    const std::size_t length = std::min(call.text.size(), buffer.size());
    std::memcpy(buffer.data(), call.text.data(), length);
    return length;
}

Answer<std::size_t> PlayedFiles::write(const std::string& path, std::string_view text) {
    Lock lock(mutex_);
    const std::string kept = text.size() > longest_text ? fingerprint(text) : std::string(text);
    if (!is_finished_) comparison_.wrote(path, now(), kept);
    const DeviceCall* call = newest(track(Kind::write, path));
    if (call == nullptr || call->begin > now() + patience) return text.size();
    if (call->took > hang) wait_for(lock, *call);
    if (call->error != 0) return tl::unexpected(call->error);
    return call->text == kept ? call->bytes : text.size();
}

}  // namespace nezumi::hw
