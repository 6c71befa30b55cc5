// A transport whose messages only holders of a secret can write and read.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bindings/dds/transport.hpp"
#include "engine/base/error.hpp"

namespace nezumi::dds {

/// A key shared by hosts.
using Secret = std::array<std::uint8_t, 32>;

/// Makes a new secret.
Secret make_secret();
/// Converts to the text of a file and back. An error gives the reason.
std::string secret_text(const Secret& secret);
Expected<Secret> secret_from(std::string_view text);
/// Reads the secret from a file, which other users must not be able to read. `file`: its path, "" if it was not found.
/// `said`: the name of the file in errors.
Expected<Secret> read_secret(const std::string& said, const std::string& file);

/// Encrypts and authenticates for this topic only (XChaCha20-Poly1305 of libsodium); `cdr` has its header.
Octets seal(std::span<const std::uint8_t> cdr, const Topic& topic, const Secret& secret);
/// The reverse of `seal`; nothing if it was not sealed for this topic with this secret.
std::optional<Octets> unseal(std::span<const std::uint8_t> sealed, const Topic& topic, const Secret& secret);

/// The name of an encrypted topic: hosts with and without a secret don't receive each other's messages.
std::string sealed_name(std::string_view topic);

/// `inner` must outlive this object, which must outlive its readers. Messages that can't be decrypted are dropped on
/// arrival. Repeated messages must be detected by the reader: heads have numbers.
std::unique_ptr<DdsTransport> make_sealed_transport(DdsTransport& inner, const Secret& secret);

}  // namespace nezumi::dds
