// A robot's loudspeaker: the programs it runs, their input, and the messages if they are missing.
#include "hw/sound/speaker.hpp"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

#include "engine/world/tone.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// A folder of programs as the whole PATH.
struct Programs {
    explicit Programs(const std::vector<std::string>& installed, const std::string& player_does = "") {
        // Each program stores its arguments and its input; the synthesizer's speech is its input.
        const std::string keep = "i=$(ls \"$0\".* 2>/dev/null | wc -l)\nprintf '%s\\n' \"$*\" > \"$0.$i\"\n";
        for (const std::string& name : installed) {
            if (name == "the real espeak-ng") {
                link("espeak-ng");
            } else {
                const bool speaks = name.starts_with("espeak");
                put(name, "#!/bin/sh\n" + keep + (speaks ? "tee -a \"$0.$i\"\n" : "cat >> \"$0.$i\"\n" + player_does));
            }
        }
        for (const char* tool : {"cat", "ls", "sleep", "tee", "wc"}) link(tool);
        setenv("PATH", folder.path("").c_str(), 1);
    }
    ~Programs() { setenv("PATH", path.c_str(), 1); }
    Programs(const Programs&) = delete;
    Programs& operator=(const Programs&) = delete;

    // The arguments on the first line, then the input, of the call with this number.
    std::string call(const std::string& program, int number) const {
        std::ifstream file(folder.path(program + "." + std::to_string(number)), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    const Scratch folder;

private:
    void link(const std::string& tool) {
        for (const char* place : {"/usr/bin/", "/bin/"}) {
            const std::string program = place + tool;
            if (access(program.c_str(), X_OK) != 0) continue;
            std::filesystem::create_symlink(program, folder.path(tool));
            return;
        }
    }
    void put(const std::string& name, const std::string& text) {
        folder.write(name, text);
        chmod(folder.path(name).c_str(), 0755);
    }
    const std::string path = std::getenv("PATH");
};

Sound tone(double hertz, double seconds) { return {Sound::Kind::tone, hertz, seconds, {}}; }
Sound speech(const std::string& text) { return {Sound::Kind::speech, 0, 0, text}; }

// Lets it process all that waits.
void serve(Speaker& speaker) {
    while (speaker.run() == 0) continue;
}

}  // namespace

TEST_CASE("a tone is played by ALSA's player, on the device that the robot file says", "[hw][sound]") {
    const Programs programs({"aplay"});
    Speaker speaker("plughw:1");
    speaker.play(tone(880, 0.1));
    speaker.play(tone(0, 0.05));
    serve(speaker);
    CHECK(programs.call("aplay", 0) == "-q -D plughw:1\n" + tone_as_wav(880, 0.1));
    CHECK(programs.call("aplay", 1) == "-q -D plughw:1\n" + tone_as_wav(0, 0.05));
    CHECK(speaker.take_faults().empty());
}

TEST_CASE("spoken text goes to the synthesizer's standard input, not through a shell", "[hw][sound][safety]") {
    const Programs programs({"aplay", "espeak-ng"});
    const std::string text = "-w x.wav; $(touch gone) `id` \"quoted\" 'é'";
    Speaker speaker;
    speaker.play(speech(text));
    serve(speaker);
    CHECK(programs.call("espeak-ng", 0) == "-b 1 --stdin --stdout\n" + text);
    CHECK(programs.call("aplay", 0) == "-q\n" + text);
    CHECK(speaker.take_faults().empty());
}

TEST_CASE("a missing player is reported once with what to do, and the robot is silent", "[hw][sound]") {
    Speaker speaker;
    {
        const Programs programs({});
        for (int i = 0; i < 3; ++i) speaker.play(tone(440, 0.01));
        speaker.play(speech("hello"));
        serve(speaker);
        CHECK(speaker.take_faults() ==
              std::vector<std::string>{"loudspeaker: aplay is not installed: sudo apt install alsa-utils",
                                       "speech: espeak-ng is not installed: sudo apt install espeak-ng"});
    }
    const Programs programs({"aplay", "espeak"});
    speaker.play(speech("hello"));  // older systems have the older one
    serve(speaker);
    CHECK(programs.call("espeak", 0) == "-b 1 --stdin --stdout\nhello");
    std::vector<std::string> told;
    CHECK(FakeRobot::wait_until(
        [&] {
            append(told, speaker.take_faults());
            return told.size() == 2;
        },
        Health::proven_after + 5));
    std::sort(told.begin(), told.end());
    CHECK(told == std::vector<std::string>{"loudspeaker: back again", "speech: back again"});
}

TEST_CASE("a player that fails is reported once with what to check", "[hw][sound]") {
    const Programs programs({"aplay"}, "exit 1\n");
    Speaker speaker;
    speaker.play(tone(440, 0.01));
    speaker.play(tone(440, 0.01));
    serve(speaker);
    CHECK(
        speaker.take_faults() ==
        std::vector<std::string>{"loudspeaker: aplay: it ended with status 1: is there a sound card (aplay -l), and is "
                                 "this user in group audio?"});
}

TEST_CASE("sounds that come faster than they are played are dropped, and reported once", "[hw][sound]") {
    const Programs programs({"aplay"});
    Speaker speaker;
    for (std::size_t i = 0; i < Speaker::most_waiting + 5; ++i) speaker.play(tone(440, 0));
    CHECK(speaker.take_faults() ==
          std::vector<std::string>{"loudspeaker: sounds come faster than they can be played: some are dropped"});
    serve(speaker);
    CHECK(!programs.call("aplay", Speaker::most_waiting - 1).empty());
    CHECK(programs.call("aplay", Speaker::most_waiting).empty());
}

TEST_CASE("a removed robot does not wait for the end of its sound", "[hw][sound][wallclock]") {
    const Programs programs({"aplay"}, "exec sleep 20\n");
    const double before = clock_seconds();
    {
        Loudspeaker loudspeaker{RobotSpec{}};
        loudspeaker.play(tone(440, 0.01));
        CHECK(FakeRobot::wait_until([&] { return !programs.call("aplay", 0).empty(); }, 5));
    }
    CHECK(clock_seconds() - before < 3);
}

TEST_CASE("silencing a robot ends the present sound and drops waiting ones; later sounds play",
          "[hw][sound][safety][wallclock]") {
    const Programs programs({"aplay"}, "case $i in 0) exec sleep 20;; esac\n");
    Loudspeaker loudspeaker{RobotSpec{}};
    loudspeaker.play(tone(440, 0.01));
    loudspeaker.play(tone(550, 0.01));
    REQUIRE(FakeRobot::wait_until([&] { return !programs.call("aplay", 0).empty(); }, 5));
    const double before = clock_seconds();
    loudspeaker.silence();
    loudspeaker.play(tone(660, 0.01));
    CHECK(FakeRobot::wait_until([&] { return programs.call("aplay", 1) == "-q\n" + tone_as_wav(660, 0.01); }, 5));
    CHECK(clock_seconds() - before < 3);
    sleep_for(0.2);
    CHECK(programs.call("aplay", 2).empty());
    CHECK(loudspeaker.take_faults().empty());
}

TEST_CASE("the real synthesizer makes speech that a player takes", "[hw][sound][wallclock]") {
    if (std::system("command -v espeak-ng > /dev/null") != 0)
        throw std::runtime_error("SKIPPED: espeak-ng is not installed: sudo apt install espeak-ng");
    const Programs programs({"aplay", "the real espeak-ng"});
    Speaker speaker;
    speaker.play(speech("hello"));
    serve(speaker);
    CHECK(programs.call("aplay", 0).starts_with("-q\nRIFF"));
    CHECK(programs.call("aplay", 0).size() > 10000);
    CHECK(speaker.take_faults().empty());
}

TEST_CASE("an EV3 beeps and speaks by its port, one after the other", "[hw][ev3][sound][fakes][threads][wallclock]") {
    const Programs programs({"aplay", "espeak-ng"});
    FakeEv3 fake;
    DrivenEv3 ev3(fake);
    auto& port = static_cast<InPort<std::string>&>(*ev3.robot->find_in_port("sound"));
    for (const char* told : {"beep", "tone,660,50", "hello"}) port.inject(std::string(told));
    CHECK(ev3.idle(5, [&] { return programs.call("aplay", 2) == "-q\nhello"; }));
    CHECK(programs.call("aplay", 0) == "-q\n" + tone_as_wav(440, 0.2));
    CHECK(programs.call("aplay", 1) == "-q\n" + tone_as_wav(660, 0.05));
    INFO(ev3.all_log());
    CHECK(ev3.log.empty());
}
