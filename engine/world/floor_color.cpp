// The colours' names.
#include "engine/world/floor_color.hpp"

#include <array>
#include <cstddef>

namespace nezumi {

std::string_view to_text(FloorColor color) {
    constexpr std::array<std::string_view, 8> names{"none",   "black", "blue",  "green",
                                                    "yellow", "red",   "white", "brown"};
    return names[static_cast<std::size_t>(color)];
}

}  // namespace nezumi
