// Writers and readers without a network.
#include "bindings/dds/silent_transport.hpp"

namespace nezumi::dds {
namespace {

class SilentWriter final : public Writer {
public:
    bool write(std::span<const std::uint8_t> /*cdr*/) override { return true; }
    int readers() const override { return 0; }
};

class SilentReader final : public Reader {
public:
    std::vector<TopicSample> take() override { return {}; }
    std::vector<std::uint64_t> writers() const override { return {}; }
    std::uint64_t lost() const override { return 0; }
};

class SilentTransport final : public DdsTransport {
public:
    std::unique_ptr<Writer> write(const Topic& /*topic*/) override { return std::make_unique<SilentWriter>(); }
    std::unique_ptr<Reader> read(const Topic& /*topic*/) override { return std::make_unique<SilentReader>(); }
    std::vector<SeenEndpoint> seen() override { return {}; }
    std::string problem() const override { return ""; }
};

}  // namespace

std::unique_ptr<DdsTransport> make_silent_transport() { return std::make_unique<SilentTransport>(); }

}  // namespace nezumi::dds
