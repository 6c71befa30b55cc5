// Reading finds every diagnostic of the text at once, then loading those of the declarations, and then those of their
// uses.
#include "bindings/lua/script/check_script.hpp"

namespace nezumi {
std::vector<Error> check_behavior(const SourceText& source, const ScriptContext& context) {
    if (auto code = compile_script(source, ScriptKind::component); !code) return std::move(code.error());
    std::vector<Error> diagnostics;
    ScriptContext collecting = context;
    collecting.diagnostics = &diagnostics;
    auto script = Script::load(source, std::move(collecting));
    // What ends the loading after a diagnostic may well follow from it.
    if (!diagnostics.empty()) return diagnostics;
    if (!script) return {std::move(script.error())};
    return {};
}

std::vector<Error> check_module(const SourceText& source) {
    auto code = compile_script(source, ScriptKind::module);
    return code ? std::vector<Error>() : std::move(code.error());
}

}  // namespace nezumi
