// Rows are written as they come. When a sequence grows the rows from then on have more cells, and `finish` gives the
// earlier ones as many.
#include "bindings/cli/recorder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "engine/base/csv.hpp"

namespace nezumi::cli {
namespace {

constexpr std::size_t flush_at = 16384;  // bytes

}  // namespace

Expected<Recorder> Recorder::open(const std::string& file, Trace& trace, const System& system,
                                  const std::vector<std::string>& names) {
    std::vector<std::string> all = names;
    if (names.empty()) {
        for (const auto& component : system.components()) {
            for (const auto& port : component->out_ports()) all.push_back(component->name() + "." + port->name());
        }
    }
    std::vector<const Channel*> channels;
    for (const std::string& name : all) {
        const auto channel = trace.follow(name);
        if (!channel) return failure("--ports: " + channel.error().message);
        channels.push_back(*channel);
    }
    Recorder recorder(channels);
    recorder.file_ = file;
    const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0) return failure(fmt::format("can't be written: {}", std::strerror(errno)), {.file = file});
    struct stat status {};
    std::error_code none;
    if (fstat(fd, &status) == 0 && S_ISREG(status.st_mode)) {
        recorder.real_ = std::filesystem::canonical(file, none);
        if (ftruncate(fd, 0) != 0) recorder.fail(errno);
    }
    recorder.writer_ = std::make_unique<FileWriter>(fd);
    return recorder;
}

void Recorder::begin_layout() {
    layouts_.push_back({rows_, table_.order()});
    width_ = table_.width();
    if (layouts_.size() > 1) return;
    buffer_ += "time" + table_.header() + "\n";
    // What can't be read again keeps the columns it began with.
    if (real_.empty()) table_.fix_columns();
}

void Recorder::add_rows(const System& system) {
    if (sealed_ || error_) return;
    const double seconds = static_cast<double>(system.now().tick - 1) / system.settings().rate;
    table_.read([&](const std::vector<std::string>& cells) {
        if (layouts_.empty() || table_.width() > width_) begin_layout();
        buffer_ += fmt::format("{}", seconds);
        for (const std::size_t id : layouts_.back().ids) buffer_.append(",").append(cells[id]);
        buffer_ += '\n';
        ++rows_;
    });
    if (buffer_.size() >= flush_at) flush();
}

void Recorder::fail(int code) { error_ = Error{fmt::format("can't be written: {}", std::strerror(code)), {file_}}; }

void Recorder::flush() {
    writer_->put(std::exchange(buffer_, {}));
    if (const int problem = writer_->problem(); problem != 0 && !error_) fail(problem);
}

Expected<void> Recorder::align_rows() {
    const std::filesystem::path aligned = real_.string() + ".part";
    std::ifstream in(real_, std::ios::binary);
    std::ofstream out(aligned, std::ios::binary | std::ios::trunc);
    std::string row;
    out << "time" << table_.header() << '\n';
    read_csv_row(in, row);  // the header of the beginning
    std::size_t layout = 0;
    std::vector<std::string_view> by_id;
    for (std::uint64_t number = 0; out && read_csv_row(in, row); ++number) {
        if (layout + 1 < layouts_.size() && layouts_[layout + 1].row == number) ++layout;
        const auto cells = split_csv_row(row).value_or(std::vector<std::string_view>{""});
        by_id.assign(table_.width(), {});
        const auto& ids = layouts_[layout].ids;
        for (std::size_t i = 0; i < ids.size() && i + 1 < cells.size(); ++i) by_id[ids[i]] = cells[i + 1];
        out << cells.front();
        for (const std::size_t id : layouts_.back().ids) out << ',' << by_id[id];
        out << '\n';
    }
    out.close();
    std::error_code code;
    if (out) std::filesystem::rename(aligned, real_, code);
    if (out && !code) return {};
    std::error_code none;
    std::filesystem::remove(aligned, none);
    return failure(fmt::format("can't be written: {}", code ? code.message() : "the disk may be full"), {file_});
}

Expected<void> Recorder::finish() {
    if (layouts_.empty()) begin_layout();  // no tick has passed: the header alone
    flush();
    if (const int problem = writer_->close(); problem != 0 && !error_) fail(problem);
    Expected<void> result = error_ ? Expected<void>(Unexpected(*error_)) : Expected<void>{};
    if (result && layouts_.size() > 1) result = align_rows();
    if (!result) discard();
    return result;
}

void Recorder::discard() {
    sealed_ = true;
    writer_->close();
    std::error_code none;
    if (!real_.empty()) std::filesystem::remove(real_, none);
}

}  // namespace nezumi::cli
