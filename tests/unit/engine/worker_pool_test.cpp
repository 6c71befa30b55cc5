// Threads that share out numbers.
#include "engine/base/worker_pool.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <set>
#include <thread>
#include <vector>

using namespace nezumi;

TEST_CASE("every number is some worker's once, in every round", "[engine][threads]") {
    for (const int threads : {1, 2, 3, 8}) {
        WorkerPool pool(threads);
        CHECK(pool.size() == static_cast<std::size_t>(threads));
        for (const std::size_t count : {0, 1, 2, 7, 1000}) {
            for (int round = 0; round < 20; ++round) {
                std::vector<std::atomic<int>> seen(count);
                std::vector<std::atomic<int>> shares(pool.size());
                pool.run(count, [&](std::size_t begin, std::size_t end, std::size_t worker) {
                    ++shares.at(worker);
                    for (std::size_t i = begin; i < end; ++i) ++seen[i];
                });
                for (const auto& times : seen) REQUIRE(times == 1);
                for (const auto& times : shares) REQUIRE(times == 1);
            }
        }
    }
}

TEST_CASE("when a thread was late the caller does all shares itself for a while, and then tries again",
          "[engine][threads]") {
    WorkerPool pool(2);
    const auto threads_of_round = [&](std::chrono::milliseconds delay) {
        std::vector<std::thread::id> who(2);
        pool.run(2, [&](std::size_t, std::size_t, std::size_t worker) {
            who.at(worker) = std::this_thread::get_id();
            if (worker > 0) std::this_thread::sleep_for(delay);
        });
        return std::set<std::thread::id>(who.begin(), who.end());
    };
    const std::set<std::thread::id> alone{std::this_thread::get_id()};
    CHECK(threads_of_round(std::chrono::milliseconds(50)).size() == 2);
    std::vector<int> rounds_alone;
    for (int late = 0; late < 4; ++late) {
        int rounds = 0;
        while (threads_of_round(std::chrono::milliseconds(50)) == alone) ++rounds;
        rounds_alone.push_back(rounds);
    }
    CHECK(rounds_alone == std::vector<int>{1, 3, 7, 15});
}
