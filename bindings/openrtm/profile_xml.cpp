// pugixml expands no entities of a DOCTYPE; a document with a DOCTYPE is refused anyway.
#include "bindings/openrtm/profile_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "engine/base/trimmed.hpp"
#include "engine/base/utf8.hpp"

namespace nezumi::openrtm {
namespace {

int line_of(std::string_view text, std::ptrdiff_t offset) {
    const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
    return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

bool has_text_alone(const pugi::xml_node& node) {
    if (!is_utf8(node.name()) || !is_utf8(node.value())) return false;
    const auto attributes = node.attributes();
    return std::all_of(attributes.begin(), attributes.end(),
                       [](const pugi::xml_attribute& each) { return is_utf8(each.name()) && is_utf8(each.value()); });
}

// The first text of a document that XML 1.0 can't hold; "" if there is none.
std::string unwritable_text(const pugi::xml_node& node) {
    const auto is_bad = [](std::string_view text, std::string_view allowed) {
        return !is_utf8(text) || std::any_of(text.begin(), text.end(), [&](char c) {
            return c >= 0 && c < 0x20 && allowed.find(c) == std::string_view::npos;
        });
    };
    for (const pugi::xml_attribute& each : node.attributes()) {
        if (is_bad(each.value(), "\t\n\r")) return each.value();
    }
    if (is_bad(node.value(), "\t\n")) return node.value();
    for (const pugi::xml_node& each : node.children()) {
        if (std::string bad = unwritable_text(each); !bad.empty()) return bad;
    }
    return "";
}

}  // namespace

std::string wrong_with(const pugi::xml_document& document) {
    int depth = 0;
    pugi::xml_node node = document.first_child();
    while (node) {
        if (node.type() == pugi::node_doctype) return "has a DOCTYPE, which a profile can't have: remove it";
        if (!has_text_alone(node)) return "is not UTF-8 text: save it as UTF-8";
        if (depth > deepest_profile)
            return fmt::format("has more than {} nested elements, too many for a profile", deepest_profile);
        if (node.first_child()) {
            node = node.first_child();
            ++depth;
            continue;
        }
        while (node && !node.next_sibling()) {
            node = node.parent();
            --depth;
        }
        node = node.next_sibling();
    }
    return "";
}

Expected<pugi::xml_node> open_profile(std::string_view text, const std::string& shown_file, std::string_view root,
                                      pugi::xml_document& document) {
    const Place file{shown_file};
    if (text.size() > largest_profile) {
        return failure(fmt::format("has {} bytes, and a profile has at most {}", text.size(), largest_profile), file);
    }
    // Line breaks in attributes stay what they are.
    constexpr unsigned flags =
        pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_ws_pcdata_single | pugi::parse_doctype;
    const auto read = document.load_buffer(text.data(), text.size(), flags);
    if (!read) {
        return failure(fmt::format("expected the XML of a profile: {}", read.description()),
                       {shown_file, line_of(text, read.offset)});
    }
    if (const std::string wrong = wrong_with(document); !wrong.empty()) return failure(wrong, file);
    const pugi::xml_node element = document.document_element();
    if (local_name(element.name()) != root)
        return failure(fmt::format("expected a profile with <{}>, got <{}>", root, shown(element.name())), file);
    return element;
}

std::string_view local_name(std::string_view name) { return name.substr(name.find(':') + 1); }

std::string_view attribute_of(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_attribute& each : node.attributes()) {
        const std::string_view whole = each.name();
        if (local_name(whole) == name && !whole.starts_with("xsi:") && !whole.starts_with("xmlns:"))
            return each.value();
    }
    return "";
}

std::string without_html_breaks(std::string_view text, std::string_view instead) {
    std::string plain;
    while (!text.empty()) {
        const std::size_t at = std::min(text.find("<br"), text.size());
        plain += text.substr(0, at);
        text.remove_prefix(at);
        if (text.empty()) break;
        const std::size_t end = text.find('>');
        const bool is_break = end != std::string_view::npos && trimmed(text.substr(3, end - 3), " /").empty();
        plain += is_break ? instead : text.substr(0, 3);
        text.remove_prefix(is_break ? end + 1 : 3);
    }
    return plain;
}

pugi::xml_node element_of(const pugi::xml_node& node, std::string_view name) {
    return node.find_child([&](const pugi::xml_node& each) { return local_name(each.name()) == name; });
}

std::vector<pugi::xml_node> elements_of(const pugi::xml_node& node, std::string_view name) {
    std::vector<pugi::xml_node> found;
    for (const pugi::xml_node& each : node.children()) {
        if (each.type() == pugi::node_element && (name.empty() || local_name(each.name()) == name))
            found.push_back(each);
    }
    return found;
}

std::vector<ProfileProperty> properties_of(const pugi::xml_node& node) {
    std::vector<ProfileProperty> properties;
    for (const pugi::xml_node& each : elements_of(node, "Properties"))
        properties.push_back({std::string(attribute_of(each, "name")), std::string(attribute_of(each, "value"))});
    return properties;
}

pugi::xml_node begin_profile(pugi::xml_document& document, const char* root) {
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "UTF-8";
    declaration.append_attribute("standalone") = "yes";
    return document.append_child(root);
}

Expected<std::string> save_profile(const pugi::xml_document& document) {
    if (const std::string bad = unwritable_text(document.document_element()); !bad.empty())
        return failure(fmt::format("'{}' has a character that XML can't hold", shown(bad)));
    std::ostringstream text;
    document.save(text, "    ", pugi::format_default, pugi::encoding_utf8);
    return text.str();
}

}  // namespace nezumi::openrtm
