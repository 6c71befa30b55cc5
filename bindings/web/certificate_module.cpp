// Certificates by OpenSSL: self-signed, with a key on the curve P-256.
#include <fcntl.h>
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "bindings/web/certificate.hpp"

namespace nezumi::web {
namespace {

constexpr long day = 24 * 60 * 60;     // [s]
constexpr long lasts = 800 * day;      // [s] browsers accept at most 825 days
constexpr long renewed_at = 30 * day;  // [s] before a certificate ends, a new one is made

template <class T, void (*release)(T*)>
struct Releaser {
    void operator()(T* owned) const { release(owned); }
};
using Key = std::unique_ptr<EVP_PKEY, Releaser<EVP_PKEY, EVP_PKEY_free>>;
using Paper = std::unique_ptr<X509, Releaser<X509, X509_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Releaser<X509_EXTENSION, X509_EXTENSION_free>>;
using Memory = std::unique_ptr<BIO, Releaser<BIO, BIO_free_all>>;

std::string fingerprint_of(const X509* paper) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned length = 0;
    if (X509_digest(paper, EVP_sha256(), digest.data(), &length) != 1) return "";
    std::string text;
    for (unsigned i = 0; i < length; ++i) {
        char byte[4];
        std::snprintf(byte, sizeof byte, "%s%02X", i > 0 ? ":" : "", digest[i]);
        text += byte;
    }
    return text;
}

std::string read_text(const std::string& file) {
    std::string text;
    const int opened = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (opened < 0) return text;
    std::array<char, 4096> piece{};
    for (ssize_t got = 0; (got = read(opened, piece.data(), piece.size())) > 0 && text.size() < 65536;)
        text.append(piece.data(), static_cast<std::size_t>(got));
    close(opened);
    return text;
}

Memory memory_of(const std::string& text) {
    return Memory(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

// True if the file belongs to this user and only this user may read it.
bool is_private(const std::string& file) {
    struct stat is {};
    return lstat(file.c_str(), &is) == 0 && S_ISREG(is.st_mode) && is.st_uid == geteuid() && (is.st_mode & 077) == 0;
}

// Uses the stored certificate if it is for the requested address and stays valid for more than `renewed_at`.
bool take_kept(const CertificateRequest& request, Certificate& certificate) {
    if (!is_private(certificate.key)) return false;
    const std::string paper_text = read_text(certificate.file), key_text = read_text(certificate.key);
    const Memory paper_memory = memory_of(paper_text), key_memory = memory_of(key_text);
    const Paper paper(PEM_read_bio_X509(paper_memory.get(), nullptr, nullptr, nullptr));
    const Key key(PEM_read_bio_PrivateKey(key_memory.get(), nullptr, nullptr, nullptr));
    if (paper == nullptr || key == nullptr || X509_check_private_key(paper.get(), key.get()) != 1) return false;
    std::time_t until = std::time(nullptr) + renewed_at;  // the wall clock: certificates have dates
    if (X509_cmp_time(X509_get0_notAfter(paper.get()), &until) <= 0) return false;
    if (X509_check_ip_asc(paper.get(), request.address.c_str(), 0) != 1) return false;
    certificate.fingerprint = fingerprint_of(paper.get());
    return !certificate.fingerprint.empty();
}

bool add_extension(X509* paper, int which, const std::string& value) {
    X509V3_CTX context;
    X509V3_set_ctx_nodb(&context);
    X509V3_set_ctx(&context, paper, paper, nullptr, nullptr, 0);
    const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, which, value.c_str()));
    return extension != nullptr && X509_add_ext(paper, extension.get(), -1) == 1;
}

// True for a host name that can be written into a certificate unchanged.
bool is_host_name(std::string_view name) {
    return !name.empty() && name.size() < 64 && std::all_of(name.begin(), name.end(), [](char each) {
        return (each >= 'a' && each <= 'z') || (each >= 'A' && each <= 'Z') || (each >= '0' && each <= '9') ||
               each == '-' || each == '.';
    });
}

Paper make_paper(EVP_PKEY* key, const CertificateRequest& request) {
    Paper paper(X509_new());
    if (paper == nullptr) return nullptr;
    const bool has_host = is_host_name(request.host);
    const std::string name = has_host ? "nezumi on " + request.host : "nezumi";
    std::array<unsigned char, 16> number{};
    if (RAND_bytes(number.data(), static_cast<int>(number.size())) != 1) return nullptr;
    number[0] &= 0x7f;  // makes the number positive
    X509* const x = paper.get();
    X509_NAME* const subject = X509_get_subject_name(x);
    const auto* const text = reinterpret_cast<const unsigned char*>(name.c_str());
    const std::unique_ptr<BIGNUM, Releaser<BIGNUM, BN_free>> serial(
        BN_bin2bn(number.data(), static_cast<int>(number.size()), nullptr));
    const bool made =
        serial != nullptr && X509_set_version(x, X509_VERSION_3) == 1 &&
        BN_to_ASN1_INTEGER(serial.get(), X509_get_serialNumber(x)) != nullptr &&
        X509_gmtime_adj(X509_getm_notBefore(x), -day) != nullptr &&
        X509_gmtime_adj(X509_getm_notAfter(x), lasts) != nullptr && X509_set_pubkey(x, key) == 1 &&
        X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, text, -1, -1, 0) == 1 &&
        X509_set_issuer_name(x, subject) == 1 &&
        add_extension(x, NID_subject_alt_name, "IP:" + request.address + (has_host ? ",DNS:" + request.host : "")) &&
        add_extension(x, NID_basic_constraints, "critical,CA:FALSE") &&
        add_extension(x, NID_key_usage, "critical,digitalSignature") &&
        add_extension(x, NID_ext_key_usage, "serverAuth") && X509_sign(x, key, EVP_sha256()) > 0;
    if (!made) paper.reset();
    return paper;
}

// Writes the output of `write` to a file that only its owner may read. Returns the error, or "".
template <class Write>
std::string write_file(const std::string& file, const Write& write) {
    const Memory memory(BIO_new(BIO_s_mem()));
    if (memory == nullptr || write(memory.get()) != 1) return "OpenSSL can't write a certificate";
    char* bytes = nullptr;
    const long size = BIO_get_mem_data(memory.get(), &bytes);
    const std::string beside = file + ".new";
    unlink(beside.c_str());
    const int opened = open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
    bool done = opened >= 0 && ::write(opened, bytes, static_cast<std::size_t>(size)) == size;
    int problem = errno;
    if (opened >= 0 && close(opened) != 0) done = false;
    if (done && rename(beside.c_str(), file.c_str()) == 0) return "";
    if (done) problem = errno;
    unlink(beside.c_str());
    return file + " can't be written: " + std::strerror(problem);
}

std::string make_new(const CertificateRequest& request, Certificate& certificate) {
    const Key key(EVP_EC_gen("P-256"));
    const Paper paper = key != nullptr ? make_paper(key.get(), request) : nullptr;
    if (paper == nullptr) return "OpenSSL can't make a certificate for '" + request.address + "'";
    std::error_code problem;
    std::filesystem::create_directories(request.folder, problem);
    if (problem) return request.folder.string() + " can't be made: " + problem.message();
    std::string wrong = write_file(certificate.key, [&](BIO* out) {
        return PEM_write_bio_PrivateKey(out, key.get(), nullptr, nullptr, 0, nullptr, nullptr);
    });
    if (wrong.empty())
        wrong = write_file(certificate.file, [&](BIO* out) { return PEM_write_bio_X509(out, paper.get()); });
    certificate.fingerprint = fingerprint_of(paper.get());
    certificate.is_new = true;
    return wrong;
}

}  // namespace
}  // namespace nezumi::web

extern "C" __attribute__((visibility("default"))) nezumi::web::FindInModule nezumi_find_certificate;

bool nezumi_find_certificate(const nezumi::web::CertificateRequest& request, nezumi::web::Certificate& certificate,
                             std::string& problem) {
    try {
        certificate = {.file = (request.folder / "page_certificate.pem").string(),
                       .key = (request.folder / "page_key.pem").string()};
        if (!nezumi::web::take_kept(request, certificate)) problem = nezumi::web::make_new(request, certificate);
    } catch (const std::exception& thrown) {
        problem = thrown.what();
    }
    return problem.empty();
}
