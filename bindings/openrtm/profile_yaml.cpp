// A mapping is an element, a list of mappings is several elements with the same name, and a scalar is an attribute.
// Names of extensions begin with "rtsExt::".
#include "bindings/openrtm/profile_yaml.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <vector>

#include "bindings/openrtm/profile_xml.hpp"
#include "engine/base/list.hpp"
#include "engine/base/yaml.hpp"

namespace nezumi::openrtm {
namespace {

constexpr std::string_view root_key = "rtsProfile";
constexpr std::string_view extension = "rtsExt::";
constexpr std::size_t most_values = 100'000;

// "components" is the element <Components>.
std::string with_first(std::string_view name, int (*convert)(int)) {
    std::string changed(name);
    if (!changed.empty()) changed[0] = static_cast<char>(convert(static_cast<unsigned char>(changed[0])));
    return changed;
}

class YamlReader {
public:
    explicit YamlReader(const std::string& file) : file_(file) {}

    Expected<void> read(const YAML::Node& mapping, pugi::xml_node element, int depth = 0) {
        if (depth > deepest_profile)
            return failure(fmt::format("is nested more than {} levels deep", deepest_profile), {file_});
        for (const auto& pair : mapping) {
            const YAML::Node &key = pair.first, &value = pair.second;
            if (++values_ > most_values)
                return failure(fmt::format("has more than {} values, too many for a profile", most_values), {file_});
            if (!key.IsScalar()) return failure("expected a name before ':'", yaml_place(key, file_));
            std::string_view name = key.Scalar();
            if (name.starts_with(extension)) name.remove_prefix(extension.size());
            Expected<void> read;
            if (value.IsMap()) {
                read = this->read(value, element.append_child(std::string(name).c_str()), depth + 1);
            } else if (value.IsSequence()) {
                read = read_list(value, with_first(name, std::toupper), element, depth);
            } else if (value.IsScalar()) {
                element.append_attribute(std::string(name).c_str()) = value.Scalar().c_str();
            }
            if (!read) return read;
        }
        return {};
    }

private:
    Expected<void> read_list(const YAML::Node& list, const std::string& name, pugi::xml_node element, int depth) {
        for (const YAML::Node& each : list) {
            if (++values_ > most_values)
                return failure(fmt::format("has more than {} values, too many for a profile", most_values), {file_});
            if (!each.IsMap()) continue;
            if (auto read = this->read(each, element.append_child(name.c_str()), depth + 1); !read) return read;
        }
        return {};
    }

    const std::string& file_;
    std::size_t values_ = 0;
};

// True for elements that occur only once; all others are lists.
bool is_single(std::string_view name) {
    constexpr std::array<std::string_view, 5> single{"location", "sourceDataPort", "targetDataPort",
                                                     "sourceServicePort", "targetServicePort"};
    return contains(single, name);
}

// Values that rtsprofile does not read as strings.
bool is_bare(std::string_view name) {
    constexpr std::array<std::string_view, 8> bare{"isRequired", "visible", "rate",  "pushInterval",
                                                   "x",          "y",       "width", "height"};
    return contains(bare, name);
}

void put_date(YAML::Emitter& out, std::string_view date) {
    constexpr std::array<std::string_view, 6> parts{"year", "month", "day", "hour", "minute", "second"};
    out << YAML::BeginMap;
    std::size_t at = 0;
    for (const std::string_view part : parts) {
        int number = 0;
        while (at < date.size() && std::isdigit(static_cast<unsigned char>(date[at])) == 0) ++at;
        for (; at < date.size() && std::isdigit(static_cast<unsigned char>(date[at])) != 0; ++at)
            number = 10 * number + (date[at] - '0');
        out << YAML::Key << std::string(part) << YAML::Value << number;
    }
    out << YAML::EndMap;
}

void put(YAML::Emitter& out, const pugi::xml_node& element) {
    out << YAML::BeginMap;
    for (const pugi::xml_attribute& each : element.attributes()) {
        const std::string_view whole = each.name();
        if (whole.starts_with("xmlns") || whole.starts_with("xsi:")) continue;
        const std::string name(local_name(whole));
        out << YAML::Key << name << YAML::Value;
        if (name.ends_with("Date")) {
            put_date(out, each.value());
        } else if (is_bare(name)) {
            out << each.value();
        } else {
            out << YAML::DoubleQuoted << each.value();
        }
    }
    std::vector<std::string> done;
    for (const pugi::xml_node& child : elements_of(element)) {
        const std::string name = with_first(local_name(child.name()), std::tolower);
        if (contains(done, name)) continue;
        done.push_back(name);
        const bool is_extension = std::string_view(child.name()).starts_with("rtsExt:");
        out << YAML::Key << (is_extension ? std::string(extension) : "") + name << YAML::Value;
        if (is_single(name)) {
            put(out, child);
            continue;
        }
        out << YAML::BeginSeq;
        for (const pugi::xml_node& each : elements_of(element, local_name(child.name()))) put(out, each);
        out << YAML::EndSeq;
    }
    out << YAML::EndMap;
}

}  // namespace

bool is_yaml_profile(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    // Texts in UTF-16 count as XML: one of their first two bytes is 0 or a byte order mark.
    return first != std::string_view::npos && text[first] != '<' && text[0] != '\0' && text[0] != '\xfe' &&
           text[0] != '\xff';
}

Expected<pugi::xml_node> open_yaml_profile(std::string_view text, const std::string& shown_file,
                                           pugi::xml_document& document) {
    const Place file{shown_file};
    if (text.size() > largest_profile)
        return failure(fmt::format("has {} bytes, and a profile has at most {}", text.size(), largest_profile), file);
    const auto whole = read_yaml(text, shown_file);
    if (!whole) return Unexpected(whole.error());
    const YAML::Node root = yaml_field(*whole, std::string(root_key));
    if (!root.IsDefined() || !root.IsMap())
        return failure(fmt::format("expected a profile: XML with <RtsProfile>, or YAML with '{}:'", root_key), file);
    const pugi::xml_node element = document.append_child("RtsProfile");
    if (auto read = YamlReader(shown_file).read(root, element); !read) return Unexpected(read.error());
    if (const std::string wrong = wrong_with(document); !wrong.empty()) return failure(wrong, file);
    return element;
}

Expected<std::string> save_yaml_profile(const pugi::xml_document& document) {
    // Refuses texts that XML can't hold, so that every profile can be converted to XML.
    if (auto fits = save_profile(document); !fits) return Unexpected(fits.error());
    YAML::Emitter out;
    out << YAML::BeginMap << YAML::Key << std::string(root_key) << YAML::Value;
    put(out, document.document_element());
    out << YAML::EndMap;
    return std::string(out.c_str()) + "\n";
}

}  // namespace nezumi::openrtm
