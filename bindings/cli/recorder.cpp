// Rows are written as they come. When a sequence grows the rows from then on have more cells, and `finish` gives the
// earlier ones as many.
#include "bindings/cli/recorder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <type_traits>
#include <utility>

#include "engine/ports/payload.hpp"

namespace nezumi::cli {
namespace {

constexpr std::size_t flush_at = 16384;  // bytes

std::string quoted(const std::string& text) {
    std::string all = "\"";
    for (const char c : text) all.append(c == '"' ? 2 : 1, c);
    return all + '"';
}

template <class T>
std::string cell(const T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
        return quoted(value);
    } else if constexpr (std::is_same_v<T, bool>) {
        return value ? "1" : "0";
    } else {
        return fmt::format("{}", value);
    }
}

// The cells of a row, with their quotes.
std::vector<std::string_view> split_row(std::string_view row) {
    std::vector<std::string_view> cells;
    std::size_t begin = 0;
    bool in_quotes = false;
    for (std::size_t i = 0; i <= row.size(); ++i) {
        if (i < row.size() && row[i] == '"') in_quotes = !in_quotes;
        if (i < row.size() && (row[i] != ',' || in_quotes)) continue;
        cells.push_back(row.substr(begin, i - begin));
        begin = i + 1;
    }
    return cells;
}

// The next row of a file, which goes on over ends of line within quotes; false at the end.
bool read_row(std::istream& in, std::string& row) {
    if (!std::getline(in, row)) return false;
    std::string more;
    const auto open = [&row] {
        std::size_t quotes = 0;
        for (const char c : row) quotes += c == '"' ? 1 : 0;
        return quotes % 2 == 1;
    };
    while (open() && std::getline(in, more)) row.append("\n").append(more);
    return true;
}

}  // namespace

Expected<Recorder> Recorder::open(const std::string& file, const System& system,
                                  const std::vector<std::string>& ports) {
    Recorder recorder;
    recorder.file_ = file;
    for (const std::string& path : ports) {
        const auto port = system.port(path);
        if (!port) return failure("--ports: " + port.error().message);
        const auto dot = path.find('.');
        recorder.ports_.push_back(
            {path.substr(0, dot), path.substr(dot + 1), (*port)->direction() == Direction::in, 0, 0, {}});
    }
    if (ports.empty()) {
        for (std::size_t i = 0; i < system.components().size(); ++i) {
            const Component& component = *system.components()[i];
            for (std::size_t j = 0; j < component.out_ports().size(); ++j)
                recorder.ports_.push_back({component.name(), component.out_ports()[j]->name(), false, i, j, {}});
        }
    }
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

const Port* Recorder::find(Recorded& recorded, const System& system) {
    const auto& components = system.components();
    auto& [name, port_name, is_input, at, port_at, columns] = recorded;
    if (at >= components.size() || components[at]->name() != name) {
        for (at = 0; at < components.size() && components[at]->name() != name;) ++at;
        if (at == components.size()) return nullptr;
    }
    const Component& component = *components[at];
    if (is_input) return component.find_in_port(port_name);
    const auto& ports = component.out_ports();
    if (port_at < ports.size() && ports[port_at]->name() == port_name) return ports[port_at].get();
    return component.find_out_port(port_name);
}

void Recorder::set_cell(Recorded& recorded, std::size_t& at, const std::string& path, std::string text) {
    auto& columns = recorded.columns;
    std::size_t found = at;
    while (found < columns.size() && columns[found].name != path) ++found;
    if (found == columns.size()) {
        // What can't be read again keeps the columns it began with.
        if (real_.empty() && !layouts_.empty()) return;
        found = at;
        columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(at), {path, cells_.size()});
        cells_.emplace_back();
        columns_grew_ = true;
    }
    cells_[columns[found].id] = std::move(text);
    at = found + 1;
}

void Recorder::add_cells(Recorded& recorded, const Port& port) {
    std::size_t at = 0;
    const bool empty = port.count() == 0;
    std::visit(
        [&](const auto& value) {
            for_each_leaf(value, [&](const std::string& path, const auto& leaf) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(leaf)>, Octets>)
                    set_cell(recorded, at, path, empty ? "" : cell(leaf));
            });
        },
        port.value());
}

void Recorder::begin_layout() {
    Layout layout{rows_, {}};
    for (const Recorded& recorded : ports_) {
        for (const Column& column : recorded.columns) layout.ids.push_back(column.id);
    }
    const bool first = layouts_.empty();
    layouts_.push_back(std::move(layout));
    columns_grew_ = false;
    if (first) write_header(buffer_);
}

void Recorder::write_header(std::string& text) const {
    text += "time";
    for (const Recorded& recorded : ports_) {
        for (const Column& column : recorded.columns) {
            const bool joined = column.name.empty() || column.name.front() == '[';
            text += fmt::format(",{}.{}{}{}", recorded.component, recorded.port, joined ? "" : ".", column.name);
        }
    }
    text += '\n';
}

void Recorder::add_row(const System& system) {
    if (sealed_ || error_) return;
    for (std::string& text : cells_) text.clear();
    for (Recorded& recorded : ports_) {
        if (const Port* port = find(recorded, system)) add_cells(recorded, *port);
    }
    if (columns_grew_) begin_layout();
    buffer_ += fmt::format("{}", static_cast<double>(system.now().tick - 1) / system.settings().rate);
    for (const std::size_t id : layouts_.back().ids) buffer_.append(",").append(cells_[id]);
    buffer_ += '\n';
    ++rows_;
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
    write_header(row);
    out << row;
    read_row(in, row);  // the header of the beginning
    std::size_t layout = 0;
    std::vector<std::string_view> by_id;
    for (std::uint64_t number = 0; out && read_row(in, row); ++number) {
        if (layout + 1 < layouts_.size() && layouts_[layout + 1].row == number) ++layout;
        const auto cells = split_row(row);
        by_id.assign(cells_.size(), {});
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
