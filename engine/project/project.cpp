// Searches for files in the documented order of places.
#include "engine/project/project.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/list.hpp"
#include "engine/base/visible.hpp"

namespace nezumi {
namespace fs = std::filesystem;
namespace {

std::string_view word(FileKind kind) {
    switch (kind) {
        case FileKind::script: return "script";
        case FileKind::model: return "robot model";
        case FileKind::module: return "module";
        case FileKind::system: return "system file";
        case FileKind::data: return "file";
        case FileKind::message: return "message";
    }
    return "file";
}

bool ends_in_lua(std::string_view name) { return name.size() > 4 && name.substr(name.size() - 4) == ".lua"; }

// Whether this is the name of a module: "lib.pid", "lib/pid". Such a name can't lead out of the searched folders.
bool is_module_name(std::string_view name) {
    bool begins = true;  // a part of the name begins here
    for (const char c : name) {
        const bool ends = c == '.' || c == '/';
        if (begins && ends) return false;
        begins = ends;
    }
    return !begins;
}

// The name as a path with its file extension.
fs::path file_name(FileKind kind, std::string_view name) {
    std::string text(name);
    if (kind == FileKind::data) return text;
    if (kind == FileKind::module) {
        std::replace(text.begin(), text.end(), '.', '/');
        return text + ".lua";
    }
    return ends_in_lua(text) ? text : text + ".lua";
}

// The names in a folder that could be meant, in the form that a person writes.
void collect_names(const ProjectFiles& files, const fs::path& folder, FileKind kind, std::set<std::string>& names) {
    for (std::string& name : files.names_in(folder)) {
        if (kind == FileKind::data) {
            names.insert(std::move(name));
        } else if (const fs::path path(name); path.extension() == ".lua") {
            names.insert(path.stem().string());
        }
    }
}

std::string nearest_name(const ProjectFiles& files, const std::vector<fs::path>& folders, FileKind kind,
                         std::string_view name) {
    std::set<std::string> names;
    const fs::path wanted =
        kind == FileKind::module ? fs::path(file_name(kind, name)).replace_extension() : fs::path(name);
    const bool written_out = kind != FileKind::data && kind != FileKind::module && ends_in_lua(name);
    for (const fs::path& folder : folders) {
        std::set<std::string> here;
        collect_names(files, folder / wanted.parent_path(), kind, here);
        for (const std::string& found : here) {
            std::string text = (wanted.parent_path() / found).string();
            if (kind == FileKind::module) std::replace(text.begin(), text.end(), '/', '.');
            names.insert(text + (written_out ? ".lua" : ""));
        }
    }
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    // An existing name was not accepted because it is a folder or the naming file itself, so it is not a suggestion.
    if (contains(candidates, name)) return "";
    return did_you_mean(name, candidates);
}

}  // namespace

Project Project::of(const fs::path& file, std::vector<fs::path> installed, const ProjectFiles& files) {
    Project project;
    project.files_ = &files;
    project.working_ = files.working_folder();
    const auto whole = [&](const fs::path& path) { return (project.working_ / path).lexically_normal(); };
    for (fs::path& root : installed) root = whole(root);
    project.installed_ = std::move(installed);
    for (fs::path folder = whole(file).parent_path();; folder = folder.parent_path()) {
        if (files.is_folder(folder / "behaviors")) {
            project.root_ = folder;
            break;
        }
        if (folder == folder.parent_path()) break;
    }
    return project;
}

std::vector<fs::path> Project::folders(FileKind kind, const fs::path& naming) const {
    std::vector<fs::path> folders{naming.parent_path()};
    const auto add_behaviors_of = [&](const fs::path& root) {
        if (kind == FileKind::message) return folders.push_back(root / "behaviors/messages");
        if (kind == FileKind::system) folders.push_back(root / "behaviors/systems");
        folders.push_back(root / "behaviors");
        if (kind == FileKind::module) folders.push_back(root / "behaviors/lib");
    };
    if (!root_.empty()) add_behaviors_of(root_);
    for (const fs::path& installed : installed_) {
        if (kind == FileKind::model || kind == FileKind::data) folders.push_back(installed / "engine/robots");
        add_behaviors_of(installed);
    }
    return folders;
}

std::vector<std::string> Project::names(FileKind kind, const fs::path& named_in) const {
    const fs::path naming = (working_ / named_in).lexically_normal();
    std::set<std::string> names;
    for (const fs::path& folder : folders(kind, naming)) collect_names(*files_, folder, kind, names);
    return {names.begin(), names.end()};
}

Expected<fs::path> Project::find(FileKind kind, std::string_view name, const fs::path& named_in,
                                 const std::function<bool(const fs::path&)>& passes_over) const {
    if (name.empty()) return failure(fmt::format("the name of a {} is empty", word(kind)));
    // The name is shown in messages, so it must not have control characters.
    if (visible(name) != name || name.find_first_of("\n\t") != std::string_view::npos)
        return failure(
            fmt::format("the name of a {} has a control character in it: '{}'", word(kind), nezumi::shown(name)));
    if (kind == FileKind::module && !is_module_name(name))
        return failure(fmt::format("there is no module '{}': expected names with dots between them, as in 'lib.pid'",
                                   nezumi::shown(name)));
    const fs::path naming = (working_ / named_in).lexically_normal();
    const std::vector<fs::path> folders = this->folders(kind, naming);
    const fs::path file = file_name(kind, name);
    std::vector<std::string> places;
    std::string other;
    for (const fs::path& folder : folders) {
        const fs::path candidate = (folder / file).lexically_normal();
        // A file can't name itself: a system may have the same name as its behaviour.
        if (candidate == naming) continue;
        const std::string what = files_->what_is(candidate);
        const bool is_file = what == "a file";
        if (is_file && !(passes_over && passes_over(candidate))) return candidate;
        const std::string place = shown(candidate);
        if (contains(places, place)) continue;
        if (!what.empty() && !is_file && what != "a folder")
            other += fmt::format("; {} is {}, expected a file", place, what);
        places.push_back(place);
    }
    return failure(fmt::format("there is no {} '{}'{}; looked for {}{}", word(kind), name,
                               nearest_name(*files_, folders, kind, name), fmt::join(places, ", "), other));
}

Expected<std::string> Project::read(const fs::path& path) const { return files_->read(path, shown(path)); }

Expected<SourceText> Project::read_source(const std::string& path) const {
    auto text = read(path);
    if (!text) return Unexpected(text.error());
    return SourceText{path, shown(path), std::move(*text)};
}

std::string Project::shown(const fs::path& path) const {
    const fs::path whole = (working_ / path).lexically_normal();
    const fs::path relative = whole.lexically_relative(working_);
    const bool below = !relative.empty() && *relative.begin() != "..";
    return below ? relative.string() : whole.string();
}

}  // namespace nezumi
