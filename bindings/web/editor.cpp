// Checks run as processes of their own, with low priority: a wrong text can't disturb the running system.
#include "bindings/web/editor.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "engine/base/json_text.hpp"
#include "engine/base/program.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

Json refused_edit(const Error& error) { return {{"ok", false}, {"text", describe(error)}}; }

Json list_files(const Project& project, const EditedFiles& files, const EditorOptions& options) {
    Json list = Json::array();
    for (const std::string& name : files.names()) {
        const std::filesystem::path path = files.folder() / name;
        std::string kind;
        if (options.kind) {
            if (const auto text = files.read(name)) kind = options.kind(path, text->text);
        }
        list.push_back({{"file", name}, {"shown", project.shown(path)}, {"kind", kind}});
    }
    return {{"ok", true}, {"text", ""}, {"files", std::move(list)}};
}

Json read_edited(const EditedFiles& files, const EditMessage& message) {
    const auto found = files.read(message.file);
    if (!found) return refused_edit(found.error());
    return {{"ok", true}, {"text", ""}, {"content", found->text}, {"mark", found->mark}};
}

Json save_edited(const EditedFiles& files, const EditMessage& message) {
    const auto saved = files.write(message.file, message.text, message.mark);
    if (!saved) return refused_edit(saved.error());
    if (!saved->is_refused) return {{"ok", true}, {"text", saved->note}, {"mark", saved->mark}};
    const char* const why = saved->present         ? "it was changed meanwhile"
                            : message.mark.empty() ? "there is no such file"
                                                   : "it was removed meanwhile";
    Json json{{"ok", false}, {"text", message.file + ": " + why}, {"changed", true}};
    json["mark"] = saved->present ? saved->present->mark : "";
    json["content"] = saved->present ? Json(saved->present->text) : Json();
    return json;
}

Json list_versions(const EditedFiles& files, const EditMessage& message) {
    Json all = Json::array();
    for (const KeptVersion& each : files.versions(message.file))
        all.push_back({{"number", each.number}, {"saved_at", each.saved_at}, {"bytes", each.bytes}});
    return {{"ok", true}, {"text", ""}, {"versions", std::move(all)}};
}

Json read_version(const EditedFiles& files, const EditMessage& message) {
    const auto text = files.version(message.file, message.number);
    if (!text) return refused_edit(text.error());
    return {{"ok", true}, {"text", ""}, {"content", *text}};
}

// The findings of `nezumi check` for a text.
Json check_edited(const std::string& program, const std::string& shown, const std::string& text,
                  const std::atomic<bool>& gives_up) {
    if (program.empty()) return refused_edit({"files can be checked only in the page of `nezumi run`"});
    const UnnamedFile input(text);
    const UnnamedFile errors;
    const auto end = run_program({.words = {"nice", "-n", "10", program, "check", "-", "--json", "--name", shown},
                                  .input = input.file(),
                                  .errors = errors.file(),
                                  .keeps_output = true,
                                  .longest = Editor::longest_check,
                                  .give_up = &gives_up});
    if (!end) return refused_edit({"not checked: " + end.error().message});
    Json findings = Json::parse(end->out, nullptr, false);
    if (end->status > 1 || !findings.is_array()) {
        const std::string said(trimmed(errors.text()));
        return refused_edit({"not checked: " + (said.empty() ? problem_of(end) : said)});
    }
    return {{"ok", true}, {"text", ""}, {"shown", shown}, {"findings", std::move(findings)}};
}

}  // namespace

Editor::Editor(Project project, std::filesystem::path folder, EditorOptions options, Answer answer)
    : project_(std::move(project)),
      files_(std::move(folder)),
      options_(std::move(options)),
      answer_(std::move(answer)) {}

Editor::~Editor() { ends_ = true; }

Expected<void> Editor::start(ClientId client, std::int64_t id, EditMessage message) {
    JobThread& jobs = message.what == EditMessage::What::check ? checks_ : file_jobs_;
    const bool is_taken =
        jobs.put([this, client, id, message = std::move(message)] { answer_(client, answer_to(id, message)); });
    if (!is_taken) return failure("too many requests for files are waiting: try again");
    return {};
}

std::string Editor::answer_to(std::int64_t id, const EditMessage& message) const {
    Json json{{"is", "answer"}, {"id", id}};
    switch (message.what) {
        case EditMessage::What::list: json.update(list_files(project_, files_, options_)); break;
        case EditMessage::What::read: json.update(read_edited(files_, message)); break;
        case EditMessage::What::save: json.update(save_edited(files_, message)); break;
        case EditMessage::What::versions: json.update(list_versions(files_, message)); break;
        case EditMessage::What::version: json.update(read_version(files_, message)); break;
        case EditMessage::What::words: {
            const EditorWords words = options_.words ? options_.words() : EditorWords{};
            json.update({{"ok", true}, {"text", ""}, {"content", words.annotations}, {"names", words.names}});
            break;
        }
        case EditMessage::What::check: {
            const auto ok = EditedFiles::check_name(message.file);
            const std::string shown = project_.shown(files_.folder() / message.file);
            json.update(ok ? check_edited(options_.program, shown, message.text, ends_) : refused_edit(ok.error()));
            break;
        }
    }
    return json_text(json);
}

}  // namespace nezumi::web
