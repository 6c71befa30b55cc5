// Reads until nothing is left.
#include "hw/wire/stream_wire.hpp"

#include <unistd.h>

#include <cerrno>
#include <utility>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

class StreamWire final : public OpenWire {
public:
    StreamWire(Descriptor file, const Framing& framing) : file_(std::move(file)), framer_(framing) {}

    tl::expected<double, int> read(std::vector<Arrived>& arrived) override {
        char buffer[4096];
        for (;;) {
            const ssize_t length = ::read(file_.get(), buffer, sizeof buffer);
            if (length < 0 && errno == EINTR) continue;
            if (length < 0 && errno == EAGAIN) return quiet;
            // A terminal whose other end is gone gives EIO.
            if (length <= 0) return tl::unexpected(length == 0 || errno == EIO ? 0 : errno);
            const double now = clock_seconds();
            for (std::string& message : framer_.take({buffer, static_cast<std::size_t>(length)}))
                arrived.push_back({now, std::move(message)});
        }
    }
    int watched_file() const override { return file_.get(); }
    WriteTarget target() const override { return {.by = WriteBy::stream, .file = file_.get()}; }

private:
    static constexpr double quiet = 0.5;  // [s] between looks at a device that sends nothing

    Descriptor file_;
    Framer framer_;
};

}  // namespace

std::unique_ptr<OpenWire> stream_wire(Descriptor file, const Framing& framing) {
    return std::make_unique<StreamWire>(std::move(file), framing);
}

}  // namespace nezumi::hw
