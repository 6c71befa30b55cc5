// Forks the writer and sends it packets.
#include "hw/wire/device_writer.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace nezumi::hw {

Expected<std::unique_ptr<DeviceWriter>> DeviceWriter::start(Lease lease) {
    if (getpid() == 1)
        return failure(
            "nezumi is process 1 of its container. When it ends, the container ends too, and nothing can stop the "
            "device. Start nezumi from a shell that ends later, for example: sh -c 'nezumi run ...; sleep 1'");
    std::array<int, 2> ends{};
    const auto refuse = [] {
        return failure(std::string("can't start the process that writes: ") + std::strerror(errno));
    };
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return refuse();
    const pid_t engine = getpid();
    const ProcessWords words = ProcessWords::of_this();
    const pid_t process = fork();
    if (process == 0) be_writer(ends[1], lease.file(), engine, words);
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return refuse();
    }
    return std::unique_ptr<DeviceWriter>(new DeviceWriter(std::move(lease), ends[0], process));
}

DeviceWriter::~DeviceWriter() {
    close(socket_);
    kill(process_, SIGCONT);  // in case it was suspended
    // Waits for the writer's end, but not for a writer that hangs in the kernel.
    if (const int file = static_cast<int>(syscall(SYS_pidfd_open, process_, 0)); file >= 0) {
        pollfd ended{.fd = file, .events = POLLIN, .revents = 0};
        poll(&ended, 1, 1500);
        close(file);
    }
    waitpid(process_, nullptr, WNOHANG);
}

int DeviceWriter::order(const WriterOrder& order, std::string_view bytes, std::span<const int> files) const {
    WriterOrder head = order;
    std::array<iovec, 2> parts{iovec{.iov_base = &head, .iov_len = sizeof head},
                               iovec{.iov_base = const_cast<char*>(bytes.data()), .iov_len = bytes.size()}};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(most_files * sizeof(int))> extra{};
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    if (!files.empty()) {
        message.msg_control = extra.data();
        message.msg_controllen = CMSG_SPACE(files.size_bytes());
        cmsghdr* header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(files.size_bytes());
        std::memcpy(CMSG_DATA(header), files.data(), files.size_bytes());
    }
    return sendmsg(socket_, &message, MSG_DONTWAIT | MSG_NOSIGNAL) < 0 ? errno : 0;
}

int DeviceWriter::give(const WriteTarget& target, const std::string& end, const std::string& safe) const {
    std::array<int, most_files> files{target.file};
    std::size_t count = 1;
    // The used channels come first, so their files are sent in order.
    for (const int file : target.pwm) {
        if (file >= 0) files[count++] = file;
    }
    return order({.kind = WriterOrder::Kind::device,
                  .by = target.by,
                  .end_size = static_cast<std::uint8_t>(end.size()),
                  .address = target.address},
                 end + safe, std::span(files).first(count));
}

void DeviceWriter::send(std::string_view message) const { order({.kind = WriterOrder::Kind::message}, message); }
void DeviceWriter::beat(double now) const { order({.kind = WriterOrder::Kind::beat, .tm = now}, {}); }
void DeviceWriter::release() const { order({.kind = WriterOrder::Kind::release}, {}); }
void DeviceWriter::stop() const { order({.kind = WriterOrder::Kind::stop}, {}); }

std::optional<std::pair<WriterAnswer, std::string>> DeviceWriter::take_answer() {
    WriterAnswer answer;
    std::array<char, 2 * longest_message> bytes;
    std::array<iovec, 2> parts{iovec{.iov_base = &answer, .iov_len = sizeof answer},
                               iovec{.iov_base = bytes.data(), .iov_len = bytes.size()}};
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    const ssize_t length = recvmsg(socket_, &message, MSG_DONTWAIT);
    if (length == 0 || (length < 0 && errno != EAGAIN && errno != EINTR)) has_ended_ = true;
    if (length < static_cast<ssize_t>(sizeof answer)) return std::nullopt;
    return std::pair(answer, std::string(bytes.data(), static_cast<std::size_t>(length) - sizeof answer));
}

}  // namespace nezumi::hw
