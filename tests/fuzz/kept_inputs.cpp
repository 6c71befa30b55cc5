// Gives kept inputs to their fuzzer without libFuzzer, so that every build and compiler tries them: each as it is, cut
// short, and with bytes changed at random, the same each time.
// Usage: fuzz_kept_inputs NAME PATH...     files, and folders with all that is in them
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#define FUZZER(name) extern "C" int fuzz_##name(const std::uint8_t*, std::size_t);
#include "fuzzers.inc"
#undef FUZZER

namespace {

using Fuzzer = int (*)(const std::uint8_t*, std::size_t);
using Bytes = std::vector<std::uint8_t>;

const std::map<std::string_view, Fuzzer> fuzzers{
#define FUZZER(name) {#name, fuzz_##name},
#include "fuzzers.inc"
#undef FUZZER
};

constexpr std::size_t cuts = 16;
constexpr int changes = 64;
constexpr int changed_bytes = 3;
constexpr std::size_t longest = 20'000;  // [bytes] what is longer is tried as it is alone

Bytes bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// A fuzzer ends the program when something does not hold.
int give(Fuzzer fuzzer, const Bytes& whole) {
    fuzzer(whole.data(), whole.size());
    if (whole.empty() || whole.size() > longest) return 1;
    for (std::size_t i = 0; i < cuts; ++i) fuzzer(whole.data(), whole.size() * i / cuts);
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
    std::uniform_int_distribution<int> byte(0, 255);
    for (int i = 0; i < changes; ++i) {
        Bytes changed = whole;
        for (int j = 0; j < changed_bytes; ++j) changed[place(random)] = static_cast<std::uint8_t>(byte(random));
        fuzzer(changed.data(), changed.size());
    }
    return 1 + static_cast<int>(cuts) + changes;
}

}  // namespace

int main(int argc, char** argv) {
    const auto fuzzer = argc > 2 ? fuzzers.find(argv[1]) : fuzzers.end();
    if (fuzzer == fuzzers.end()) {
        std::fprintf(stderr, "usage: fuzz_kept_inputs NAME PATH...\n");
        return 2;
    }
    std::vector<std::filesystem::path> files;
    for (int i = 2; i < argc; ++i) {
        const std::filesystem::path path = argv[i];
        if (!std::filesystem::is_directory(path))
            files.push_back(path);
        else
            for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
                if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    int inputs = 0;
    for (const auto& file : files) {
        std::printf("%s\n", file.c_str());
        std::fflush(stdout);  // the last one named is the one at fault
        inputs += give(fuzzer->second, bytes_of(file));
    }
    std::printf("%d inputs of %zu files\n", inputs, files.size());
    return inputs > 0 ? 0 : 1;
}
