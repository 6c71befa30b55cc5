// The recent curves of a channel in a trace, also as plain data for another host.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/trace/text_plot.hpp"
#include "engine/trace/trace.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

struct RecentCurves {
    std::string whole{};          ///< what is remembered: "controller.out"
    std::string part{};           ///< the part of it: "vx"; "" for all
    double first = 0;             ///< [s] time of the oldest sample; `now` if there is none
    double now = 0;               ///< [s] end of the curves
    std::vector<Curve> curves{};  ///< empty if the channel had no values that can be drawn
};

/// The values of this channel in the last `seconds` before `now` [s]. A channel that was not remembered before is
/// remembered from now on.
Expected<RecentCurves> recent_curves(Trace& trace, std::string_view name, double seconds, double now);

/// Converts curves to plain data; long curves are shortened to what a drawing can show.
PlainData to_plain(const RecentCurves& recent);
/// Reads the result of `to_plain`. `whole` and `part` stay empty, because plain data does not contain them.
Expected<RecentCurves> read_curves(const PlainData& data);

}  // namespace nezumi
