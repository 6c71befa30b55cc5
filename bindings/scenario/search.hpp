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

    /// Chooses the points of the next round, at most `most`, and none twice; none when all have been chosen. The first
    /// round has corners of the values, and random points. In later rounds, two points are where a model of a
    /// condition's margins is least, and one is near one of its least margins so far; the conditions take turns. One is
    /// near the ends of some values, one near a run that had new lines, and one is random.
    std::vector<SweepPoint> next(std::size_t most);

    /// Adds the result of a run, in the order of the points of its round.
    void add(const SweepPoint& point, const RunResult& result);

private:
    // How a point is chosen.
    enum class Way : unsigned char { least_of_model, explored_by_model, near_least, near_ends, near_new_lines, random };

    struct Seen {
        Shares place;
        std::map<std::string, double> margins;  // by condition
    };

    // The runs of one condition, by their margins.
    using Ranked = std::vector<std::pair<double, std::size_t>>;

    std::vector<SweepPoint> first_points(std::size_t count);
    SweepPoint random_point();
    SweepPoint point_of(Way way);
    Ranked next_condition();
    SweepPoint modelled_point(double optimism);
    SweepPoint near_least();
    SweepPoint near_ends();
    SweepPoint near_new_lines();
    SweepPoint near(Shares place);
    double next_signed() { return 2 * random_.next_fraction() - 1; }
    bool is_new(const std::vector<FileCoverage>& files);

    Sweep sweep_;
    Random random_;
    std::size_t rounds_ = 0;
    std::size_t draws_ = 0;
    std::size_t turn_ = 0;  // counts the conditions, which take turns
    std::vector<Seen> seen_;
    std::set<std::string> names_;                           // of all points
    std::set<std::pair<std::string, std::int64_t>> lines_;  // that have run: files, and lines or ways of branches
    std::vector<Shares> had_new_lines_;
    std::vector<std::pair<Shares, std::string>> chosen_;  // of this round by models, with their conditions
    std::string condition_;                               // the last one that `next_condition` chose
};

}  // namespace nezumi
