// The secret shared by the hosts of one user on one computer, without configuration.
#pragma once

#include <filesystem>

#include "bindings/dds/sealed_transport.hpp"

namespace nezumi::dds {

/// "network.secret" in `state_folder()`; empty if there is no such folder.
std::filesystem::path user_secret_file();
/// Reads the secret from this file; makes the file if it is missing. Two processes that make it at the same time get
/// the same secret. An error says what to do without a secret.
Expected<Secret> user_secret(const std::filesystem::path& file = user_secret_file());

}  // namespace nezumi::dds
