// A transport whose messages only those can write and read who have a secret.
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

/// A key that hosts share.
using Secret = std::array<std::uint8_t, 32>;

/// A new one.
Secret make_secret();
/// As the text of a file, and from one; the error says what is wrong with it.
std::string secret_text(const Secret& secret);
Expected<Secret> secret_from(std::string_view text);
/// The one in a file, which nobody else may read; "": there is no such file. The error calls it as it was `said`.
Expected<Secret> read_secret(const std::string& said, const std::string& file);

/// Encrypted and authenticated for this topic alone (XChaCha20-Poly1305 of libsodium), as CDR with its header.
Octets seal(std::span<const std::uint8_t> cdr, const Topic& topic, const Secret& secret);
/// What `seal` was given; nothing when it was not sealed for this topic with this secret.
std::optional<Octets> unseal(std::span<const std::uint8_t> sealed, const Topic& topic, const Secret& secret);

/// The name of a topic whose messages are sealed: hosts with a secret and those without one do not hear each other.
std::string sealed_name(std::string_view topic);

/// `inner` must outlive it, and it its readers. What can't be unsealed is dropped as it comes. That a message comes
/// again is for who reads to see: heads have numbers.
std::unique_ptr<DdsTransport> make_sealed_transport(DdsTransport& inner, const Secret& secret);

}  // namespace nezumi::dds
