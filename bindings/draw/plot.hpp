// A plot of ports' values over time, with limits as horizontal and moments as vertical lines.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::draw {

struct Plot {
    struct Point {
        double seconds;  ///< simulated time
        double value;    ///< a value that is not finite makes a gap
    };
    struct Series {
        std::string name;           ///< as in "mouse.ir_sensor_out[1]"
        std::vector<Point> points;  ///< in the order of time
    };
    struct Limit {
        std::string name;  ///< "" for none
        double value;
    };
    struct Moment {
        std::string name;
        double seconds;
    };

    std::string title;
    std::vector<Series> series;
    std::vector<Limit> limits;
    std::vector<Moment> moments;
};

/// Draws the plot to a file that ends in .png or .svg. The error says why the file can't be written; then there is no
/// file.
Expected<void> draw_plot(const Plot& plot, const std::string& file);

}  // namespace nezumi::draw
