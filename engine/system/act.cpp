// Names and components of acts.
#include "engine/system/act.hpp"

namespace nezumi {

std::string_view name_of(const Act& act) {
    return std::visit([]<class T>(const T&) { return Describe<T>::name; }, act);
}

std::string act_in_words(std::string_view name) {
    std::string text;
    for (const char each : name) {
        const bool begins = each >= 'A' && each <= 'Z';
        if (begins && !text.empty()) text += ' ';
        text += begins ? static_cast<char>(each - 'A' + 'a') : each;
    }
    return text;
}

bool is_about(const Act& act, std::string_view component) {
    return std::visit(
        [&]<class T>(const T& its) {
            constexpr bool is_of_files =
                std::is_same_v<T, Reload> || std::is_same_v<T, Rollback> || std::is_same_v<T, Remove>;
            if constexpr (requires { its.component; } && !is_of_files) {
                return its.component == component;
            } else {
                return false;
            }
        },
        act);
}

}  // namespace nezumi
