// The common parts of all kinds of entries.
#include "engine/system/system_spec.hpp"

namespace nezumi {

const std::string& name_of(const Entry& entry) {
    return std::visit([](const auto& e) -> const std::string& { return e.name; }, entry);
}

const Place& place_of(const Entry& entry) {
    return std::visit([](const auto& e) -> const Place& { return e.place; }, entry);
}

}  // namespace nezumi
