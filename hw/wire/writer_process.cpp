// Each device has one process. The process receives a message completely or not at all, so no message is cut off when
// the engine is killed.
#include "hw/wire/writer_process.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

struct Outgoing {
    std::array<char, longest_message> bytes;
    std::size_t size = 0, done = 0;
};

// The descriptors that came with an order; -1: none.
using PassedFiles = std::array<int, most_files>;

class Writer {
public:
    explicit Writer(int socket) : socket_(socket) {}

    int file() const { return target_.file; }
    bool has_work() const { return target_.file >= 0 && count_ > 0; }

    void take_device(const WriterOrder& order, const char* bytes, std::size_t size, const PassedFiles& files) {
        close_files();
        target_ = {.by = order.by, .address = order.address, .file = files.front()};
        std::copy(files.begin() + 1, files.end(), target_.pwm.begin());
        count_ = 0;
        safe_size_ = std::min(size - order.end_size, longest_safe);
        std::memcpy(safe_.data(), bytes + order.end_size, safe_size_);
        // Ends a message that was cut off before, for any reason.
        if (safe_size_ > 0) add(bytes, order.end_size);
        add_safe();
    }

    void add(const char* bytes, std::size_t size) {
        if (size == 0 || size > longest_message || target_.file < 0) return;
        if (count_ == waiting_.size()) {
            // The first message stays, because it may be half written.
            std::rotate(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(first_), waiting_.end());
            first_ = 0;
            std::move(waiting_.begin() + 2, waiting_.end(), waiting_.begin() + 1);
            --count_;
            say({.kind = WriterAnswer::Kind::dropped});
        }
        Outgoing& next = waiting_[(first_ + count_) % waiting_.size()];
        std::memcpy(next.bytes.data(), bytes, size);
        next.size = size;
        next.done = 0;
        ++count_;
    }

    void stop() {
        count_ = count_ > 0 && waiting_[first_].done > 0 ? 1 : 0;
        add_safe();
    }

    // Sends the safe bytes before closing: a device that counts as lost may still receive them and stop.
    void release() {
        stop();
        write_some();
        close_files();
        count_ = 0;
    }

    // Writes as much as the device accepts now.
    void write_some() {
        while (has_work()) {
            Outgoing& next = waiting_[first_];
            const bool is_answered = target_.by == WriteBy::spi_answered;
            const ssize_t written = write_message(target_, next.bytes.data() + next.done, next.size - next.done,
                                                  is_answered ? answer_.data() : nullptr);
            const bool is_datagram = target_.by == WriteBy::datagram;
            if (written < 0 && errno == EINTR) continue;
            if (written < 0 && errno == EAGAIN && target_.by == WriteBy::stream) return;
            if (written < 0 && !is_datagram) return lose(errno);
            if (is_answered) tell_answer(next);
            next.done += written < 0 ? next.size : static_cast<std::size_t>(written);
            if (next.done < next.size) continue;
            first_ = (first_ + 1) % waiting_.size();
            --count_;
        }
    }

    // Stops the device before this process ends, but does not wait for a device that hangs.
    void end() {
        constexpr double patience = 0.5;
        const double begin = clock_seconds();
        stop();
        while (has_work() && clock_seconds() - begin < patience) {
            pollfd device{.fd = target_.file, .events = POLLOUT, .revents = 0};
            poll(&device, 1, 20);
            write_some();
        }
        // Waits until all is sent: when a line is closed, the kernel drops the rest.
        int unsent = 0;
        while (target_.file >= 0 && isatty(target_.file) != 0 && ioctl(target_.file, TIOCOUTQ, &unsent) == 0 &&
               unsent > 0 && clock_seconds() - begin < patience)
            usleep(1000);
    }

    void say(const WriterAnswer& answer) const { send(socket_, &answer, sizeof answer, MSG_DONTWAIT | MSG_NOSIGNAL); }

private:
    void tell_answer(const Outgoing& sent) {
        WriterAnswer head{.kind = WriterAnswer::Kind::answer, .tm = clock_seconds()};
        std::array<iovec, 3> parts{iovec{.iov_base = &head, .iov_len = sizeof head},
                                   iovec{.iov_base = const_cast<char*>(sent.bytes.data()), .iov_len = sent.size},
                                   iovec{.iov_base = answer_.data(), .iov_len = sent.size}};
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = parts.size();
        sendmsg(socket_, &message, MSG_DONTWAIT | MSG_NOSIGNAL);
    }

    void add_safe() { add(safe_.data(), safe_size_); }

    void close_files() {
        for (const int file : target_.pwm) {
            if (file >= 0) close(file);
        }
        if (target_.file >= 0) close(target_.file);
        target_ = {};
    }

    void lose(int error) {
        close_files();
        count_ = 0;
        say({.kind = WriterAnswer::Kind::lost, .error = error});
    }

    int socket_;
    WriteTarget target_;
    std::array<char, longest_safe> safe_{};
    std::size_t safe_size_ = 0;
    std::array<Outgoing, 16> waiting_{};
    std::array<char, longest_message> answer_{};
    std::size_t first_ = 0, count_ = 0;
};

struct Packet {
    WriterOrder order;
    std::array<char, longest_message> bytes;
};

// Receives one packet. Returns the number of bytes after the order; -1 at the end of the socket; -2 if no packet waits.
ssize_t receive(int socket, Packet& packet, PassedFiles& files) {
    std::array<iovec, 2> parts{iovec{.iov_base = &packet.order, .iov_len = sizeof packet.order},
                               iovec{.iov_base = packet.bytes.data(), .iov_len = packet.bytes.size()}};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(PassedFiles))> extra{};
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    message.msg_control = extra.data();
    message.msg_controllen = extra.size();
    const ssize_t length = recvmsg(socket, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
    files.fill(-1);
    if (const cmsghdr* header = CMSG_FIRSTHDR(&message); length > 0 && header != nullptr)
        std::memcpy(files.data(), CMSG_DATA(header), std::min(header->cmsg_len - CMSG_LEN(0), sizeof files));
    if (length == 0 || (length < 0 && errno != EAGAIN && errno != EINTR)) return -1;
    const ssize_t bytes = length - static_cast<ssize_t>(sizeof packet.order);
    return bytes < 0 ? -2 : bytes;
}

}  // namespace

void be_writer(int socket, int lease, pid_t engine, const ProcessWords& words) {
    const int death = become_guard(socket, lease, words);
    Writer writer(socket);
    Packet packet;
    bool awaits_beat = false;
    double beat_at = 0;
    while (getppid() == engine) {
        std::array<pollfd, 3> files{
            pollfd{.fd = socket, .events = POLLIN, .revents = 0}, pollfd{.fd = death, .events = POLLIN, .revents = 0},
            pollfd{.fd = writer.has_work() ? writer.file() : -1, .events = POLLOUT, .revents = 0}};
        const double left = beat_at + beat_timeout - clock_seconds();
        const int timeout = awaits_beat ? std::max(0, static_cast<int>(left * 1e3) + 1) : -1;
        if (poll(files.data(), files.size(), timeout) < 0 && errno != EINTR) break;
        if (files[1].revents != 0) break;
        PassedFiles passed{};
        const ssize_t size = files[0].revents != 0 ? receive(socket, packet, passed) : -2;
        if (size == -1) break;
        if (size >= 0) {
            switch (packet.order.kind) {
                case WriterOrder::Kind::device:
                    if (passed.front() >= 0 && size >= packet.order.end_size)
                        writer.take_device(packet.order, packet.bytes.data(), static_cast<std::size_t>(size), passed);
                    break;
                case WriterOrder::Kind::message: writer.add(packet.bytes.data(), static_cast<std::size_t>(size)); break;
                case WriterOrder::Kind::beat:
                    awaits_beat = true;
                    beat_at = packet.order.tm;
                    break;
                case WriterOrder::Kind::release:
                    awaits_beat = false;
                    writer.release();
                    break;
                case WriterOrder::Kind::stop:
                    awaits_beat = false;
                    writer.stop();
                    break;
            }
        } else if (awaits_beat && clock_seconds() - beat_at >= beat_timeout) {
            awaits_beat = false;
            writer.stop();
            writer.say({.kind = WriterAnswer::Kind::stopped});
        }
        writer.write_some();
    }
    writer.end();
    _exit(0);
}

}  // namespace nezumi::hw
