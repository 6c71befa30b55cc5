// Calls are noted when they start, so that a call that never returns is in the log too.
#include "hw/log/logged_files.hpp"

#include <limits>
#include <utility>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

using Kind = DeviceCall::Kind;

class LoggedFile final : public OpenFile {
public:
    LoggedFile(std::shared_ptr<LoggedFiles> log, std::string path, std::unique_ptr<OpenFile> file)
        : log_(std::move(log)), path_(std::move(path)), file_(std::move(file)) {}

    Answer<std::size_t> read(std::span<char> buffer) override {
        return log_->logged({.kind = Kind::read, .path = path_}, [&](DeviceCall& call) {
            auto length = file_->read(buffer);
            if (length) call.text.assign(buffer.data(), *length);
            return length;
        });
    }
    Answer<std::size_t> write(std::string_view text) override {
        const bool is_long = text.size() > longest_text;
        return log_->logged(
            {.kind = Kind::write, .path = path_, .text = is_long ? fingerprint(text) : std::string(text)},
            [&](DeviceCall& call) {
                auto length = file_->write(text);
                if (length) call.bytes = *length;
                return length;
            });
    }
    Answer<std::size_t> keys(std::span<char> down) override {
        return log_->logged({.kind = Kind::keys, .path = path_}, [&](DeviceCall& call) {
            auto length = file_->keys(down);
            if (length) call.text.assign(down.data(), std::min(*length, down.size()));
            return length;
        });
    }
    int descriptor() const override { return file_->descriptor(); }

private:
    std::shared_ptr<LoggedFiles> log_;
    const std::string path_;
    std::unique_ptr<OpenFile> file_;
};

bool is_under(const std::string& folder, const std::string& path) {
    return path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

}  // namespace

Expected<std::shared_ptr<LoggedFiles>> LoggedFiles::create(const std::string& file, const DeviceRoots& roots) {
    auto opened = ResultFile::open(file);
    if (!opened) return Unexpected(opened.error());
    std::shared_ptr<LoggedFiles> log(new LoggedFiles(std::move(*opened), roots));
    log->writer_.put(device_log_header());
    return log;
}

LoggedFiles::LoggedFiles(ResultFile file, DeviceRoots roots)
    : roots_(std::move(roots)), began_(clock_seconds()), file_(std::move(file)), writer_(file_.descriptor()) {}

double LoggedFiles::now() const { return clock_seconds() - began_; }

// Replaces the folders used instead of /dev and /sys by these names, so that the log is valid on another machine.
std::string LoggedFiles::canonical(const std::string& path) const {
    const bool is_sys =
        is_under(roots_.sys, path) && (roots_.sys.size() > roots_.dev.size() || !is_under(roots_.dev, path));
    if (is_sys) return "/sys" + path.substr(roots_.sys.size());
    return is_under(roots_.dev, path) ? "/dev" + path.substr(roots_.dev.size()) : path;
}

std::uint64_t LoggedFiles::begin(DeviceCall& call) {
    call.path = canonical(call.path);
    call.begin = now();
    const std::lock_guard lock(mutex_);
    waiting_.emplace(++calls_, call);
    return calls_;
}

void LoggedFiles::finish(std::uint64_t number, DeviceCall call) {
    call.took = now() - call.begin;
    const std::lock_guard lock(mutex_);
    waiting_.erase(number);
    if (!is_closed_) writer_.put(to_line(call));
}

Answer<std::unique_ptr<OpenFile>> LoggedFiles::open(const std::string& path, Access access) {
    const Kind kind = access == Access::read ? Kind::open_read : Kind::open_write;
    return logged({.kind = kind, .path = path}, [&](DeviceCall& /*call*/) -> Answer<std::unique_ptr<OpenFile>> {
        auto file = roots_.files->open(path, access);
        if (!file) return file;
        return std::make_unique<LoggedFile>(shared_from_this(), path, std::move(*file));
    });
}

Answer<std::vector<std::string>> LoggedFiles::list(const std::string& folder) {
    return logged({.kind = Kind::list, .path = folder}, [&](DeviceCall& call) {
        auto names = roots_.files->list(folder);
        if (names) {
            for (const std::string& name : *names) call.text += name + "\n";
        }
        return names;
    });
}

void LoggedFiles::start() { writer_.put(start_line(now())); }
void LoggedFiles::end() { writer_.put(end_line(now())); }

int LoggedFiles::close() {
    {
        const std::lock_guard lock(mutex_);
        if (!std::exchange(is_closed_, true)) {
            for (auto& [number, call] : waiting_) {
                call.took = std::numeric_limits<double>::infinity();
                writer_.put(to_line(call));
            }
        }
    }
    const int problem = writer_.close();
    if (problem == 0) file_.replace_older();
    return problem;
}

}  // namespace nezumi::hw
