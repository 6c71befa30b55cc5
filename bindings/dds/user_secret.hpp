// The secret shared by the hosts of one user on one computer, without configuration.
#pragma once

#include <filesystem>

#include "bindings/dds/sealed_transport.hpp"

namespace nezumi::dds {

/// "network.secret" in `state_folder()`; empty if there is no such folder.
std::filesystem::path user_secret_file();
/// Reads the secret of this file, or makes it. Two processes that make it at the same time get the same one. An error
/// says what to do without it.
Expected<Secret> user_secret(const std::filesystem::path& file = user_secret_file());

}  // namespace nezumi::dds
