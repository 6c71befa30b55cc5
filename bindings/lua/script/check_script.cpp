// Reading finds every slip at once; loading finds the rest, one at a time.
#include "bindings/lua/script/check_script.hpp"

namespace nezumi {

std::vector<Error> check_behavior(const SourceText& source, const ScriptContext& context) {
    if (auto chunk = compile_script(source, ScriptKind::component); !chunk) return std::move(chunk.error());
    if (auto script = Script::load(source, context); !script) return {std::move(script.error())};
    return {};
}

std::vector<Error> check_module(const SourceText& source) {
    auto chunk = compile_script(source, ScriptKind::module);
    return chunk ? std::vector<Error>() : std::move(chunk.error());
}

}  // namespace nezumi
