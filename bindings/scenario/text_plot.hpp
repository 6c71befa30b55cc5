// A small plot made of characters, for messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// One curve: values over time, in ascending time.
struct PlotCurve {
    std::string name;
    char mark = '*';
    std::vector<double> times;   ///< [s]
    std::vector<double> values;  ///< as many; not finite: left out
};

/// Lines of at most `width` characters, `height` of them for the curves, with the range of values at the left and of
/// times below. A later curve is drawn over those before. Empty when there is nothing to draw.
std::vector<std::string> plot_text(const std::vector<PlotCurve>& curves, std::size_t width, std::size_t height);

}  // namespace nezumi
