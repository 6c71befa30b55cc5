// A board with devices on I2C, SPI and GPIO, behind a program's own system calls (board_calls.cpp).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/fakes/board_protocol.hpp"

namespace nezumi::hw {

class FakeBoard {
public:
    /// Its nodes are in the folder `dev`; what the kernel says about them in `sys`.
    FakeBoard(std::string dev, std::string sys);
    ~FakeBoard();
    FakeBoard(const FakeBoard&) = delete;
    FakeBoard& operator=(const FakeBoard&) = delete;

    /// Adds nodes: "i2c-1", "spidev0.0", "gpiochip0".
    void add(const std::string& node);

    /// The environment of programs that use the board while it lives, of this process's children.
    class Environment {
    public:
        explicit Environment(const std::string& dev);
        ~Environment();
    };

    /// A device on an I2C bus with 256 registers of a byte, whose number grows with each byte. Of a number of two bytes
    /// the sum counts.
    void add_i2c(std::uint16_t address, std::uint32_t number_bytes = 1);
    void set_registers(std::uint16_t address, std::uint8_t first, const std::string& bytes);
    std::uint8_t register_of(std::uint16_t address, std::uint8_t number) const;
    /// It stops answering, as one without power.
    void set_answers(std::uint16_t address, bool answers);
    /// It answers nothing, as a bus whose clock is held low.
    void hang(bool hangs) { hangs_ = hangs; }
    /// The next transactions fail once each.
    void disturb(int transactions) { disturbed_ = transactions; }
    /// A driver of the kernel uses this address.
    void take_by_kernel(std::uint16_t address) { taken_ = address; }

    /// What its devices do when an output line changes. Called by the board's thread.
    void on_output(std::function<void(std::int64_t line, bool level)> react) { react_ = std::move(react); }
    bool level(std::int64_t line) const;
    /// An input line gets this level at `tm` [s] by `clock_seconds`.
    void edge(std::int64_t line, bool level, double tm);
    /// Another program uses this line.
    void take_line(std::int64_t line) { used_line_ = line; }

    /// What a device on SPI receives, and answers at the same time.
    void set_spi(const std::string& node, std::function<std::string(const std::string& sent)> answer) {
        const std::lock_guard lock(mutex_);
        spi_[node] = std::move(answer);
    }

    /// All that was asked: "60 w FD 10", "40 w 02 r 2".
    std::vector<std::string> transactions() const;

private:
    struct Connection {
        int file;
        std::string node;
        int mode = 0;                       // of SPI
        unsigned bits = 0;                  // the same
        std::vector<std::int64_t> lines{};  // that were requested
        bool is_input = false;
    };
    struct I2cDevice {
        std::array<std::uint8_t, 256> registers{};
        std::uint8_t at = 0;
        std::uint32_t number_bytes = 1;
        bool answers = true;
    };
    void live();
    bool serve(std::size_t index);
    // `passed`: a descriptor that goes to the program; -1: none.
    BoardAnswer answer(std::size_t index, const BoardCall& call, const char* bytes, std::string& reply, int& passed);
    BoardAnswer transfer_spi(const std::string& node, const BoardCall& call, const char* bytes, std::string& reply);
    BoardAnswer request_lines(const std::string& node, std::string& reply, int& passed);
    BoardAnswer set_lines(const Connection& connection, const std::string& values);
    BoardAnswer transfer_i2c(const BoardCall& call, const char* bytes, std::string& reply);

    const std::string dev_, sys_;
    std::atomic<bool> ends_ = false, hangs_ = false;
    std::atomic<int> disturbed_ = 0;
    std::atomic<std::uint16_t> taken_ = 0;
    std::atomic<std::int64_t> used_line_ = -1;
    std::function<void(std::int64_t, bool)> react_;
    mutable std::recursive_mutex mutex_;
    std::map<std::int64_t, bool> levels_;
    std::map<std::string, std::function<std::string(const std::string&)>> spi_;
    std::map<std::string, int> nodes_;  // listening sockets
    std::vector<Connection> connections_;
    std::map<std::uint16_t, I2cDevice> i2c_;
    std::vector<std::string> transactions_;
    std::thread thread_;
};

}  // namespace nezumi::hw
