// Union-find over the links of a step.
#include "sim/islands.hpp"

#include <algorithm>

namespace nezumi::sim {

void Islands::add_mover() {
    parents_.push_back(static_cast<Scene::Index>(parents_.size()));
    equations_.push_back(0);
}

void Islands::clear() {
    links_.clear();
    crowded_ = false;
    std::fill(equations_.begin(), equations_.end(), 0);
}

Scene::Index Islands::root(Scene::Index mover) {
    while (parents_[mover] != mover) mover = parents_[mover] = parents_[parents_[mover]];
    return mover;
}

bool Islands::find_large() {
    if (links_.empty() && !crowded_) return false;
    std::vector<Scene::Index> linked;
    for (const auto& [a, b] : links_) {
        linked.push_back(a);
        linked.push_back(b);
        const Scene::Index ra = root(a), rb = root(b);
        if (ra != rb) parents_[std::max(ra, rb)] = std::min(ra, rb);
    }
    std::sort(linked.begin(), linked.end());
    linked.erase(std::unique(linked.begin(), linked.end()), linked.end());

    large_.assign(parents_.size(), false);
    std::vector<int> of_island(parents_.size(), 0);
    bool any = crowded_;
    for (Scene::Index i = 0; crowded_ && i < large_.size(); ++i) large_[i] = equations_[i] > most_alone;
    for (const Scene::Index i : linked) of_island[root(i)] += equations_on_floor + equations_[i];
    for (const Scene::Index i : linked) {
        large_[i] = of_island[root(i)] > most_equations;
        any = any || large_[i];
    }
    for (const Scene::Index i : linked) parents_[i] = i;
    return any;
}

}  // namespace nezumi::sim
