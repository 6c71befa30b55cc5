// Chooses the values of runs where margins may be least, and where lines ran that had not run before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/sandbox/random.hpp"
#include "bindings/scenario/margin_model.hpp"
#include "bindings/scenario/run_result.hpp"
#include "bindings/scenario/sweep.hpp"

namespace nezumi {

/// The sweep of a scenario, and the values that its run drew with `s:any`.
Sweep with_drawn(Sweep sweep, const std::vector<DrawnValue>& drawn);
SweepPoint with_drawn(SweepPoint point, const std::vector<DrawnValue>& drawn);

/// The values of a point, with what they were drawn from.
std::vector<DrawnValue> drawn_values(const Sweep& sweep, const SweepPoint& point);

/// A search in rounds. All points of a round are chosen before it, so its runs can be made in any order.
class Search {
public:
    Search(Sweep sweep, std::uint64_t seed) : sweep_(std::move(sweep)), random_(seed) {}

    /// Chooses the points of the next round, at most so many. The first round is random; then one point is random, one
    /// lies near a run that had new lines, and the others are where a model of one condition's margins after the other
    /// has its least value.
    std::vector<SweepPoint> next(std::size_t most);

    /// Adds the result of a run, in the order of the points of its round.
    void add(const SweepPoint& point, const RunResult& result);

private:
    struct Seen {
        Shares place;
        std::map<std::string, double> margins;  // by condition
    };

    SweepPoint random_point();
    std::vector<SweepPoint> modelled_points(std::size_t count);
    SweepPoint near_new_lines();
    bool is_new(const std::vector<FileCoverage>& files);

    Sweep sweep_;
    Random random_;
    std::size_t rounds_ = 0;
    std::size_t draws_ = 0;
    std::size_t turn_ = 0;  // of the conditions
    std::vector<Seen> seen_;
    std::set<std::string> names_;                           // of all points
    std::set<std::pair<std::string, std::int64_t>> lines_;  // that have run: files, and lines or ways of branches
    std::vector<Shares> had_new_lines_;
};

}  // namespace nezumi
