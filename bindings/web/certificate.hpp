// The certificate with which the page is served to other computers: a module with OpenSSL, loaded when that is wanted.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/error.hpp"

namespace nezumi::web {

/// For whom it is to be, and where it is kept.
struct CertificateWish {
    std::filesystem::path folder{};  ///< of the user's own, made when it is not there
    std::string address{};           ///< IPv4, by which others reach this computer
    std::string host{};              ///< this computer's name; may be empty
};

struct Certificate {
    std::string file{};         ///< PEM
    std::string key{};          ///< PEM, for its owner alone
    std::string fingerprint{};  ///< SHA-256, "AB:CD:...": what a browser shows to be compared
    bool is_new = false;        ///< made just now, signed by nobody but itself
};

/// The one that is kept there, or a new one: when none is, when it is not for this address, when it ends within a
/// month, or when others could have read its key. The error says in one line why there is none.
Expected<Certificate> find_certificate(const CertificateWish& wish);

// What the program and its module know of each other: they are built together.
inline constexpr const char* certificate_module = "nezumi_certificate.so";
inline constexpr const char* find_in_module = "nezumi_find_certificate";
/// The module's one function: whether it went well, or else the `problem`. It throws nothing.
using FindInModule = bool(const CertificateWish& wish, Certificate& certificate, std::string& problem);

}  // namespace nezumi::web
