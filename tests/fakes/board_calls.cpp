// Preloaded into a program, it leads the system calls of I2C, SPI and GPIO to a fake board: what the program asks the
// kernel for is what the board gets, to the last field. A node is a socket of the board; all others are the kernel's.
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <linux/i2c-dev.h>
#include <linux/i2c.h>
#include <linux/spi/spidev.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>

#include "tests/fakes/board_protocol.hpp"

using namespace nezumi::hw;

namespace {

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_on_board(const char* path) {
    const char* board = getenv("NEZUMI_FAKE_BOARD");
    struct stat status {};
    return board != nullptr && std::strncmp(path, board, std::strlen(board)) == 0 &&
           next<int(const char*, struct stat*)>("stat")(path, &status) == 0 && S_ISSOCK(status.st_mode);
}

int connect_to(const char* path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path, sizeof address.sun_path - 1);
    const int file = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    if (file < 0 || connect(file, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return file;
    close(file);
    errno = ENODEV;
    return -1;
}

// A packet that is put together without allocating: the writer's process calls it.
struct Packet {
    std::array<char, 16384> bytes;
    std::size_t size = 0;

    void add(const void* from, std::size_t count) {
        if (size + count > bytes.size()) abort();
        std::memcpy(bytes.data() + size, from, count);
        size += count;
    }
};

void send_packet(int socket, const Packet& packet, int passed) {
    iovec part{.iov_base = const_cast<char*>(packet.bytes.data()), .iov_len = packet.size};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> extra{};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = extra.data();
    message.msg_controllen = extra.size();
    cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof passed);
    std::memcpy(CMSG_DATA(header), &passed, sizeof passed);
    sendmsg(socket, &message, MSG_NOSIGNAL);
}

// The answer's bytes come to `packet`; its descriptor, or -1, to `passed`.
BoardAnswer receive(int socket, Packet& packet, int& passed) {
    BoardAnswer answer;
    std::array<iovec, 2> parts{iovec{.iov_base = &answer, .iov_len = sizeof answer},
                               iovec{.iov_base = packet.bytes.data(), .iov_len = packet.bytes.size()}};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> extra{};
    msghdr message{};
    message.msg_iov = parts.data();
    message.msg_iovlen = parts.size();
    message.msg_control = extra.data();
    message.msg_controllen = extra.size();
    passed = -1;
    if (recvmsg(socket, &message, MSG_CMSG_CLOEXEC) < static_cast<ssize_t>(sizeof answer)) return {-1, ENODEV};
    if (const cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr)
        std::memcpy(&passed, CMSG_DATA(header), sizeof passed);
    return answer;
}

// Asks the board. The answer's bytes come to `packet`.
BoardAnswer ask(int board, Packet& packet, int& passed) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) abort();
    send_packet(board, packet, ends[1]);
    close(ends[1]);
    const BoardAnswer answer = receive(ends[0], packet, passed);
    close(ends[0]);
    errno = answer.error;
    return answer;
}

int transfer_i2c(int board, const i2c_rdwr_ioctl_data& all) {
    Packet packet;
    const BoardCall call{.request = I2C_RDWR, .argument = 0, .messages = all.nmsgs};
    packet.add(&call, sizeof call);
    for (std::uint32_t i = 0; i < all.nmsgs; ++i) {
        const i2c_msg& each = all.msgs[i];
        const bool reads = (each.flags & I2C_M_RD) != 0;
        const BoardMessage message{
            .size = each.len, .speed = 0, .address = each.addr, .reads = reads, .writes = !reads};
        packet.add(&message, sizeof message);
        if (!reads) packet.add(each.buf, each.len);
    }
    int passed = -1;
    const BoardAnswer answer = ask(board, packet, passed);
    const char* read = packet.bytes.data();
    for (std::uint32_t i = 0; answer.result >= 0 && i < all.nmsgs; ++i) {
        if ((all.msgs[i].flags & I2C_M_RD) == 0) continue;
        std::memcpy(all.msgs[i].buf, read, all.msgs[i].len);
        read += all.msgs[i].len;
    }
    return answer.result;
}

int transfer_spi(int board, unsigned long request, const spi_ioc_transfer* transfers) {
    Packet packet;
    const std::uint32_t count = _IOC_SIZE(request) / sizeof(spi_ioc_transfer);
    const BoardCall call{.request = SPI_IOC_MESSAGE(1), .argument = 0, .messages = count};
    packet.add(&call, sizeof call);
    for (std::uint32_t i = 0; i < count; ++i) {
        const spi_ioc_transfer& each = transfers[i];
        const BoardMessage message{.size = each.len,
                                   .speed = each.speed_hz,
                                   .address = 0,
                                   .reads = each.rx_buf != 0,
                                   .writes = each.tx_buf != 0};
        packet.add(&message, sizeof message);
        if (each.tx_buf != 0) packet.add(reinterpret_cast<const void*>(each.tx_buf), each.len);
    }
    int passed = -1;
    const BoardAnswer answer = ask(board, packet, passed);
    const char* read = packet.bytes.data();
    for (std::uint32_t i = 0; answer.result >= 0 && i < count; ++i) {
        if (transfers[i].rx_buf == 0) continue;
        std::memcpy(reinterpret_cast<void*>(transfers[i].rx_buf), read, transfers[i].len);
        read += transfers[i].len;
    }
    return answer.result;
}

// An ioctl whose argument has its whole content: of GPIO, and settings of SPI.
int plain_call(int board, unsigned long request, void* argument) {
    Packet packet;
    const BoardCall call{.request = request, .argument = 0, .messages = 0};
    packet.add(&call, sizeof call);
    packet.add(argument, _IOC_SIZE(request));
    int passed = -1;
    const BoardAnswer answer = ask(board, packet, passed);
    if (answer.result >= 0 && (_IOC_DIR(request) & _IOC_READ) != 0)
        std::memcpy(argument, packet.bytes.data(), _IOC_SIZE(request));
    if (passed >= 0) static_cast<gpio_v2_line_request*>(argument)->fd = passed;
    return answer.result;
}

int claim(int board, std::uint64_t address) {
    Packet packet;
    const BoardCall call{.request = I2C_SLAVE, .argument = address, .messages = 0};
    packet.add(&call, sizeof call);
    int passed = -1;
    return ask(board, packet, passed).result;
}

}  // namespace

extern "C" {

int stat(const char* path, struct stat* status) noexcept {
    const int result = next<int(const char*, struct stat*)>("stat")(path, status);
    if (result != 0 || !is_on_board(path)) return result;
    const char* name = std::strrchr(path, '/') + 1;
    status->st_mode = S_IFCHR | 0660;
    status->st_rdev = makedev(name[0] == 'i' ? 89 : name[0] == 's' ? 153 : 254, 0);
    return 0;
}

int open(const char* path, int flags, ...) {
    if (is_on_board(path)) return connect_to(path);
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return next<int(const char*, int, ...)>("open")(path, flags, mode);
}

int ioctl(int file, unsigned long request, ...) noexcept {
    va_list more;
    va_start(more, request);
    void* argument = va_arg(more, void*);
    va_end(more);
    if (request == I2C_RDWR) return transfer_i2c(file, *static_cast<i2c_rdwr_ioctl_data*>(argument));
    if (request == I2C_SLAVE) return claim(file, reinterpret_cast<std::uint64_t>(argument));
    if (_IOC_TYPE(request) == SPI_IOC_MAGIC && _IOC_NR(request) == 0)
        return transfer_spi(file, request, static_cast<const spi_ioc_transfer*>(argument));
    if (_IOC_TYPE(request) == SPI_IOC_MAGIC || _IOC_TYPE(request) == 0xB4) return plain_call(file, request, argument);
    return next<int(int, unsigned long, ...)>("ioctl")(file, request, argument);
}
}
