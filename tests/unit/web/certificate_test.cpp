// Certificates: stored while they are valid, readable only by the user.
#include "bindings/web/certificate.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>

#include "bindings/web/qr_code.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

Certificate find(const CertificateRequest& request) {
    const auto found = find_certificate(request);
    if (!found) FAIL(found.error().message);
    return *found;
}

unsigned mode_of(const std::string& file) {
    struct stat is {};
    REQUIRE(stat(file.c_str(), &is) == 0);
    return is.st_mode & 0777;
}

}  // namespace

TEST_CASE("a certificate is made once and stored only for its owner", "[web][certificate]") {
    const Scratch scratch;
    const CertificateRequest request{
        .folder = scratch.path("state/nezumi"), .address = "192.168.1.20", .host = "mouse"};
    const Certificate first = find(request);
    CHECK(first.is_new);
    CHECK(first.fingerprint.size() == 32 * 3 - 1);
    CHECK(first.fingerprint.find_first_not_of("0123456789ABCDEF:") == std::string::npos);
    CHECK(mode_of(first.key) == 0600);
    const Certificate again = find(request);
    CHECK_FALSE(again.is_new);
    CHECK(again.fingerprint == first.fingerprint);
    CHECK(again.file == first.file);
}

TEST_CASE("a certificate that is no longer valid is renewed", "[web][certificate]") {
    const Scratch scratch;
    CertificateRequest request{.folder = scratch.path(), .address = "192.168.1.20", .host = "a name, IP:1.2.3.4"};
    const Certificate first = find(request);
    CHECK(first.is_new);
    SECTION("for another address") { request.address = "192.168.1.21"; }
    SECTION("when others may have read its key") { chmod(first.key.c_str(), 0644); }
    SECTION("when its file is spoilt") { scratch.write("page_certificate.pem", "-----BEGIN CERTIFICATE-----\n"); }
    SECTION("when its key is another's") {
        const Scratch other;
        const Certificate foreign = find({.folder = other.path(), .address = request.address});
        std::ifstream in(foreign.key);
        const std::string key((std::istreambuf_iterator<char>(in)), {});
        scratch.write("page_key.pem", key);
    }
    const Certificate next = find(request);
    CHECK(next.is_new);
    CHECK(next.fingerprint != first.fingerprint);
    CHECK_FALSE(find(request).is_new);
}

TEST_CASE("a certificate that can't be stored is an error", "[web][certificate]") {
    const Scratch scratch;
    scratch.write("file", "");
    const auto none = find_certificate({.folder = scratch.path("file/nezumi"), .address = "192.168.1.20"});
    REQUIRE_FALSE(none);
    CHECK(none.error().message.find("can't be made: ") != std::string::npos);
}

TEST_CASE("an address is drawn as a QR code for a terminal of any colours", "[web][certificate]") {
    const std::string address = "https://192.168.1.20:8765/#0123456789abcdef0123456789abcdef";
    const auto code = qr_code(address);
    REQUIRE(code);
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = code->find('\n', at)) != std::string::npos; ++at) ++lines;
    CHECK(lines == (33 + 4 + 1) / 2);  // version 4: 33 modules, and two around
    CHECK(code->find("\033[38;5;16;48;5;231m") == 0);
    CHECK(code->find("\u2588") != std::string::npos);
    CHECK(*qr_code(address) == *code);
    CHECK_FALSE(qr_code(std::string(4000, 'x')));
}
