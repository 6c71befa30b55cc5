// yaml-cpp throws exceptions; none of them leaves this file.
#include "engine/base/yaml.hpp"

#include <fmt/format.h>

#include "engine/base/number_in.hpp"

namespace nezumi {

Expected<YAML::Node> read_yaml(std::string_view text, const std::string& file) {
    try {
        return YAML::Load(std::string(text));
    } catch (const YAML::Exception& thrown) {
        return failure(fmt::format("is not YAML: {}", shown(thrown.msg)),
                       {file, thrown.mark.is_null() ? 0 : thrown.mark.line + 1});
    }
}

YAML::Node yaml_field(const YAML::Node& mapping, const std::string& key) {
    return mapping.IsMap() ? mapping[key] : YAML::Node(YAML::NodeType::Undefined);
}

Place yaml_place(const YAML::Node& value, const std::string& file) {
    return {file, value.IsDefined() ? value.Mark().line + 1 : 0};
}

std::string yaml_text(const YAML::Node& value) {
    if (!value.IsDefined()) return "";
    return value.IsScalar() ? value.Scalar() : YAML::Dump(value);
}

std::optional<double> yaml_number(const YAML::Node& value) {
    if (!value.IsDefined() || !value.IsScalar()) return std::nullopt;
    return signed_finite_in(value.Scalar());
}

std::optional<std::vector<double>> yaml_numbers(const YAML::Node& value) {
    if (!value.IsDefined() || !value.IsSequence()) return std::nullopt;
    std::vector<double> numbers;
    for (const YAML::Node& element : value) {
        const auto number = yaml_number(element);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

std::optional<bool> yaml_boolean(const YAML::Node& value) {
    if (const auto number = yaml_number(value)) {
        if (*number != 0 && *number != 1) return std::nullopt;
        return *number == 1;
    }
    bool truth = false;
    if (!value.IsDefined() || !YAML::convert<bool>::decode(value, truth)) return std::nullopt;
    return truth;
}

}  // namespace nezumi
