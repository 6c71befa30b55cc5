// Only names that end in a number after `name` count.
#include "hw/device/numbered_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "engine/base/number_in.hpp"

namespace nezumi::hw {
namespace {

// Returns 7 for "video7" and the name "video".
std::optional<int> number_of(std::string_view node, std::string_view name) {
    if (!node.starts_with(name)) return std::nullopt;
    node.remove_prefix(name.size());
    return number_in<int>(node);
}

}  // namespace

std::vector<std::string> numbered_nodes(const std::string& folder, std::string_view name) {
    std::vector<std::pair<int, std::string>> found;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (const auto number = number_of(entry->path().filename().string(), name))
            found.emplace_back(*number, entry->path().string());
    }
    std::sort(found.begin(), found.end());
    std::vector<std::string> nodes;
    nodes.reserve(found.size());
    for (auto& [number, node] : found) nodes.push_back(std::move(node));
    return nodes;
}

std::string under_dev(const std::string& dev, const std::string& device) {
    constexpr std::string_view root = "/dev/";
    return device.starts_with(root) ? fmt::format("{}/{}", dev, device.substr(root.size())) : device;
}

}  // namespace nezumi::hw
