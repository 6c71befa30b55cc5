// The secret that the hosts of one user share on one computer, without anything being said of it.
#pragma once

#include <filesystem>

#include "bindings/dds/sealed_transport.hpp"

namespace nezumi::dds {

/// "network.secret" in `state_folder()`; empty where there is none.
std::filesystem::path user_secret_file();
/// The secret in this file, which is made where there is none: of two processes that make it at once both have the
/// same. The error says what to do without it.
Expected<Secret> user_secret(const std::filesystem::path& file = user_secret_file());

}  // namespace nezumi::dds
