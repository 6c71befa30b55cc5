// In place of certificate.cpp and qr_code.cpp in a static program, which can load no module.
#include "bindings/web/certificate.hpp"
#include "bindings/web/qr_code.hpp"

namespace nezumi::web {

Expected<Certificate> find_certificate(const CertificateWish& /*wish*/) {
    return failure("this nezumi is one static program, without the part that makes certificates");
}

Expected<std::string> qr_code(const std::string& /*text*/) {
    return failure("this nezumi is one static program, without the part that draws QR codes");
}

}  // namespace nezumi::web
