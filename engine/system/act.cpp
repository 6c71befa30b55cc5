// Names of acts.
#include "engine/system/act.hpp"

namespace nezumi {

std::string_view name_of(const Act& act) {
    return std::visit([]<class T>(const T&) { return Describe<T>::name; }, act);
}

}  // namespace nezumi
