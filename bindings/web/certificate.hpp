// The certificate for serving the page to other computers: a module with OpenSSL, loaded on demand.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/error.hpp"

namespace nezumi::web {

/// The properties of a certificate, and where it is stored.
struct CertificateRequest {
    std::filesystem::path folder{};  ///< a folder of the user; made if missing
    std::string address{};           ///< IPv4 address under which others reach this computer
    std::string host{};              ///< this computer's name; optional
};

struct Certificate {
    std::string file{};         ///< PEM
    std::string key{};          ///< PEM, readable only by its owner
    std::string fingerprint{};  ///< SHA-256, "AB:CD:..."; the user compares it with the one that the browser shows
    bool is_new = false;        ///< made by this call (self-signed), not found
};

/// Returns the stored certificate, or makes a new one: if there is none, if it is for another address, if it ends
/// within a month, or if others could have read its key. An error gives the reason in one line.
Expected<Certificate> find_certificate(const CertificateRequest& request);

// The interface between the program and its module. Both are built together.
inline constexpr const char* certificate_module = "nezumi_certificate.so";
inline constexpr const char* find_in_module = "nezumi_find_certificate";
/// The only function that the module exports. Returns true, or sets `problem` and returns false. Never throws.
using FindInModule = bool(const CertificateRequest& request, Certificate& certificate, std::string& problem);

}  // namespace nezumi::web
