// Sounds of simulated robots as files.
#include <catch2/catch.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "engine/world/tone.hpp"
#include "sim/sound_files.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::sim;
namespace fs = std::filesystem;

namespace {

struct Folder : Scratch {
    std::string read(const std::string& name) const { return text_of_file(path(name)); }
    // A program that replaces espeak-ng.
    std::string program(const std::string& script) const {
        const fs::path file = write("speaker", "#!/bin/sh\n" + script + "\n");
        fs::permissions(file, fs::perms::owner_all);
        return file.string();
    }
};

Sound speech(const std::string& text) { return {Sound::Kind::speech, 0, 0, text}; }

std::uint32_t number(const std::string& bytes, std::size_t at, int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) {
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]))
                 << (8 * i);
    }
    return value;
}

int sample(const std::string& wav, std::size_t i) { return static_cast<std::int16_t>(number(wav, 44 + 2 * i, 2)); }

}  // namespace

TEST_CASE("a tone is a WAV of its length and its frequency", "[sim][sound]") {
    const std::string wav = tone_as_wav(441, 0.5);
    CHECK(wav.substr(0, 4) == "RIFF");
    CHECK(wav.substr(8, 8) == "WAVEfmt ");
    CHECK(number(wav, 4, 4) == wav.size() - 8);
    CHECK(number(wav, 24, 4) == 22'050);
    CHECK(number(wav, 40, 4) == wav.size() - 44);
    const std::size_t count = (wav.size() - 44) / 2;
    CHECK(count == 11'025);
    int rises = 0, loudest = 0;
    for (std::size_t i = 1; i < count; ++i) {
        if (sample(wav, i - 1) < 0 && sample(wav, i) >= 0) ++rises;
        loudest = std::max(loudest, std::abs(sample(wav, i)));
    }
    CHECK(rises == Approx(441 * 0.5).margin(1));
    CHECK(loudest > 9000);
    CHECK(loudest < 10'000);
    CHECK(std::abs(sample(wav, 0)) < 10);
    const std::string pause = tone_as_wav(0, 0.1);
    for (std::size_t i = 0; i < (pause.size() - 44) / 2; ++i) REQUIRE(sample(pause, i) == 0);
}

TEST_CASE("sounds are numbered for each robot, and texts are stored beside them unchanged", "[sim][sound]") {
    const Folder folder;
    const std::string odd = "it's \"odd\"; $(touch pwned) `touch pwned`\n| & <b>-w /etc/passwd";
    const std::string program = folder.program("[ \"$1 $2 $3 $4\" = '-b 1 --stdin -w' ] && exec cat > \"$5\"");
    std::vector<std::string> warnings;
    {
        SoundFiles files(
            folder.path(), [&](const std::string& why) { warnings.push_back(why); }, program);
        files.play("ev3", {Sound::Kind::tone, 440, 0.2, {}});
        files.play("other", speech("hello"));
        files.play("ev3", speech(odd));
        files.play("ev3", speech("-v"));
    }
    CHECK(warnings.empty());
    CHECK(folder.read("ev3-0001.wav") == tone_as_wav(440, 0.2));
    CHECK_FALSE(fs::exists(folder.path("ev3-0001.txt")));
    CHECK(folder.read("other-0001.txt") == "hello");
    CHECK(folder.read("other-0001.wav") == "hello");
    CHECK(folder.read("ev3-0002.txt") == odd);
    CHECK(folder.read("ev3-0002.wav") == odd);
    CHECK(folder.read("ev3-0003.wav") == "-v");
    CHECK_FALSE(fs::exists("pwned"));
    CHECK_FALSE(fs::exists(folder.path("pwned")));
}

TEST_CASE("without a speech program the texts are kept, with one warning", "[sim][sound]") {
    const Folder folder;
    std::vector<std::string> warnings;
    {
        SoundFiles files(
            folder.path(), [&](const std::string& why) { warnings.push_back(why); }, "no-such-speaker");
        files.play("ev3", speech("one"));
        files.play("ev3", speech("two"));
    }
    CHECK(warnings == std::vector<std::string>{"no-such-speaker is not installed: speech becomes text files only "
                                               "(sudo apt install espeak-ng)"});
    CHECK(folder.read("ev3-0002.txt") == "two");
    CHECK_FALSE(fs::exists(folder.path("ev3-0002.wav")));
}

TEST_CASE("if a speech program fails, only its sound is missing", "[sim][sound]") {
    const Folder folder;
    std::vector<std::string> warnings;
    {
        SoundFiles files(
            folder.path(), [&](const std::string& why) { warnings.push_back(why); }, folder.program("exit 3"));
        files.play("ev3", speech("one"));
        files.play("ev3", {Sound::Kind::tone, 440, 0.1, {}});
    }
    CHECK(warnings == std::vector<std::string>{folder.path("speaker").string() + " did not write '" +
                                               folder.path("ev3-0001.wav").string() + "': it ended with status 3"});
    CHECK(fs::exists(folder.path("ev3-0002.wav")));
}

TEST_CASE("a sound does not wait for the one before", "[sim][sound][wallclock]") {
    const Folder folder;
    std::vector<std::string> warnings;
    {
        SoundFiles files(
            folder.path(), [&](const std::string& why) { warnings.push_back(why); }, folder.program("sleep 0.5"));
        const auto begin = std::chrono::steady_clock::now();
        for (int i = 0; i < 3; ++i) files.play("ev3", speech("slow"));
        CHECK(std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(400));
        // Until the thread takes the first one, all others wait.
        for (std::size_t i = 0; i < SoundFiles::most_waiting; ++i) files.play("ev3", {Sound::Kind::tone, 0, 0, {}});
        files.tell();
        CHECK(warnings.size() >= 1);
        CHECK(warnings.front() == "sounds come faster than they can be written: some are dropped");
    }
}

TEST_CASE("espeak-ng speaks a text into a WAV", "[sim][sound]") {
    const Folder folder;
    std::vector<std::string> warnings;
    {
        SoundFiles files(folder.path(), [&](const std::string& why) { warnings.push_back(why); });
        files.play("ev3", speech("hello \"world\"; $(nothing)\n-x"));
    }
    CHECK(warnings.empty());
    const std::string wav = folder.read("ev3-0001.wav");
    REQUIRE(wav.size() > 10'000);
    CHECK(wav.substr(0, 4) == "RIFF");
}
