// A list that stores its first element in itself.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "engine/base/few.hpp"

using namespace nezumi;

namespace {

template <class T>
std::vector<T> all_of(const Few<T>& few) {
    return {few.begin(), few.end()};
}

}  // namespace

TEST_CASE("a list of few keeps its elements in order, one or many", "[engine][few]") {
    Few<std::string> few;
    CHECK(few.empty());
    few.push_back("a");
    CHECK(few.data() == reinterpret_cast<const std::string*>(&few));  // no memory of its own
    few.push_back("b");
    few.push_back("c");
    CHECK(all_of(few) == std::vector<std::string>{"a", "b", "c"});
    CHECK(few[2] == "c");
}

TEST_CASE("when an element of a list of few is removed, the elements after it move up", "[engine][few]") {
    Few<int> one;
    one.push_back(1);
    one.erase(one.begin());
    CHECK(one.empty());
    one.push_back(2);
    CHECK(all_of(one) == std::vector<int>{2});

    Few<int> many;
    for (const int i : {1, 2, 3}) many.push_back(i);
    many.erase(many.begin() + 1);
    CHECK(all_of(many) == std::vector<int>{1, 3});
    many.erase(many.begin());
    many.erase(many.begin());
    CHECK(many.empty());
    many.push_back(4);
    CHECK(all_of(many) == std::vector<int>{4});
}
