// Loads the module with OpenSSL.
#include "bindings/web/certificate.hpp"

#include "engine/base/module.hpp"

namespace nezumi::web {

Expected<Certificate> find_certificate(const CertificateRequest& request) {
    static const auto finds = load_function({.file = certificate_module,
                                             .function = find_in_module,
                                             .part = "certificates for browsers",
                                             .needs = "libssl3"});
    if (!finds) return failure(finds.error().message);
    Certificate certificate;
    std::string problem;
    if (!reinterpret_cast<FindInModule*>(*finds)(request, certificate, problem)) return failure(problem);
    return certificate;
}

}  // namespace nezumi::web
