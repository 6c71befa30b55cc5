// Checks the file of a behaviour. Three steps: reading the text, loading its declarations, and checking the use of
// parameters.
#include "bindings/lua/script/check_script.hpp"

namespace nezumi {
std::vector<Error> check_behavior(const SourceText& source, const ScriptContext& context) {
    if (auto code = compile_script(source, ScriptKind::component); !code) return std::move(code.error());
    std::vector<Error> diagnostics;
    ScriptContext collecting = context;
    collecting.diagnostics = &diagnostics;
    auto script = Script::load(source, std::move(collecting));
    // An error that ends loading may be a result of a wrong declaration, so it is not reported then.
    if (!diagnostics.empty()) return diagnostics;
    if (!script) return {std::move(script.error())};
    return {};
}

std::vector<Error> check_module(const SourceText& source) {
    auto code = compile_script(source, ScriptKind::module);
    return code ? std::vector<Error>() : std::move(code.error());
}

}  // namespace nezumi
