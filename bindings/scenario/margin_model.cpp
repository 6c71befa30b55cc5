// Values are scaled to their spread, so that units do not matter; outliers are cut.
#include "bindings/scenario/margin_model.hpp"

#ifndef NEZUMI_STATIC
#include <nlopt.h>
#endif

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/scenario/measures.hpp"

namespace nezumi {
namespace {

constexpr double noise = 1e-4;  // variance: equal values may give unequal runs
constexpr double choice_distance = 0.5;
constexpr int most_searches = 400;  // evaluations of the model
constexpr int most_steps = 80;

double matern(double distance) {
    const double scaled = std::sqrt(5.0) * distance;
    return (1 + scaled + scaled * scaled / 3) * std::exp(-scaled);
}

std::vector<double> scaled(const std::vector<double>& values) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const double middle = quantile(sorted, 0.5);
    double spread = (quantile(sorted, 0.75) - quantile(sorted, 0.25)) / 1.35;
    if (spread <= 0) spread = std::max(sorted.back() - sorted.front(), 1e-12);
    std::vector<double> out;
    out.reserve(values.size());
    for (const double value : values) out.push_back(std::clamp((value - middle) / spread, -4.0, 4.0));
    return out;
}

}  // namespace

struct MarginModel::Fit {
    std::vector<Shares> places;
    std::vector<bool> is_choice;
    std::vector<double> lengths;  // of each share
    Eigen::LLT<Eigen::MatrixXd> factor;
    Eigen::VectorXd weights;

    double distance(const Shares& a, const Shares& b) const {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double apart = is_choice[i] ? (std::abs(a[i] - b[i]) > 1e-9 ? choice_distance : 0) : a[i] - b[i];
            const double step = apart / lengths[i];
            sum += step * step;
        }
        return std::sqrt(sum);
    }

    // The logarithm of the likelihood of the values, with these length scales.
    double fit(const Eigen::VectorXd& values, std::vector<double> with_lengths) {
        lengths = std::move(with_lengths);
        const auto count = static_cast<Eigen::Index>(places.size());
        Eigen::MatrixXd covariance(count, count);
        for (Eigen::Index row = 0; row < count; ++row) {
            for (Eigen::Index column = 0; column <= row; ++column) {
                covariance(row, column) = covariance(column, row) =
                    matern(distance(places[static_cast<std::size_t>(row)], places[static_cast<std::size_t>(column)]));
            }
            covariance(row, row) += noise;
        }
        factor.compute(covariance);
        weights = factor.solve(values);
        const Eigen::MatrixXd lower = factor.matrixL();
        return -0.5 * values.dot(weights) - lower.diagonal().array().log().sum();
    }

    double least(const Shares& place, double optimism) const {
        Eigen::VectorXd near(static_cast<Eigen::Index>(places.size()));
        for (std::size_t i = 0; i < places.size(); ++i)
            near(static_cast<Eigen::Index>(i)) = matern(distance(place, places[i]));
        const double variance = 1 + noise - near.dot(factor.solve(near));
        return near.dot(weights) - optimism * std::sqrt(std::max(variance, 0.0));
    }
};

MarginModel::MarginModel(std::vector<Shares> places, const std::vector<double>& values, std::vector<bool> is_choice)
    : fit_(std::make_unique<Fit>()) {
    fit_->places = std::move(places);
    fit_->is_choice = std::move(is_choice);
    const std::vector<double> used = scaled(values);
    const Eigen::VectorXd vector =
        Eigen::Map<const Eigen::VectorXd>(used.data(), static_cast<Eigen::Index>(used.size()));
    double best = 0;
    std::vector<double> best_lengths;
    const auto try_lengths = [&](std::vector<double> lengths) {
        const double likelihood = fit_->fit(vector, lengths);
        if (!best_lengths.empty() && likelihood <= best) return;
        best = likelihood;
        best_lengths = std::move(lengths);
    };
    for (const double length : {0.1, 0.2, 0.4, 0.8, 1.6})
        try_lengths(std::vector<double>(fit_->is_choice.size(), length));
    for (std::size_t i = 0; i < fit_->is_choice.size(); ++i) {
        for (const double factor : {0.4, 3.0, 10.0}) {
            std::vector<double> lengths = best_lengths;
            lengths[i] *= factor;
            try_lengths(std::move(lengths));
        }
    }
    fit_->fit(vector, best_lengths);
}

MarginModel::~MarginModel() = default;

Shares MarginModel::least_place([[maybe_unused]] double optimism) const {
    const auto dimensions = static_cast<unsigned>(fit_->is_choice.size());
    Shares place(dimensions, 0.5);
#ifndef NEZUMI_STATIC
    struct Context {
        const Fit* fit;
        double optimism;
    };
    const Context context{fit_.get(), optimism};
    const auto value = [](unsigned count, const double* at, double*, void* data) {
        const auto& with = *static_cast<const Context*>(data);
        return with.fit->least(Shares(at, at + count), with.optimism);
    };
    double least = 0;
    for (const auto& [algorithm, evaluations] :
         {std::pair{NLOPT_GN_DIRECT_L, most_searches}, std::pair{NLOPT_LN_SBPLX, most_steps}}) {
        nlopt_opt optimizer = nlopt_create(algorithm, dimensions);
        nlopt_set_min_objective(optimizer, value, const_cast<Context*>(&context));
        nlopt_set_lower_bounds1(optimizer, 0);
        nlopt_set_upper_bounds1(optimizer, 1);
        nlopt_set_maxeval(optimizer, evaluations);
        if (algorithm == NLOPT_LN_SBPLX) nlopt_set_initial_step1(optimizer, 0.05);
        Shares found = place;
        if (nlopt_optimize(optimizer, found.data(), &least) > 0) place = found;
        nlopt_destroy(optimizer);
    }
#endif
    return place;
}

}  // namespace nezumi
