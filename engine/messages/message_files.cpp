// Searches folders for the file that defines a message type, then for the types of its fields.
#include "engine/messages/message_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/base/list.hpp"
#include "engine/base/names.hpp"
#include "engine/messages/idl_file.hpp"
#include "engine/messages/message_catalog.hpp"
#include "engine/messages/msg_file.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi {
namespace fs = std::filesystem;
namespace {

// Whether two names are equal without case and underscores, as "light_sensors" and "LightSensors". Called for every
// port and every file beside its behaviour, so it makes no strings.
bool same_file_name(std::string_view a, std::string_view b) {
    const auto skip = [](std::string_view& name) {
        name.remove_prefix(std::min(name.find_first_not_of('_'), name.size()));
    };
    for (skip(a), skip(b); !a.empty() && !b.empty(); skip(a), skip(b)) {
        if (std::tolower(static_cast<unsigned char>(a[0])) != std::tolower(static_cast<unsigned char>(b[0])))
            return false;
        a.remove_prefix(1), b.remove_prefix(1);
    }
    return a.empty() && b.empty();
}

// The name of a file without `ending`; nothing for files with another ending. Makes no path, to be fast.
std::optional<std::string_view> stem_of(std::string_view file, std::string_view ending) {
    if (!file.ends_with(ending)) return std::nullopt;
    return file.substr(0, file.size() - ending.size());
}

// A name in two parts: the package, or "", and the rest.
struct TypeName {
    std::string package, name;
};

// Accepts "Obstacle", "sensor_msgs/Imu", and the forms of ROS and IDL: "sensor_msgs/msg/Imu", "RTC::TimedOctet".
std::optional<TypeName> parse_name(std::string_view text) {
    std::string name(text);
    for (const std::string_view between : {"::", "/msg/"}) {
        for (std::size_t at = name.find(between); at != std::string::npos; at = name.find(between))
            name.replace(at, between.size(), "/");
    }
    const std::size_t slash = name.rfind('/');
    TypeName made{slash == std::string::npos ? "" : name.substr(0, slash), name.substr(slash + 1)};
    std::string_view rest = name;
    while (true) {
        const std::size_t end = std::min(rest.find('/'), rest.size());
        if (!is_identifier(rest.substr(0, end))) return std::nullopt;
        if (end == rest.size()) return made;
        rest.remove_prefix(end + 1);
    }
}

// Whether the text of a Lua file defines a message (`return message ...`), not a behaviour.
bool returns_message(std::string_view text) {
    for (std::size_t at = text.find("return"); at != std::string_view::npos; at = text.find("return", at + 1)) {
        const std::string_view rest = text.substr(std::min(text.find_first_not_of(" \t\r\n", at + 6), text.size()));
        if (rest.starts_with("message") && (rest.size() == 7 || rest.find_first_of(" \t\"'(", 7) == 7)) return true;
    }
    return false;
}

// The compiled structure with the last part of this name ("Point2D" of "RTC/Point2D"); null if there is none.
const Type* compiled_structure(const std::string& kind) {
    const Type* type = compiled_payload(kind.substr(kind.rfind('/') + 1));
    return type != nullptr && type->kind == Type::Kind::structure ? type : nullptr;
}

// Whether the field of a compiled structure has the type of the definition's field.
bool has_type(const Type::Field& field, const FieldDefinition& defined) {
    const Type* type = field.type;
    for (auto length = defined.shape.rbegin(); length != defined.shape.rend(); ++length) {
        const bool fits = *length == 0 ? type->kind == Type::Kind::sequence
                                       : type->kind == Type::Kind::array && type->length == *length;
        if (!fits) return false;
        type = type->element;
    }
    if (!defined.choices.empty()) return type->kind == Type::Kind::enumeration && type->choices == defined.choices;
    const Type* single = type_of_kind(defined.kind);
    return type == (single != nullptr ? single : compiled_structure(defined.kind));
}

// The compiled structure to use instead of a definition with the same name and the same fields; null if there is none.
const Type* same_compiled(const std::string& kind, const MessageDefinition& definition) {
    const Type* type = compiled_structure(kind);
    if (type == nullptr) return nullptr;
    const auto same = [](const Type::Field& field, const FieldDefinition& other) {
        return field.name == other.name && has_type(field, other);
    };
    return std::equal(type->fields.begin(), type->fields.end(), definition.fields.begin(), definition.fields.end(),
                      same)
               ? type
               : nullptr;
}

constexpr std::string_view list_all = "; `nezumi types` lists them all";

}  // namespace

class MessageFiles::Search {
public:
    Search(const MessageFiles& files, std::vector<SourceText>& read) : files_(files), read_(read) {}

    // The location of a type's definition: a file, and in IDL the structure.
    struct Definition {
        fs::path path;
        std::string package;
        std::string structure;
    };

    Expected<const MessageType*> find(std::string_view text, const fs::path& from) {
        problem_.reset();
        const auto name = parse_name(text);
        if (const auto compiled = find_message_type(text)) {
            const auto again = name ? redefinition_of(name->name, from) : std::nullopt;
            return again ? define(*again) : *compiled;
        }
        auto found = name ? definition_of(*name, from) : std::nullopt;
        if (problem_) return Unexpected(*problem_);
        if (found) return define(*found);
        std::vector<std::string> all = files_.names(from);
        const auto compiled = compiled_message_names();
        all.insert(all.end(), compiled.begin(), compiled.end());
        if (!chain_.empty()) all.insert(all.end(), field_kinds().begin(), field_kinds().end());
        return failure(
            fmt::format("unknown type '{}'{}{}", shown(text), did_you_mean(text, {all.begin(), all.end()}), list_all));
    }

    // Adds the names of all types that the files of a folder define. Ignores files that can't be read.
    void add_names(const fs::path& folder, const std::string& package, bool of_messages, std::set<std::string>& names) {
        const std::string prefix = package.empty() ? "" : package + "/";
        for (const std::string& entry : project().files().names_in(folder)) {
            const fs::path path = folder / entry;
            if (path.extension() == ".lua" && package.empty() && (of_messages || is_message(path))) {
                names.insert(type_of_file(path.string()));
            } else if (path.extension() == ".msg") {
                names.insert(prefix + path.stem().string());
            } else if (path.extension() == ".idl") {
                if (const auto all = idl_at(path)) {
                    for (const MessageDefinition& each : **all) names.insert(each.name);
                }
            } else if (of_messages && package.empty() && project().files().is_folder(path)) {
                add_names(path, entry, true, names);
                add_names(path / "msg", entry, true, names);
            }
        }
    }

    Expected<std::vector<const MessageType*>> types_in(const SourceText& source) {
        sources_[source.path] = source;
        const fs::path path(source.path);
        std::vector<const MessageType*> all;
        if (path.extension() != ".idl") {
            std::string package = path.parent_path().filename().string();
            if (package == "msg") package = path.parent_path().parent_path().filename().string();
            if (package == "messages" || path.extension() == ".lua") package.clear();
            const auto type = define({path, package, ""});
            if (!type) return Unexpected(type.error());
            all.push_back(*type);
            return all;
        }
        const auto structures = idl_at(path);
        if (!structures) return Unexpected(structures.error());
        for (const MessageDefinition& each : **structures) {
            if (each.place.file != source.shown) continue;
            const auto type = define({path, "", each.name});
            if (!type) return Unexpected(type.error());
            all.push_back(*type);
        }
        return all;
    }

private:
    const Project& project() const { return files_.project_; }

    Expected<SourceText> source_of(const fs::path& path) {
        if (const auto known = sources_.find(path.string()); known != sources_.end()) return known->second;
        auto source = project().read_source(path.string());
        if (!source) return source;
        read_.push_back(*source);
        sources_[path.string()] = *source;
        return source;
    }

    bool is_message(const fs::path& path) {
        const auto text = project().read(path);
        return text && returns_message(*text);
    }

    using Structures = std::vector<MessageDefinition>;
    Expected<const Structures*> idl_at(const fs::path& path) {
        if (const auto known = idl_.find(path.string()); known != idl_.end()) return &known->second;
        const auto source = source_of(path);
        if (!source) return Unexpected(source.error());
        auto structures =
            read_idl(*source, [&](std::string_view name, const SourceText& from) { return included(name, from); });
        if (!structures) return Unexpected(structures.error());
        return &(idl_[path.string()] = std::move(*structures));
    }

    Expected<SourceText> included(std::string_view name, const SourceText& from) {
        const fs::path path(name);
        const bool leaves = contains(path, "..");
        if (path.is_absolute() || leaves || name.empty())
            return failure("expected a file beside this file or in behaviors/messages/");
        // OpenRTM includes its files by another path, <rtm/idl/BasicDataType.idl>, so only the file name is tried too.
        for (const fs::path& each : {path, path.filename()}) {
            for (const fs::path& folder : project().places(FileKind::message, from.path)) {
                for (const fs::path& file : {folder / each, folder / "rtc" / each}) {
                    if (project().files().is_file(file)) return source_of(file.lexically_normal());
                }
            }
        }
        return failure("there is no such file beside this file or in behaviors/messages/");
    }

    // The definitions in a folder that fit a name; a `name` without a package also fits definitions in packages.
    std::vector<Definition> in_folder(const fs::path& folder, const std::string& package, const TypeName& name,
                                      bool of_messages) {
        std::vector<Definition> all;
        std::vector<Definition> of_packages;
        for (const std::string& entry : project().files().names_in(folder)) {
            const fs::path path = folder / entry;
            const bool means_package = name.package.empty() || name.package == package;
            if (path.extension() == ".lua") {
                if (package.empty() && name.package.empty() && same_file_name(path.stem().string(), name.name) &&
                    (of_messages || is_message(path)))
                    all.push_back({path, "", ""});
            } else if (path.extension() == ".msg") {
                if (means_package && path.stem() == name.name) all.push_back({path, package, ""});
            } else if (path.extension() == ".idl") {
                const auto structures = idl_at(path);
                if (!structures) {
                    if (!problem_) problem_ = structures.error();
                    continue;
                }
                for (const MessageDefinition& each : **structures) {
                    const TypeName its = *parse_name(each.name);
                    if (its.name == name.name && (name.package.empty() || its.package == name.package) &&
                        each.place.file == project().shown(path))
                        all.push_back({path, its.package, each.name});
                }
            } else if (of_messages && package.empty() && (name.package.empty() || name.package == entry)) {
                add_inner(path, entry, name, of_packages);
            }
        }
        // A module of IDL need not have the name of its folder, so the other folders are searched too.
        if (all.empty() && of_packages.empty() && of_messages && package.empty() && !name.package.empty()) {
            for (const std::string& entry : project().files().names_in(folder)) {
                if (entry != name.package && fs::path(entry).extension().empty())
                    add_inner(folder / entry, entry, name, of_packages);
            }
        }
        return all.empty() ? of_packages : all;
    }

    void add_inner(const fs::path& path, const std::string& package, const TypeName& name,
                   std::vector<Definition>& found) {
        for (const fs::path& inner : {path, path / "msg"}) {
            for (Definition& each : in_folder(inner, package, name, true)) found.push_back(std::move(each));
        }
    }

    // A file that would redefine a built-in type: beside the file at `from`, or in a folder of messages.
    std::optional<Definition> redefinition_of(std::string_view built_in, const fs::path& from) {
        const std::vector<fs::path> folders = project().places(FileKind::message, from);
        for (std::size_t i = 0; i < folders.size(); ++i) {
            for (const std::string& entry : project().files().names_in(folders[i])) {
                const auto stem = stem_of(entry, ".lua");
                const bool is_lua =
                    stem && same_file_name(*stem, built_in) && (i > 0 || is_message(folders[i] / entry));
                if (is_lua || stem_of(entry, ".msg") == built_in) return Definition{folders[i] / entry, "", ""};
            }
        }
        return std::nullopt;
    }

    std::optional<Definition> definition_of(const TypeName& name, const fs::path& from) {
        const std::vector<fs::path> folders = project().places(FileKind::message, from);
        for (std::size_t i = 0; i < folders.size(); ++i) {
            const bool is_again = std::find(folders.begin(), folders.begin() + static_cast<std::ptrdiff_t>(i),
                                            folders[i]) != folders.begin() + static_cast<std::ptrdiff_t>(i);
            if (is_again && i > 0 && folders[i] != folders[0]) continue;
            const std::vector<Definition> all = in_folder(folders[i], "", name, i > 0);
            if (all.size() > 1) {
                const bool differ = all[0].package != all[1].package;
                problem_ = Error{fmt::format("type '{}' is defined by {} and by {}{}", name.name,
                                             project().shown(all[0].path), project().shown(all[1].path),
                                             differ ? fmt::format(": write '{}/{}' or '{}/{}'", all[0].package,
                                                                  name.name, all[1].package, name.name)
                                                    : ": remove one of them")};
            }
            if (problem_) return std::nullopt;
            if (!all.empty()) return all.front();
        }
        return std::nullopt;
    }

    Expected<const MessageType*> define(const Definition& found) {
        const auto source = source_of(found.path);
        if (!source) return Unexpected(source.error());
        if (found.path.extension() == ".idl") {
            const auto structures = idl_at(found.path);
            if (!structures) return Unexpected(structures.error());
            return define_structure(**structures, found.structure);
        }
        auto definition =
            found.path.extension() == ".msg" ? read_msg(*source, found.package) : files_.read_lua_(*source, project());
        if (!definition) return Unexpected(definition.error());
        return make(*definition, [&](const FieldDefinition& field) -> Expected<const Type*> {
            if (const Type* compiled = compiled_payload(field.kind)) {
                const auto again = redefinition_of(field.kind, found.path);
                if (!again) return compiled;
                const auto refused = define(*again);
                return refused ? Expected<const Type*>((*refused)->payload) : Unexpected(refused.error());
            }
            const auto inner = find(field.kind, found.path);
            if (!inner) return Unexpected(inner.error());
            return (*inner)->payload;
        });
    }

    Expected<const MessageType*> define_structure(const Structures& all, const std::string& name) {
        // For types of OpenRTM, the compiled types are used.
        if (const auto compiled = find_message_type(name.substr(name.rfind('/') + 1));
            compiled && name.starts_with("RTC/"))
            return *compiled;
        return make(without_stamp(structure_of(all, name)), fields_of(all));
    }

    // Finds the types of fields that are structures. A stamp in such an inner structure stays a normal field.
    MessageCatalog::Payloads fields_of(const Structures& all) {
        return [this, &all](const FieldDefinition& field) -> Expected<const Type*> {
            if (field.kind == wide_text) return failure("nezumi has no wide characters: use string, which holds UTF-8");
            const MessageDefinition& definition = structure_of(all, field.kind);
            if (const Type* compiled = same_compiled(field.kind, definition)) return compiled;
            const auto inner = make(definition, fields_of(all));
            if (!inner) return Unexpected(inner.error());
            return (*inner)->payload;
        };
    }

    // The structure with this name. It exists, because reading a file fails if the file names an unknown structure.
    static const MessageDefinition& structure_of(const Structures& all, const std::string& name) {
        return *std::find_if(all.begin(), all.end(), [&](const MessageDefinition& each) { return each.name == name; });
    }

    Expected<const MessageType*> make(const MessageDefinition& definition, const MessageCatalog::Payloads& payloads) {
        if (find_message_type(definition.name) || compiled_payload(definition.name) != nullptr)
            return failure(
                fmt::format("message '{}': a built-in type has this name: choose another name", definition.name),
                definition.place);
        const auto inside = std::find(chain_.begin(), chain_.end(), definition.name);
        if (inside != chain_.end()) {
            return failure(fmt::format("message '{}' contains itself: {} contains {}", definition.name,
                                       fmt::join(inside, chain_.end(), " contains "), definition.name));
        }
        constexpr std::size_t most = 64;
        if (chain_.size() > most) return failure(fmt::format("messages are nested more than {} levels deep", most));
        chain_.push_back(definition.name);
        auto made = MessageCatalog::shared().define(definition, payloads);
        chain_.pop_back();
        return made;
    }

    const MessageFiles& files_;
    std::vector<SourceText>& read_;
    std::map<std::string, SourceText> sources_;
    std::map<std::string, Structures> idl_;
    std::vector<std::string> chain_;  // messages that are being made, each one is a field of the one before
    std::optional<Error> problem_;
};

MessageFiles::MessageFiles(Project project, LuaMessageReader read_lua)
    : project_(std::move(project)), read_lua_(std::move(read_lua)) {}

Expected<FoundMessage> MessageFiles::find(std::string_view name, const fs::path& from,
                                          std::vector<SourceText>* read) const {
    std::vector<SourceText> files;
    const auto type = Search(*this, files).find(name, from);
    if (read != nullptr) *read = files;
    if (!type) return Unexpected(type.error());
    return FoundMessage{*type, (*type)->is_compiled() ? std::vector<SourceText>{} : std::move(files)};
}

std::vector<std::string> MessageFiles::names(const fs::path& from) const {
    std::set<std::string> all;
    std::vector<SourceText> files;
    Search search(*this, files);
    const std::vector<fs::path> folders = project_.places(FileKind::message, from);
    for (std::size_t i = 0; i < folders.size(); ++i) search.add_names(folders[i], "", i > 0, all);
    return {all.begin(), all.end()};
}

std::vector<const MessageType*> MessageFiles::all(const fs::path& from) const {
    std::vector<const MessageType*> types;
    std::vector<SourceText> files;
    Search search(*this, files);
    for (const std::string& name : names(from)) {
        const auto found = search.find(name, from);
        if (found && !(*found)->is_compiled()) types.push_back(*found);
    }
    return types;
}

Expected<std::vector<const MessageType*>> MessageFiles::types_in(const SourceText& source) const {
    std::vector<SourceText> files;
    return Search(*this, files).types_in(source);
}

}  // namespace nezumi
