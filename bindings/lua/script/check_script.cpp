// Reading finds every slip of the text at once, then loading those of the declarations.
#include "bindings/lua/script/check_script.hpp"

namespace nezumi {

std::vector<Error> check_behavior(const SourceText& source, const ScriptContext& context) {
    if (auto chunk = compile_script(source, ScriptKind::component); !chunk) return std::move(chunk.error());
    std::vector<Error> slips;
    ScriptContext collecting = context;
    collecting.slips = &slips;
    auto script = Script::load(source, std::move(collecting));
    // What ends the loading after a slip may well follow from it.
    if (!script && slips.empty()) return {std::move(script.error())};
    return slips;
}

std::vector<Error> check_module(const SourceText& source) {
    auto chunk = compile_script(source, ScriptKind::module);
    return chunk ? std::vector<Error>() : std::move(chunk.error());
}

}  // namespace nezumi
