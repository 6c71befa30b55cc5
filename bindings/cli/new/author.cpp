// Uses the same places as `nezumi new`.
#include "bindings/cli/new/author.hpp"

#include <system_error>

#include "bindings/cli/new/behavior.hpp"
#include "bindings/cli/new/files.hpp"

namespace nezumi::cli {

Expected<std::vector<std::string>> write_new_behavior(const std::filesystem::path& root,
                                                      const BehaviorRequest& request) {
    const auto texts = write_behavior({.name = request.name,
                                       .inputs = request.inputs,
                                       .outputs = request.outputs,
                                       .parameters = request.parameters,
                                       .callbacks = request.callbacks,
                                       .doc = request.doc});
    if (!texts) return Unexpected(texts.error());
    std::error_code none;
    const bool has_scenarios = std::filesystem::is_directory(root / "tests/scenarios", none);
    const std::filesystem::path behavior = std::filesystem::path("behaviors") / (texts->name + ".lua");
    const std::filesystem::path scenario =
        std::filesystem::path(has_scenarios ? "tests/scenarios" : "tests") / (texts->name + "_test.lua");
    const auto written = write_new_files({{root / behavior, texts->behavior}, {root / scenario, texts->scenario}});
    if (!written) return Unexpected(written.error());
    return std::vector<std::string>{behavior.string(), scenario.string()};
}

}  // namespace nezumi::cli
