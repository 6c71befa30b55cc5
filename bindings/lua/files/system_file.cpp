// Runs a system file with the words of systems.
#include "bindings/lua/files/system_file.hpp"

#include <utility>

#include "bindings/lua/files/calibration_file.hpp"
#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/system_lua.hpp"
#include "bindings/lua/files/system_words.hpp"

namespace nezumi {

namespace {

// Reads a text; if this fails, `errors` gets all mistakes.
Expected<SystemSpec> read(std::string_view text, const std::string& shown, const Project& project,
                          const SystemFileOptions& options, std::vector<Error>& errors) {
    auto file = DataFile::create(project, {.budget = {options.seconds}, .seed = options.seed, .print = options.print});
    if (!file) return Unexpected(file.error());
    SystemWords words(project, options.peer_words);
    words.spec().file = shown;
    words.note_file(shown);
    words.give_arguments(options.set);
    WordHost host;
    host.words = &words;
    host.all = system_words(options.peer_words);
    host.source = [&](const std::string& name) { return (*file)->source(name); };
    host.fail = [&](Error error) { return (*file)->fail(std::move(error)); };

    std::vector<DataFile::Global> functions;
    for (const SystemWord& word : host.all) functions.push_back({word.name, call_system_word, &host});
    if (auto ran = (*file)->run(text, shown, functions); !ran) {
        errors = (*file)->errors();
        return Unexpected(ran.error());
    }
    if (host.calls == 0) {
        return failure("the file declares nothing: expected robot, behavior, arena, connect ...", {shown});
    }
    if (auto ok = words.finish(options.is_part); !ok) return failure(one_line(ok.error().message), ok.error().place);
    if (auto ok = words.check_arguments(); !ok && !options.is_part) return Unexpected(ok.error());
    for (const std::string& module : (*file)->files()) words.note_file(module);
    if (auto used = use_asked_calibrations(words.spec(), project); !used) return Unexpected(used.error());
    for (const std::string& note : words.notes()) {
        if (options.print) options.print(note);
    }
    return std::move(words.spec());
}

}  // namespace

Expected<SystemSpec> read_system_text(std::string_view text, const std::string& shown, const Project& project,
                                      const SystemFileOptions& options) {
    std::vector<Error> errors;
    return read(text, shown, project, options, errors);
}

std::vector<Error> check_system_text(std::string_view text, const std::string& shown, const Project& project,
                                     const SystemFileOptions& options) {
    std::vector<Error> errors;
    const auto spec = read(text, shown, project, options, errors);
    if (!spec && errors.empty()) errors.push_back(spec.error());
    return errors;
}

Expected<SystemSpec> read_system_file(const std::filesystem::path& path, const Project& project,
                                      const SystemFileOptions& options) {
    const std::string shown = project.shown(path);
    const auto text = project.read(path);
    if (!text) return Unexpected(text.error());
    return read_system_text(*text, shown, project, options);
}

}  // namespace nezumi
