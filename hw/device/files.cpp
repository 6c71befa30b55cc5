// System calls, repeated after an interruption by a signal.
#include "hw/device/files.hpp"

#include <fcntl.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace nezumi::hw {
namespace {

template <class Call>
Answer<std::size_t> answer_of(Call call) {
    for (;;) {
        const auto result = call();
        if (result >= 0) return static_cast<std::size_t>(result);
        if (errno != EINTR) return tl::unexpected(errno);
    }
}

class KernelFile final : public OpenFile {
public:
    KernelFile(int file, bool is_plain) : file_(file), is_plain_(is_plain) {}
    ~KernelFile() override { close(file_); }
    KernelFile(const KernelFile&) = delete;
    KernelFile& operator=(const KernelFile&) = delete;

    Answer<std::size_t> read(std::span<char> buffer) override {
        return answer_of([&] { return pread(file_, buffer.data(), buffer.size(), 0); });
    }
    Answer<std::size_t> write(std::string_view text) override {
        if (is_plain_ && ftruncate(file_, 0) != 0) return tl::unexpected(errno);
        return answer_of([&] {
            return is_plain_ ? pwrite(file_, text.data(), text.size(), 0) : ::write(file_, text.data(), text.size());
        });
    }
    Answer<std::size_t> keys(std::span<char> down) override {
        return answer_of([&] { return ioctl(file_, EVIOCGKEY(down.size()), down.data()); });
    }
    int descriptor() const override { return file_; }

private:
    const int file_;
    const bool is_plain_;
};

class KernelFiles final : public DeviceFiles {
public:
    Answer<std::unique_ptr<OpenFile>> open(const std::string& path, Access access) override {
        const int flags = (access == Access::read ? O_RDONLY : O_WRONLY) | O_CLOEXEC | O_NOCTTY;
        const auto opened = answer_of([&] { return ::open(path.c_str(), flags); });
        if (!opened) return tl::unexpected(opened.error());
        const int file = static_cast<int>(*opened);
        struct stat status {};
        const int problem = fstat(file, &status) != 0 ? errno : S_ISDIR(status.st_mode) ? EISDIR : 0;
        auto made = std::make_unique<KernelFile>(file, S_ISREG(status.st_mode));
        if (problem != 0) return tl::unexpected(problem);
        return made;
    }
    Answer<std::vector<std::string>> list(const std::string& folder) override {
        std::vector<std::string> names;
        std::error_code error;
        std::filesystem::directory_iterator entry(folder, error);
        if (error) return tl::unexpected(error.value());
        for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
            names.push_back(entry->path().filename().string());
        return names;
    }
};

}  // namespace

std::shared_ptr<DeviceFiles> kernel_files() { return std::make_shared<KernelFiles>(); }

}  // namespace nezumi::hw
