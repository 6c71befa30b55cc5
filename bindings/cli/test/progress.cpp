// Estimates the rest from the duration of finished runs.
#include "bindings/cli/test/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace nezumi::cli {
namespace {

constexpr std::chrono::seconds first_on_terminals{2};
constexpr std::chrono::milliseconds period_on_terminals{200};
constexpr std::chrono::seconds period_elsewhere{60};

}  // namespace

SweepProgress::SweepProgress(std::function<void(std::string_view)> write, bool live, Clock::time_point now)
    : write_(std::move(write)), live_(live), began_(now), next_(now + (live ? first_on_terminals : period_elsewhere)) {}

void SweepProgress::update(std::size_t done, std::size_t all, Clock::time_point now) {
    if (done == 0 || done >= all || now < next_) return;
    next_ = live_ ? now + period_on_terminals : now + period_elsewhere;
    const double took = std::chrono::duration<double>(now - began_).count();
    const double left = took / static_cast<double>(done) * static_cast<double>(all - done);
    const std::string line = fmt::format("{} of {} runs, {} left", done, all, text_of_duration(left));
    write_(live_ ? "\r\x1b[K" + line : line + "\n");
    shown_ = live_;
}

void SweepProgress::clear() {
    if (std::exchange(shown_, false)) write_("\r\x1b[K");
}

std::string text_of_duration(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(std::max(seconds, 0.0)));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

}  // namespace nezumi::cli
