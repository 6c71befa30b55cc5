// Commands that write files: the system, a picture of the world, a graph of the connections.
#include <optional>
#include <string>

#include "bindings/console/console_commands.hpp"
#include "bindings/console/file_to_write.hpp"
#include "bindings/console/save_system.hpp"

namespace nezumi {
namespace {

Expected<CommandEnd> draw(Session::Parts& parts, const Arguments& arguments, Drawn what, const WrittenFile& written) {
    if (!parts.options.drawing_maker) return failure("this program can't draw: use `nezumi run`");
    const auto name = arguments.text(1, "the name of a file, as in " + std::string(written.word) + " \"x" +
                                            std::string(written.endings.front()) + "\"");
    if (!name) return Unexpected(name.error());
    const auto home = parts.at_system([&] { return writable_folder(parts.live.project(), parts.live.spec().file); });
    if (home.empty()) return failure("interrupted");
    const auto file = file_to_write(home, *name, written);
    if (!file) return Unexpected(file.error());
    const Drawing drawing = parts.at_system([&] { return parts.options.drawing_maker(what); });
    if (!drawing) return failure("interrupted");
    if (auto drawn = drawing(file->string()); !drawn) return Unexpected(drawn.error());
    parts.show("wrote " + file->string());
    return CommandEnd::done;
}

}  // namespace

Expected<CommandEnd> command_save(Session::Parts& parts, const Arguments& arguments) {
    const auto file = arguments.text(1, "the name of a file, as in save \"system.lua\"");
    if (!file) return Unexpected(file.error());
    if (file->ends_with(".xml") || file->ends_with(".yaml")) {
        return draw(parts, arguments, Drawn::profile,
                    {.word = "save", .file = "a profile", .what = "a system", .endings = {".xml", ".yaml"}});
    }
    auto present = parts.at_system([&] { return std::make_optional(present_system(parts.live)); });
    if (!present) return failure("interrupted");
    if (!*present) return Unexpected(present->error());
    const auto done = save_system(std::move(**present), *file);
    if (!done) return Unexpected(done.error());
    parts.show(*done);
    return CommandEnd::done;
}

Expected<CommandEnd> command_picture(Session::Parts& parts, const Arguments& arguments) {
    return draw(parts, arguments, Drawn::world,
                {.word = "picture", .file = "a picture", .what = "it", .endings = {".png", ".svg"}});
}

Expected<CommandEnd> command_graph(Session::Parts& parts, const Arguments& arguments) {
    return draw(parts, arguments, Drawn::wiring,
                {.word = "graph", .file = "a graph", .what = "it", .endings = {".svg", ".png"}});
}

}  // namespace nezumi
