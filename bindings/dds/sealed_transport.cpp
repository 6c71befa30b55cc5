// A sealed message is a random nonce of 24 bytes, then the ciphertext with its tag. The topic's name and type are
// authenticated too.
#include "bindings/dds/sealed_transport.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <atomic>
#include <filesystem>
#include <system_error>
#include <utility>

#include "bindings/dds/wire.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::dds {
namespace {

constexpr std::size_t nonce_size = crypto_aead_xchacha20poly1305_ietf_NPUBBYTES;
constexpr std::size_t tag_size = crypto_aead_xchacha20poly1305_ietf_ABYTES;
constexpr std::string_view title = "nezumi secret 1";

static_assert(std::tuple_size_v<Secret> == crypto_aead_xchacha20poly1305_ietf_KEYBYTES);

std::string place_of(const Topic& topic) { return topic.name + '\n' + topic.type; }

const unsigned char* bytes_of(const std::string& text) { return reinterpret_cast<const unsigned char*>(text.data()); }

// Decrypts a message into `cdr`; with nullptr only tests whether that is possible.
bool open(unsigned char* cdr, const Octets& box, const Topic& topic, const Secret& secret) {
    if (box.size() < nonce_size + tag_size) return false;
    const std::string place = place_of(topic);
    return crypto_aead_xchacha20poly1305_ietf_decrypt(cdr, nullptr, nullptr, box.data() + nonce_size,
                                                      box.size() - nonce_size, bytes_of(place), place.size(),
                                                      box.data(), secret.data()) == 0;
}

bool is_sealed(std::span<const std::uint8_t> sealed, const Topic& topic, const Secret& secret) {
    Octets box;
    return read_cdr(sealed, on_the_wire, box) && open(nullptr, box, topic, secret);
}

class SealedWriter final : public Writer {
public:
    SealedWriter(std::unique_ptr<Writer> inner, Topic topic, const Secret& secret)
        : inner_(std::move(inner)), topic_(std::move(topic)), secret_(secret) {}
    bool write(std::span<const std::uint8_t> cdr) override { return inner_->write(seal(cdr, topic_, secret_)); }
    int readers() const override { return inner_->readers(); }

private:
    std::unique_ptr<Writer> inner_;
    Topic topic_;
    const Secret& secret_;
};

class SealedReader final : public Reader {
public:
    SealedReader(std::unique_ptr<Reader> inner, Topic topic, const Secret& secret)
        : inner_(std::move(inner)), topic_(std::move(topic)), secret_(secret) {}
    std::vector<TopicSample> take() override {
        std::vector<TopicSample> all;
        for (const TopicSample& sample : inner_->take()) {
            if (auto bytes = unseal(sample.bytes, topic_, secret_)) all.push_back({std::move(*bytes), sample.writer});
        }
        return all;
    }
    std::vector<std::uint64_t> writers() const override { return inner_->writers(); }
    int file() const override { return inner_->file(); }
    std::uint64_t lost() const override { return inner_->lost(); }

private:
    std::unique_ptr<Reader> inner_;
    Topic topic_;
    const Secret& secret_;
};

class SealedTransport final : public DdsTransport {
public:
    SealedTransport(DdsTransport& inner, const Secret& secret) : inner_(inner), secret_(secret) {
        // A failure means that there are no random numbers; then the first nonce aborts the program.
        [[maybe_unused]] const int begun = sodium_init();
    }
    ~SealedTransport() override { sodium_memzero(secret_.data(), secret_.size()); }
    SealedTransport(const SealedTransport&) = delete;
    SealedTransport& operator=(const SealedTransport&) = delete;

    std::unique_ptr<Writer> write(const Topic& topic) override {
        auto made = inner_.write(sealed(topic));
        return made != nullptr ? std::make_unique<SealedWriter>(std::move(made), topic, secret_) : nullptr;
    }
    std::unique_ptr<Reader> read(const Topic& topic) override {
        // A sender without the secret may send any amount: this must not displace waiting messages.
        Topic its = sealed(topic);
        its.admits = [this, topic](std::span<const std::uint8_t> bytes) {
            const bool is_ours = is_sealed(bytes, topic, secret_);
            if (!is_ours) ++strange_;
            return is_ours;
        };
        auto made = inner_.read(its);
        return made != nullptr ? std::make_unique<SealedReader>(std::move(made), topic, secret_) : nullptr;
    }
    std::vector<SeenEndpoint> seen() override { return inner_.seen(); }
    std::string problem() const override { return inner_.problem(); }
    std::uint64_t strange() const override { return strange_; }

private:
    static Topic sealed(Topic topic) {
        topic.name = sealed_name(topic.name);
        topic.type = "nezumi::Sealed";
        return topic;
    }

    DdsTransport& inner_;
    Secret secret_;
    std::atomic<std::uint64_t> strange_ = 0;
};

}  // namespace

Secret make_secret() {
    Secret secret{};
    randombytes_buf(secret.data(), secret.size());
    return secret;
}

std::string secret_text(const Secret& secret) {
    std::string text(sodium_base64_ENCODED_LEN(std::tuple_size_v<Secret>, sodium_base64_VARIANT_ORIGINAL), '\0');
    sodium_bin2base64(text.data(), text.size(), secret.data(), secret.size(), sodium_base64_VARIANT_ORIGINAL);
    text.pop_back();  // the final 0
    return fmt::format("{}\n{}\n", title, text);
}

Expected<Secret> secret_from(std::string_view text) {
    const auto refuse = [] {
        return failure("is not valid: make one with `nezumi network secret FILE`, and copy it to each host");
    };
    if (!text.starts_with(title)) return refuse();
    text.remove_prefix(title.size());
    Secret secret{};
    std::size_t size = 0;
    const int read = sodium_base642bin(secret.data(), secret.size(), text.data(), text.size(), "\r\n ", &size, nullptr,
                                       sodium_base64_VARIANT_ORIGINAL);
    if (read != 0 || size != secret.size()) return refuse();
    return secret;
}

Expected<Secret> read_secret(const std::string& said, const std::string& file) {
    const auto refuse = [&](const std::string& why) {
        return failure(fmt::format("the secret '{}' {}", shown(said), why));
    };
    std::error_code none;
    using std::filesystem::perms;
    const auto status = std::filesystem::status(file, none);
    if (!std::filesystem::exists(status))
        return refuse("does not exist: `nezumi network secret FILE` makes one, to be copied to each host");
    // Anyone who can read this file can drive the robots.
    if ((status.permissions() & (perms::group_read | perms::others_read)) != perms::none)
        return refuse(fmt::format("can be read by others: chmod 600 {}", file));
    const auto text = read_whole(file, file);
    if (!text) return refuse(text.error().message);
    auto secret = secret_from(*text);
    if (!secret) return refuse(secret.error().message);
    return secret;
}

std::string sealed_name(std::string_view topic) { return fmt::format("sealed/{}", topic); }

Octets seal(std::span<const std::uint8_t> cdr, const Topic& topic, const Secret& secret) {
    const std::string place = place_of(topic);
    Octets box(nonce_size + cdr.size() + tag_size);
    randombytes_buf(box.data(), nonce_size);
    crypto_aead_xchacha20poly1305_ietf_encrypt(box.data() + nonce_size, nullptr, cdr.data(), cdr.size(),
                                               bytes_of(place), place.size(), nullptr, box.data(), secret.data());
    Octets bytes;
    write_cdr(bytes, on_the_wire, box);
    return bytes;
}

std::optional<Octets> unseal(std::span<const std::uint8_t> sealed, const Topic& topic, const Secret& secret) {
    Octets box;
    if (!read_cdr(sealed, on_the_wire, box) || box.size() < nonce_size + tag_size) return std::nullopt;
    Octets cdr(box.size() - nonce_size - tag_size);
    if (!open(cdr.data(), box, topic, secret)) return std::nullopt;
    return cdr;
}

std::unique_ptr<DdsTransport> make_sealed_transport(DdsTransport& inner, const Secret& secret) {
    return std::make_unique<SealedTransport>(inner, secret);
}

}  // namespace nezumi::dds
