// `nezumi share`: a past run as one HTML file, which contains the engine or the recorded values.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/version.hpp"
#include "bindings/cli/commands/commands.hpp"
#include "bindings/cli/files/run_file.hpp"
#include "bindings/journal/base64.hpp"
#include "bindings/journal/replay.hpp"
#include "bindings/record/gzip.hpp"
#include "bindings/web/light_run.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {
namespace {

constexpr std::size_t largest_page = std::size_t{1} << 24;  // [bytes] without the run
constexpr std::size_t largest_light_page = 800'000;         // [bytes] with the run
constexpr std::string_view place_of_run = "<!-- the run -->";

struct ShareOptions {
    std::string run, output;
    bool light = false;
};

// Reads a page that .ci/web made, from the installed files or from the build folder. Returns the parts before and after
// the run.
Expected<std::pair<std::string, std::string>> read_page(const char* name) {
    std::error_code none;
    for (const std::filesystem::path& folder : installed_folders()) {
        for (const char* const within : {"web", "build/web/site"}) {
            const std::filesystem::path file = folder / within / name;
            if (!std::filesystem::is_regular_file(file, none)) continue;
            const auto page = read_whole(file, file.string(), largest_page);
            if (!page) return Unexpected(page.error());
            const std::size_t place = page->find(place_of_run);
            if (place == std::string::npos)
                return failure("share: the engine for web pages is of another version: build it by .ci/web");
            return std::pair(page->substr(0, place), page->substr(place + place_of_run.size()));
        }
    }
    return failure("share: the engine for web pages is not installed: build it by .ci/web");
}

std::string packed(std::string_view run) {
    return fmt::format("<script id=\"run\" type=\"text/plain\">{}</script>", to_base64(record::gzipped(run)));
}

// The run as text, with as many frames as fit into `most` bytes.
Expected<std::string> fitting(web::LightRun& run, const std::string& file, std::size_t most) {
    // Each number takes about one byte or more, so smaller steps need not be tried.
    for (std::size_t step = 1 + run.numbers() / most; step < run.frames() + 2;) {
        std::string text = packed(run.text(version(), step));
        if (text.size() <= most) return text;
        step = std::max(step + 1, step * text.size() / most);
    }
    return failure(
        fmt::format("share: {} does not fit into {} KB: leave out --light", file, largest_light_page / 1000));
}

// Repeats the run, and notes each tick for the page.
Expected<std::string> light(const std::string& journal, const std::string& file, std::size_t most) {
    const auto replay = Replay::of_text(journal, file, version());
    if (!replay) return Unexpected(replay.error());
    web::LightRun* notes = nullptr;
    LiveOptions options = simulated_systems();
    options.build.log = [&notes](const LogLine& line) {
        if (notes != nullptr) notes->log(line);
    };
    const auto live = (*replay)->load(std::move(options));
    if (!live) return Unexpected(live.error());
    (*live)->remember_run();
    const RunLoop loop(**live, {});
    web::LightRun run(**live, loop);
    notes = &run;
    (*live)->activate();
    for (;;) {
        const auto more = (*replay)->before_tick(**live);
        if (!more) return Unexpected(more.error());
        run.note();
        if (!*more) break;
        (*live)->tick();
    }
    notes = nullptr;
    return fitting(run, file, most);
}

Expected<void> share(const ShareOptions& options) {
    if (auto ok = need_simulation({{"--light", options.light}}); !ok) return ok;
    const auto journal = read_run(options.run);
    if (!journal) return Unexpected(journal.error());
    if (auto known = Replay::of_text(*journal, options.run, version()); !known) return Unexpected(known.error());
    const auto page = read_page(options.light ? "light_run.html" : "run.html");
    if (!page) return Unexpected(page.error());
    const auto& [before, after] = *page;
    if (!options.light) return write_whole(options.output, before + packed(*journal) + after);
    const std::size_t own = before.size() + after.size();
    const auto run = light(*journal, options.run, largest_light_page - std::min(own, largest_light_page));
    if (!run) return Unexpected(run.error());
    return write_whole(options.output, before + *run + after);
}

}  // namespace

SubCommand share_command() {
    auto options = std::make_shared<ShareOptions>();
    options->output = "run.html";
    return {
        .name = "share",
        .help = "Write a past run as one HTML file that plays it anywhere",
        .options = {{"RUN", &options->run, "a journal, or a recording in MCAP", "", {}, FileUse::source},
                    {"-o,--output", &options->output, "the file to write", "PAGE.html", {}, FileUse::result},
                    {"--light", &options->light, "without the engine: less than 800 KB, to look at and not to change"}},
        .run =
            [options] {
                const auto done = share(*options);
                return done ? exit_done : refuse(done.error());
            },
        .footer =
            "A browser opens the file without a server and without a network. It has the engine in it and is paused "
            "at the\nend of the run: the time line goes to any moment of it, and a change starts a branch. It "
            "contains the files of\nthe run; with --light it has only positions and the values of ports."};
}

}  // namespace nezumi::cli
