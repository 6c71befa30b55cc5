// Makes a component that runs a script, from an entry of a system file.
#include "bindings/lua/script/behavior_maker.hpp"

#include "bindings/lua/files/message_file.hpp"

namespace nezumi {

ModuleFinder modules_of(const Project& project) {
    return [project](std::string_view name, std::string_view from) -> Expected<SourceText> {
        auto path = project.find(FileKind::module, name, std::string(from));
        if (!path) return Unexpected(path.error());
        return project.read_source(path->string());
    };
}

MessageFinder messages_of(const Project& project) {
    return [project](std::string_view name, std::string_view from, std::vector<SourceText>* read) {
        return MessageFiles(project, read_message_file).find(name, from, read);
    };
}

ParameterValues values_at_start(const BehaviorEntry& entry) {
    ParameterValues values = entry.config;
    if (const auto set = entry.sets.find(entry.set); set != entry.sets.end()) {
        for (const auto& [name, value] : set->second) values.insert_or_assign(name, value);
    }
    return values;
}

Expected<std::unique_ptr<ScriptComponent>> make_behavior(const BehaviorEntry& entry, const MakerContext& context,
                                                         const BehaviorSettings& settings) {
    auto source = settings.project.read_source(entry.path);
    if (!source) return Unexpected(source.error());
    ScriptContext script{.component = entry.name,
                         .seed = context.seed,
                         .budget = settings.budget,
                         .memory_limit = settings.memory_limit,
                         .find_module = modules_of(settings.project),
                         .find_message = messages_of(settings.project),
                         .chunks = settings.chunks,
                         .configured = values_at_start(entry),
                         .tick_rate = context.tick_rate};
    return ScriptComponent::load(entry.name, *source, std::move(script));
}

}  // namespace nezumi
