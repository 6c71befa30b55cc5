// A model of a number that runs report, from some runs with different values, to choose the values of the next run.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace nezumi {

/// A place in the unit cube: a share from 0 to 1 for each value of a run.
using Shares = std::vector<double>;

/// Gaussian process regression (Rasmussen and Williams 2006, algorithm 2.1) with a Matern kernel, nu = 5/2. Each value
/// has a separate length scale (5.1, automatic relevance determination): the most likely of a few.
class MarginModel {
public:
    /// `values` are those at `places`: at least one, all with the same number of shares. All differences of a
    /// share that `is_choice` count the same, whatever their size.
    MarginModel(std::vector<Shares> places, const std::vector<double>& values, std::vector<bool> is_choice);
    ~MarginModel();
    MarginModel(const MarginModel&) = delete;
    MarginModel& operator=(const MarginModel&) = delete;

    /// The place where the value may be least: mean minus `optimism` standard deviations. Found by NLopt: DIRECT-L
    /// (Gablonsky and Kelley 2001), then Subplex (Rowan 1990). The result is the same in each call.
    Shares least_place(double optimism) const;

private:
    struct Fit;
    std::unique_ptr<Fit> fit_;
};

}  // namespace nezumi
