// Where a colour's name ends and the next begins is as docs/system-files.md says.
#include "engine/world/floor_color.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/unit/file_text.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

// From the first number on, up to before the second; of hues it may go over 360.
struct Span {
    double from = 0, to = 1e9;

    bool contains(double value) const { return from <= to ? value >= from && value < to : value >= from || value < to; }
    // Too near to a border to say on which side the last bit lies.
    bool is_at_border(double value) const {
        return (from > 0 && std::abs(value - from) < 1e-9) || std::abs(value - to) < 1e-9;
    }
};

struct Row {
    std::string name;
    Span largest, saturation, hue;
};

// "330 to 12"; any number without text. `last` is the largest that there is, which counts as well.
Span span_of(const std::string& cell, double last) {
    const std::size_t middle = cell.find(" to ");
    if (middle == std::string::npos) return {};
    Span span{std::atof(cell.c_str()), std::atof(cell.c_str() + middle + 4)};
    if (span.to == last) span.to = 1e9;
    return span;
}

std::vector<Row> rows_of_page() {
    std::vector<Row> rows;
    bool inside = false;
    for (const std::string& line : lines_of(text_of_file(source_root() + "/docs/system-files.md"))) {
        if (line.starts_with("| colour | largest |")) {
            inside = true;
        } else if (inside && !line.starts_with("|")) {
            break;
        } else if (inside && line.starts_with("| `")) {
            std::vector<std::string> cells;
            for (std::size_t at = 1; at < line.size(); at = line.find('|', at) + 1)
                cells.push_back(line.substr(at, line.find('|', at) - at));
            REQUIRE(cells.size() == 4);
            const std::size_t begin = cells[0].find('`') + 1;
            rows.push_back({cells[0].substr(begin, cells[0].find('`', begin) - begin), span_of(cells[1], 255),
                            span_of(cells[2], 1), span_of(cells[3], 360)});
        }
    }
    return rows;
}

// [degrees] of parts that are not all the same, as textbooks have it.
double hue_of(int r, int g, int b) {
    const double largest = std::max({r, g, b}), range = largest - std::min({r, g, b});
    if (largest == r) return std::fmod(60 * (g - b) / range + 360, 360);
    return largest == g ? 120 + 60 * (b - r) / range : 240 + 60 * (r - g) / range;
}

}  // namespace

TEST_CASE("a colour of the floor has the name that the page says, on both sides of each border", "[engine][world]") {
    const std::vector<Row> rows = rows_of_page();
    REQUIRE(rows.size() > 8);
    // Every smallest and every middle part with a largest on both sides of each border: all saturations, all hues.
    std::vector<int> brightest{0, 255};
    for (const Row& row : rows) {
        for (const double border : {row.largest.from, row.largest.to}) {
            if (border > 0 && border < 256) {
                brightest.push_back(static_cast<int>(border));
                brightest.push_back(static_cast<int>(border) - 1);
            }
        }
    }
    std::sort(brightest.begin(), brightest.end());
    brightest.erase(std::unique(brightest.begin(), brightest.end()), brightest.end());
    std::string wrong;
    std::size_t tried = 0;
    const auto look = [&](int r, int g, int b) {
        const double largest = std::max({r, g, b}), smallest = std::min({r, g, b});
        const double saturation = largest > 0 ? (largest - smallest) / largest : 0;
        const double hue = largest > smallest ? hue_of(r, g, b) : 0;
        std::string expected;
        for (const Row& row : rows) {
            if (row.saturation.is_at_border(saturation) || row.hue.is_at_border(hue)) return;
            if (row.largest.contains(largest) && row.saturation.contains(saturation) && row.hue.contains(hue))
                expected += row.name;
        }
        ++tried;
        const std::string got(to_text(nearest_floor_color(static_cast<Rgb>(r << 16 | g << 8 | b))));
        if (got != expected && wrong.empty())
            wrong = std::to_string(r) + ", " + std::to_string(g) + ", " + std::to_string(b) + " is " + got +
                    ", the page says " + expected;
    };
    for (const int largest : brightest) {
        for (int smallest = 0; smallest <= largest; ++smallest) {
            for (int middle = smallest; middle <= largest; ++middle) {
                look(largest, middle, smallest);
                look(largest, smallest, middle);
                look(middle, largest, smallest);
                look(smallest, largest, middle);
                look(middle, smallest, largest);
                look(smallest, middle, largest);
            }
        }
    }
    CAPTURE(wrong);
    CHECK(wrong.empty());
    CHECK(tried > 450'000);
}
