// One thread answers all calls, in their order.
#include "tests/fakes/fake_board.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/i2c-dev.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

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

void FakeBoard::add_i2c(std::uint16_t address) {
    const std::lock_guard lock(mutex_);
    i2c_[address] = {};
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
            if (serve(connections_[i])) {
                ++i;
            } else {
                close(connections_[i].file);
                connections_.erase(connections_.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
    }
}

// Answers what was asked. Returns false at the end of the connection.
bool FakeBoard::serve(Connection& connection) {
    for (;;) {
        std::array<char, 16384> bytes{};
        iovec part{.iov_base = bytes.data(), .iov_len = bytes.size()};
        alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> extra{};
        msghdr message{};
        message.msg_iov = &part;
        message.msg_iovlen = 1;
        message.msg_control = extra.data();
        message.msg_controllen = extra.size();
        const ssize_t size = recvmsg(connection.file, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
        if (size < 0) return errno == EAGAIN || errno == EINTR;
        const cmsghdr* header = CMSG_FIRSTHDR(&message);
        if (size < static_cast<ssize_t>(sizeof(BoardCall)) || header == nullptr) return false;
        int to = -1;
        std::memcpy(&to, CMSG_DATA(header), sizeof to);
        BoardCall call;
        std::memcpy(&call, bytes.data(), sizeof call);
        std::string reply;
        const BoardAnswer its = answer(connection, call, bytes.data() + sizeof call, reply);
        reply.insert(0, reinterpret_cast<const char*>(&its), sizeof its);
        send(to, reply.data(), reply.size(), MSG_NOSIGNAL);
        close(to);
    }
}

BoardAnswer FakeBoard::answer(const Connection& /*connection*/, const BoardCall& call, const char* bytes,
                              std::string& reply) {
    if (call.request == I2C_SLAVE) return call.argument == taken_ ? BoardAnswer{-1, EBUSY} : BoardAnswer{};
    if (call.request == I2C_RDWR) return transfer_i2c(call, bytes, reply);
    return {-1, ENOTTY};
}

BoardAnswer FakeBoard::transfer_i2c(const BoardCall& call, const char* bytes, std::string& reply) {
    std::string text;
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
            n == 0 ? static_cast<void>(its.at = byte) : static_cast<void>(its.registers[its.at++] = byte);
        }
        bytes += message.size;
    }
    transactions_.push_back(std::move(text));
    return {static_cast<std::int32_t>(call.messages), 0};
}

}  // namespace nezumi::hw
