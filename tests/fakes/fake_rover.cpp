// Integrates the commanded speeds to encoder counts.
#include "tests/fakes/fake_rover.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

constexpr double metres_per_pulse = 2 * 3.14159265358979 * 0.033 / 1440, track = 0.15;

bool is_command(const std::string& line, double& speed, double& rate) {
    int used = 0;
    return std::sscanf(line.c_str(), "v %lf %lf%n", &speed, &rate, &used) == 2 &&  // NOLINT(cert-err34-c)
           used == static_cast<int>(line.size());
}

}  // namespace

FakeRover::FakeRover(std::string link) : link_(std::move(link)) {
    plug();
    thread_ = std::thread([this] { live(); });
}

FakeRover::~FakeRover() {
    ends_ = true;
    thread_.join();
    unplug();
}

void FakeRover::plug() {
    int terminal = -1;
    char name[128];
    if (openpty(&terminal, &other_end_, name, nullptr, nullptr) != 0) return;
    fcntl(terminal, F_SETFL, O_NONBLOCK);
    // Programs that a test starts must not keep the cable plugged in.
    for (const int file : {terminal, other_end_}) fcntl(file, F_SETFD, FD_CLOEXEC);
    // Nothing of the engine comes back as an echo.
    termios settings{};
    tcgetattr(other_end_, &settings);
    cfmakeraw(&settings);
    tcsetattr(other_end_, TCSANOW, &settings);
    const std::lock_guard lock(mutex_);
    std::filesystem::remove(link_);
    std::filesystem::create_symlink(name, link_);
    rest_.clear();
    terminal_ = terminal;
}

void FakeRover::unplug() {
    const std::lock_guard lock(mutex_);
    const int terminal = terminal_.exchange(-1);
    if (terminal < 0) return;
    std::error_code none;
    std::filesystem::remove(link_, none);
    close(terminal);
    close(std::exchange(other_end_, -1));
}

std::vector<FakeRover::Line> FakeRover::lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
}

std::string FakeRover::last_line() const {
    const std::lock_guard lock(mutex_);
    return lines_.empty() ? "" : lines_.back().text;
}

std::vector<std::string> FakeRover::torn_lines() const {
    std::vector<std::string> torn;
    double speed = 0, rate = 0;
    for (const Line& line : lines()) {
        if (!line.text.empty() && !is_command(line.text, speed, rate)) torn.push_back(line.text);
    }
    return torn;
}

void FakeRover::say(const std::string& line) {
    const std::lock_guard lock(mutex_);
    const std::string text = line + "\n";
    if (terminal_ >= 0 && write(terminal_, text.data(), text.size()) < 0) return;
}

void FakeRover::take(const std::string& line) {
    lines_.push_back({clock_seconds(), line});
    double speed = 0, rate = 0;
    if (!is_command(line, speed, rate)) return;
    speed_ = speed;
    rate_ = rate;
    heard_at_ = clock_seconds();
}

void FakeRover::live() {
    double last = clock_seconds();
    for (int count = 0; !ends_; ++count) {
        pollfd file{.fd = hangs_ ? -1 : terminal_.load(), .events = POLLIN, .revents = 0};
        poll(&file, 1, 2);
        const std::lock_guard lock(mutex_);
        char buffer[1024];
        const ssize_t length = terminal_ < 0 || hangs_ ? 0 : read(terminal_, buffer, sizeof buffer);
        if (length > 0) rest_.append(buffer, static_cast<std::size_t>(length));
        for (std::size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n')) {
            take(rest_.substr(0, end));
            rest_.erase(0, end + 1);
        }
        const double now = clock_seconds(), passed = now - last;
        if (now - heard_at_ > time_out) speed_ = rate_ = 0;
        if (passed < 0.02) continue;
        last = now;
        left_ += (speed_ - rate_ * track / 2) * passed / metres_per_pulse;
        right_ += (speed_ + rate_ * track / 2) * passed / metres_per_pulse;
        char text[64];
        const int size = std::snprintf(text, sizeof text, "e %ld %ld\r\n", std::lround(left_), std::lround(right_));
        if (terminal_ >= 0 && write(terminal_, text, static_cast<std::size_t>(size)) < 0) continue;
    }
}

}  // namespace nezumi::hw
