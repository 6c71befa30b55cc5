// A system of scripts in files of their own, for the tests of hot reload.
#pragma once

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/reload/reloader.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

namespace fs = std::filesystem;
using Text = std::string;
using Longs = std::vector<std::int32_t>;

// A system of scripts in files of their own.
struct ReloadRig {
    ReloadRig() { fs::create_directories(folder); }
    ~ReloadRig() { fs::remove_all(folder); }

    Text path(const Text& file) const { return (folder / file).string(); }
    void write(const Text& file, const Text& text) const { std::ofstream(path(file)) << text; }

    ScriptComponent& add(const Text& name, const Text& file, ParameterValues config = {}, Budget budget = {0.05}) {
        const ModuleFinder find = [this](std::string_view module, std::string_view) {
            return read_source(path(Text(module) + ".lua"));
        };
        auto loaded = ScriptComponent::load(name, read_source(path(file)).value(),
                                            {.budget = budget, .find_module = find, .chunks = &chunks});
        if (!loaded) FAIL(describe(loaded.error()));
        REQUIRE((*loaded)->parameters().set_all(config));
        ScriptComponent& component = **loaded;
        REQUIRE(system.add(std::move(*loaded)));
        if (!component.activate(system.now())) WARN("not active");
        return component;
    }
    ScriptComponent& add_text(const Text& name, const Text& text, ParameterValues config = {}) {
        write(name + ".lua", text);
        return add(name, name + ".lua", std::move(config));
    }

    void tick(int count = 1) {
        for (; count > 0; --count) {
            system.tick();
            reloader.after_tick();
        }
    }
    // Writes a new text and reloads it; the message when it is refused.
    Text change(const Text& file, const Text& text) {
        write(file, text);
        auto report = reload({path(file)});
        if (!report) return describe(report.error());
        notes = report->notes;
        return "";
    }
    // Both phases at once: of these files or, where there are none, of a text.
    Expected<ActResult> reload(const std::vector<Text>& of, const SourceText& text = {}) {
        FileSnapshot seen(files);
        const Project project = Project::of(path("system.lua"), {}, seen);
        const auto loaded = reloader.loader()(of, text, project);
        return reloader.commit(*loaded, project);
    }
    Expected<ActResult> reload_changed() { return reload(changed_files(reloader.loaded_files(), read_source)); }
    template <class T>
    T out(const Text& port) const {
        return system.port(port).value()->value().template get<T>();
    }
    bool said(const Text& part) const {
        for (const Text& line : log) {
            if (line.find(part) != Text::npos) return true;
        }
        return false;
    }

    // Messages show files by their names in the folder.
    struct InFolder final : ProjectFiles {
        explicit InFolder(fs::path working) : folder(std::move(working)) {}
        fs::path working_folder() const override { return folder; }
        Text what_is(const fs::path& path) const override { return disk().what_is(path); }
        std::vector<Text> names_in(const fs::path& path) const override { return disk().names_in(path); }
        Expected<Text> read(const fs::path& path, const Text& shown) const override { return disk().read(path, shown); }
        fs::path folder;
    };

    fs::path folder = fs::temp_directory_path() / ("nezumi_reload_" + std::to_string(::getpid()));
    InFolder files{folder};
    std::vector<Text> log, notes;
    ChunkCache chunks;
    System system{{}, [this](const LogLine& line) { log.push_back(line.component + ": " + line.text); }};
    Reloader reloader{system, chunks};
};

// A script that writes how often this version ran, and a total that a reload keeps.
inline Text counter(const Text& step, const Text& more = "") {
    return "local out = output('out', 'TimedLongSeq')\nlocal runs = 0\n" + more +
           "\nfunction on_execute()\n  runs = runs + 1\n  state.total = (state.total or 0) + " + step +
           "\n  out:write { runs, state.total }\nend\n";
}

}  // namespace nezumi
