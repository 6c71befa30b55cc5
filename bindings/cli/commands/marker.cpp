// `nezumi marker`: markers to print, to scale.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/draw/marker_sheet.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/world/arena_fields.hpp"
#include "sim/picture.hpp"

namespace nezumi::cli {
namespace {

constexpr double least_size = 0.005;  // [m] cells of less than a millimetre print badly

struct MarkerOptions {
    std::vector<std::string> ids;
    double size = MarkerSpec{}.size;
    std::string paper{draw::papers().front().name};
    std::string file;
};

Expected<std::vector<int>> read_ids(const std::vector<std::string>& words) {
    std::vector<int> ids;
    for (const std::string& word : words) {
        const auto id = number_in<int>(word);
        if (!id || *id < 0 || *id > last_tag) {
            return failure(
                fmt::format("marker: expected a whole number from 0 to {}, got '{}'", last_tag, shown(word)));
        }
        ids.push_back(*id);
    }
    return ids;
}

int write_markers(const MarkerOptions& options) {
    if (auto ok = need_simulation({{"marker", true}}); !ok) return refuse(ok.error());
    const auto ids = read_ids(options.ids);
    if (!ids) return refuse(ids.error());
    const auto paper = std::find_if(draw::papers().begin(), draw::papers().end(),
                                    [&](const draw::Paper& each) { return each.name == options.paper; });
    if (paper == draw::papers().end()) {
        std::vector<std::string_view> names;
        for (const draw::Paper& each : draw::papers()) names.push_back(each.name);
        return refuse(fmt::format("marker: there is no paper '{}'{}; known are {}", shown(options.paper),
                                  did_you_mean(options.paper, names), fmt::join(names, ", ")));
    }
    // Rounded down to whole millimetres; 1e-6 compensates for rounding errors.
    if (const double largest = std::floor(draw::largest_marker(*paper) * 1000 + 1e-6) / 1000; options.size > largest) {
        return refuse(fmt::format("marker: {} m does not fit on {}: the largest marker on it is {:.3f} m", options.size,
                                  paper->name, largest));
    }
    if (options.file.empty() && isatty(STDOUT_FILENO) != 0)
        return refuse("marker: a PDF can't be shown on a terminal: write `> tag.pdf`, or `-o tag.pdf`");
    std::vector<draw::PrintedTag> tags;
    for (const int id : *ids) tags.push_back({id, sim::paint_tag(id)});
    const auto pdf = draw::marker_pdf(*paper, tags, options.size);
    if (!pdf) return refuse(pdf.error());
    if (options.file.empty()) {
        put_text(stdout, *pdf);
        return exit_done;
    }
    const auto written = write_whole(options.file, *pdf);
    return written ? exit_done : refuse(written.error());
}

}  // namespace

SubCommand marker_command() {
    auto options = std::make_shared<MarkerOptions>();
    return {.name = "marker",
            .help = "Write markers to print, as PDF to scale",
            .options = {{"ID", &options->ids,
                         fmt::format("of AprilTag's family 36h11, 0 to {}; a page for each", last_tag)},
                        {"--size", &options->size, "the edge of the black border [m], as in the system file", "M",
                         number_from(least_size, 1)},
                        {"--paper", &options->paper, "what it is printed on", "A4|A5|A3|letter"},
                        {"-o,--output",
                         &options->file,
                         "write this file (default: standard output)",
                         "FILE.pdf",
                         {},
                         FileUse::result}},
            .run = [options] { return write_markers(*options); },
            .footer =
                "For example `nezumi marker 7 --size 0.1 > tag.pdf`. Print it without scaling (\"actual size\", "
                "not \"fit to page\"):\nthe line below the marker says how long it has to be. The white margin "
                "around the black border belongs to the marker."};
}

}  // namespace nezumi::cli
