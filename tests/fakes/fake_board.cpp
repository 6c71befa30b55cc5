// One thread answers all calls, in their order.
#include "tests/fakes/fake_board.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/gpio.h>
#include <linux/i2c-dev.h>
#include <linux/spi/spidev.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

namespace nezumi::hw {
namespace {

// Which of the kernel's subsystems a node belongs to, and its number.
std::pair<std::string, int> kind_of(const std::string& node) {
    if (node.starts_with("i2c")) return {"i2c-dev", 89};
    if (node.starts_with("spi")) return {"spidev", 153};
    return {"gpio", 254};
}

std::string beside_program(const std::string& name) {
    std::error_code none;
    return (std::filesystem::read_symlink("/proc/self/exe", none).parent_path() / name).string();
}

void send_answer(int to, const std::string& bytes, int passed) {
    iovec part{.iov_base = const_cast<char*>(bytes.data()), .iov_len = bytes.size()};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof passed)> extra{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    if (passed >= 0) {
        message.msg_control = extra.data();
        message.msg_controllen = extra.size();
        cmsghdr* header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(sizeof passed);
        std::memcpy(CMSG_DATA(header), &passed, sizeof passed);
    }
    sendmsg(to, &message, MSG_NOSIGNAL);
}

}  // namespace

FakeBoard::Environment::Environment(const std::string& dev) {
    setenv("LD_PRELOAD", beside_program("board_calls.so").c_str(), 1);
    setenv("NEZUMI_FAKE_BOARD", dev.c_str(), 1);
}

FakeBoard::Environment::~Environment() {
    unsetenv("LD_PRELOAD");
    unsetenv("NEZUMI_FAKE_BOARD");
}

FakeBoard::FakeBoard(std::string dev, std::string sys) : dev_(std::move(dev)), sys_(std::move(sys)) {
    std::filesystem::create_directories(dev_);
    thread_ = std::thread([this] { live(); });
}

FakeBoard::~FakeBoard() {
    ends_ = true;
    thread_.join();
    for (const auto& [name, file] : nodes_) close(file);
    for (const Connection& each : connections_) close(each.file);
}

void FakeBoard::add(const std::string& node) {
    const auto [subsystem, number] = kind_of(node);
    const auto folder = fmt::format("{}/dev/char/{}:0", sys_, number);
    std::filesystem::create_directories(folder);
    if (!std::filesystem::is_symlink(folder + "/subsystem"))
        std::filesystem::create_symlink("../../../class/" + subsystem, folder + "/subsystem");
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, (dev_ + "/" + node).c_str(), sizeof address.sun_path - 1);
    const int file = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (bind(file, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 || listen(file, 8) != 0)
        throw std::runtime_error(dev_ + "/" + node + ": " + std::strerror(errno));
    const std::lock_guard lock(mutex_);
    nodes_[node] = file;
}

void FakeBoard::add_i2c(std::uint16_t address, std::uint32_t number_bytes) {
    const std::lock_guard lock(mutex_);
    i2c_[address] = {.number_bytes = number_bytes};
}

void FakeBoard::set_registers(std::uint16_t address, std::uint8_t first, const std::string& bytes) {
    const std::lock_guard lock(mutex_);
    for (const char byte : bytes) i2c_.at(address).registers[first++] = static_cast<std::uint8_t>(byte);
}

std::uint8_t FakeBoard::register_of(std::uint16_t address, std::uint8_t number) const {
    const std::lock_guard lock(mutex_);
    return i2c_.at(address).registers[number];
}

void FakeBoard::set_answers(std::uint16_t address, bool answers) {
    const std::lock_guard lock(mutex_);
    i2c_.at(address).answers = answers;
}

std::vector<std::string> FakeBoard::transactions() const {
    const std::lock_guard lock(mutex_);
    return transactions_;
}

void FakeBoard::live() {
    while (!ends_) {
        if (hangs_) {
            usleep(2000);
            continue;
        }
        std::vector<pollfd> files;
        {
            const std::lock_guard lock(mutex_);
            for (const auto& [name, file] : nodes_) files.push_back({.fd = file, .events = POLLIN, .revents = 0});
            for (const Connection& each : connections_)
                files.push_back({.fd = each.file, .events = POLLIN, .revents = 0});
        }
        poll(files.data(), files.size(), 5);
        const std::lock_guard lock(mutex_);
        for (const auto& [name, file] : nodes_) {
            const int made = accept4(file, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
            if (made >= 0) connections_.push_back({made, name});
        }
        for (std::size_t i = 0; i < connections_.size();) {
            if (serve(i)) {
                ++i;
            } else {
                close(connections_[i].file);
                connections_.erase(connections_.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
    }
}

// Answers what was asked. Returns false at the end of the connection.
bool FakeBoard::serve(std::size_t index) {
    for (;;) {
        std::array<char, 16384> bytes{};
        iovec part{.iov_base = bytes.data(), .iov_len = bytes.size()};
        alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> extra{};
        msghdr message{};
        message.msg_iov = &part;
        message.msg_iovlen = 1;
        message.msg_control = extra.data();
        message.msg_controllen = extra.size();
        const ssize_t size = recvmsg(connections_[index].file, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
        if (size < 0) return errno == EAGAIN || errno == EINTR;
        const cmsghdr* header = CMSG_FIRSTHDR(&message);
        if (size < static_cast<ssize_t>(sizeof(BoardCall)) || header == nullptr) return false;
        int to = -1;
        std::memcpy(&to, CMSG_DATA(header), sizeof to);
        BoardCall call;
        std::memcpy(&call, bytes.data(), sizeof call);
        std::string reply;
        reply.assign(bytes.data() + sizeof call, static_cast<std::size_t>(size) - sizeof call);
        int passed = -1;
        const BoardAnswer its = answer(index, call, bytes.data() + sizeof call, reply, passed);
        reply.insert(0, reinterpret_cast<const char*>(&its), sizeof its);
        send_answer(to, reply, passed);
        close(to);
        if (passed >= 0) close(passed);
    }
}

BoardAnswer FakeBoard::answer(std::size_t index, const BoardCall& call, const char* bytes, std::string& reply,
                              int& passed) {
    const Connection& connection = connections_[index];
    switch (call.request) {
        case I2C_SLAVE: return call.argument == taken_ ? BoardAnswer{-1, EBUSY} : BoardAnswer{};
        case I2C_RDWR: return transfer_i2c(call, bytes, reply);
        case GPIO_GET_CHIPINFO_IOCTL: return {};
        case GPIO_V2_GET_LINE_IOCTL: return request_lines(connection.node, reply, passed);
        case GPIO_V2_LINE_SET_VALUES_IOCTL: return set_lines(connection, reply);
        case GPIO_V2_LINE_GET_VALUES_IOCTL: {
            gpio_v2_line_values values{};
            for (std::size_t i = 0; i < connection.lines.size(); ++i)
                values.bits |= std::uint64_t{levels_[connection.lines[i]]} << i;
            reply.assign(reinterpret_cast<const char*>(&values), sizeof values);
            return {};
        }
        case SPI_IOC_MESSAGE(1): return transfer_spi(connection.node, call, bytes, reply);
        case SPI_IOC_WR_MODE: connections_[index].mode = reply[0]; return {};
        case SPI_IOC_WR_BITS_PER_WORD: connections_[index].bits = static_cast<unsigned char>(reply[0]); return {};
        case SPI_IOC_WR_MAX_SPEED_HZ: {
            std::uint32_t speed = 0;
            std::memcpy(&speed, reply.data(), sizeof speed);
            transactions_.push_back(
                fmt::format("{} mode {}, {} bits, {} Hz", connection.node, connection.mode, connection.bits, speed));
            return {};
        }
        default: return {-1, ENOTTY};
    }
}

BoardAnswer FakeBoard::transfer_spi(const std::string& node, const BoardCall& call, const char* bytes,
                                    std::string& reply) {
    reply.clear();
    std::int32_t sum = 0;
    for (std::uint32_t i = 0; i < call.messages; ++i) {
        BoardMessage message;
        std::memcpy(&message, bytes, sizeof message);
        bytes += sizeof message;
        std::string sent(message.size, '\0');
        if (message.writes != 0) {
            sent.assign(bytes, message.size);
            bytes += message.size;
        }
        std::string text = node;
        for (const char byte : sent) text += fmt::format(" {:02X}", static_cast<unsigned char>(byte));
        transactions_.push_back(std::move(text));
        const auto device = spi_.find(node);
        std::string received = device == spi_.end() ? "" : device->second(sent);
        received.resize(message.size);
        if (message.reads != 0) reply += received;
        sum += static_cast<std::int32_t>(message.size);
    }
    return {sum, 0};
}

BoardAnswer FakeBoard::request_lines(const std::string& node, std::string& reply, int& passed) {
    gpio_v2_line_request request{};
    std::memcpy(&request, reply.data(), std::min(reply.size(), sizeof request));
    Connection lines{.file = -1,
                     .node = node,
                     .lines = {request.offsets, request.offsets + request.num_lines},
                     .is_input = (request.config.flags & GPIO_V2_LINE_FLAG_INPUT) != 0};
    if (std::find(lines.lines.begin(), lines.lines.end(), used_line_) != lines.lines.end()) return {-1, EBUSY};
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return {-1, errno};
    const bool has_edges = (request.config.flags & GPIO_V2_LINE_FLAG_EDGE_RISING) != 0 &&
                           (request.config.flags & GPIO_V2_LINE_FLAG_EDGE_FALLING) != 0;
    std::string text =
        fmt::format("{} {} {}", node, lines.is_input ? "inputs" : "outputs", fmt::join(lines.lines, " "));
    if (has_edges) text += " with both edges";
    if ((request.config.flags & GPIO_V2_LINE_FLAG_BIAS_PULL_UP) != 0) text += " pulled up";
    if ((request.config.flags & GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN) != 0) text += " pulled down";
    for (std::uint32_t i = 0; i < request.config.num_attrs; ++i) {
        const gpio_v2_line_config_attribute& each = request.config.attrs[i];
        if (each.attr.id == GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES) {
            text += fmt::format(" at {:b}", each.attr.values & each.mask);
            for (std::size_t line = 0; line < lines.lines.size(); ++line)
                levels_[lines.lines[line]] = (each.attr.values >> line & 1U) != 0;
        }
        if (each.attr.id == GPIO_V2_LINE_ATTR_ID_DEBOUNCE)
            text += fmt::format(" debounced {} us", each.attr.debounce_period_us);
    }
    transactions_.push_back(text + " by " + request.consumer);
    lines.file = ends[0];
    passed = ends[1];
    connections_.push_back(std::move(lines));
    return {};
}

BoardAnswer FakeBoard::set_lines(const Connection& connection, const std::string& bytes) {
    gpio_v2_line_values values{};
    std::memcpy(&values, bytes.data(), std::min(bytes.size(), sizeof values));
    const std::vector<std::int64_t> lines = connection.lines;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if ((values.mask >> i & 1U) == 0) continue;
        const bool level = (values.bits >> i & 1U) != 0;
        if (std::exchange(levels_[lines[i]], level) == level) continue;
        transactions_.push_back(fmt::format("{}={:d}", lines[i], level));
        if (react_) react_(lines[i], level);
    }
    return {};
}

bool FakeBoard::level(std::int64_t line) const {
    const std::lock_guard lock(mutex_);
    const auto found = levels_.find(line);
    return found != levels_.end() && found->second;
}

void FakeBoard::edge(std::int64_t line, bool level, double tm) {
    const std::lock_guard lock(mutex_);
    levels_[line] = level;
    gpio_v2_line_event event{};
    event.timestamp_ns = static_cast<std::uint64_t>(tm * 1e9);
    event.id = level ? GPIO_V2_LINE_EVENT_RISING_EDGE : GPIO_V2_LINE_EVENT_FALLING_EDGE;
    event.offset = static_cast<std::uint32_t>(line);
    for (const Connection& each : connections_) {
        if (each.is_input && std::find(each.lines.begin(), each.lines.end(), line) != each.lines.end())
            send(each.file, &event, sizeof event, MSG_NOSIGNAL | MSG_DONTWAIT);
    }
}

BoardAnswer FakeBoard::transfer_i2c(const BoardCall& call, const char* bytes, std::string& reply) {
    std::string text;
    reply.clear();
    for (std::uint32_t i = 0; i < call.messages; ++i) {
        BoardMessage message;
        std::memcpy(&message, bytes, sizeof message);
        bytes += sizeof message;
        if (i == 0) text = fmt::format("{:02X}", message.address);
        const auto device = i2c_.find(message.address);
        if (device == i2c_.end() || !device->second.answers) return {-1, EREMOTEIO};
        if (disturbed_ > 0) {
            --disturbed_;
            return {-1, EREMOTEIO};
        }
        I2cDevice& its = device->second;
        if (message.reads != 0) {
            text += fmt::format(" r {}", message.size);
            for (std::uint32_t n = 0; n < message.size; ++n)
                reply.push_back(static_cast<char>(its.registers[its.at++]));
            continue;
        }
        text += " w";
        for (std::uint32_t n = 0; n < message.size; ++n) {
            const auto byte = static_cast<std::uint8_t>(bytes[n]);
            text += fmt::format(" {:02X}", byte);
            if (n >= its.number_bytes) {
                its.registers[its.at++] = byte;
            } else {
                its.at = static_cast<std::uint8_t>(n == 0 ? byte : its.at + byte);
            }
        }
        bytes += message.size;
    }
    transactions_.push_back(std::move(text));
    return {static_cast<std::int32_t>(call.messages), 0};
}

}  // namespace nezumi::hw
