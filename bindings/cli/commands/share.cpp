// `nezumi share`: a past run as one HTML file, with the engine in it.
#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/run_file.hpp"
#include "bindings/journal/replay.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::cli {
namespace {

constexpr std::size_t largest_page = std::size_t{1} << 24;  // [bytes] without the run
constexpr std::string_view place_of_run = "<!-- the run -->";

struct ShareOptions {
    std::string run, output;
};

// The page as .ci/web makes it, beside the program or among its sources.
Expected<std::string> read_page() {
    std::error_code none;
    for (const std::filesystem::path& folder : installed_folders()) {
        for (const char* const within : {"web/run.html", "build/web/run.html"}) {
            const std::filesystem::path file = folder / within;
            if (std::filesystem::is_regular_file(file, none)) return read_whole(file, file.string(), largest_page);
        }
    }
    return failure("share: the engine for web pages is not installed: build it by .ci/web");
}

// A text of JSON within a page: no part of it may look like the end of its element.
std::string json_in_page(const std::string& text) {
    std::string safe;
    for (const char each : json_text(text)) {
        if (each == '<') {
            safe += "\\u003c";
        } else {
            safe += each;
        }
    }
    return safe;
}

Expected<void> share(const ShareOptions& options) {
    const auto journal = read_run(options.run);
    if (!journal) return Unexpected(journal.error());
    if (auto known = Replay::of_text(*journal, options.run, version()); !known) return Unexpected(known.error());
    auto page = read_page();
    if (!page) return Unexpected(page.error());
    const std::size_t place = page->find(place_of_run);
    if (place == std::string::npos)
        return failure("share: the engine for web pages is of another version: build it by .ci/web");
    page->replace(place, place_of_run.size(),
                  fmt::format("<script id=\"run\" type=\"application/json\">{}</script>", json_in_page(*journal)));
    return write_whole(options.output, *page);
}

}  // namespace

SubCommand share_command() {
    auto options = std::make_shared<ShareOptions>();
    options->output = "run.html";
    return {.name = "share",
            .help = "Write a past run as one HTML file that plays it anywhere, with the engine in it",
            .options = {{"RUN", &options->run, "a journal, or a recording in MCAP", "", {}, FileUse::source},
                        {"-o,--output", &options->output, "the file to write", "PAGE.html", {}, FileUse::result}},
            .run =
                [options] {
                    const auto done = share(*options);
                    return done ? exit_done : refuse(done.error());
                },
            .footer =
                "A browser opens the file without a server and without a network. It is paused at the end of the run: "
                "the time\n"
                "line goes to any moment of it, and a change starts a branch. It contains the files of the run."};
}

}  // namespace nezumi::cli
