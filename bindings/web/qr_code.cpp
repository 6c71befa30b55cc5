// Loads the module with libqrencode.
#include "bindings/web/qr_code.hpp"

#include "engine/base/module.hpp"

namespace nezumi::web {

Expected<std::string> qr_code(const std::string& text) {
    static const auto draws =
        load_function({.file = qr_module, .function = draw_in_module, .part = "QR codes", .needs = "libqrencode4"});
    if (!draws) return failure(draws.error().message);
    std::string lines;
    std::string problem;
    if (!reinterpret_cast<DrawInModule*>(*draws)(text, lines, problem)) return failure(problem);
    return lines;
}

}  // namespace nezumi::web
