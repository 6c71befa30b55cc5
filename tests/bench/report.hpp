// What every benchmark prints and measures with: settings, machine and commit; CPU time; medians of rounds.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace nezumi::bench {

/// What `git describe` says of the sources, or "unknown" where there is no git or no repository.
inline std::string commit() {
    std::string text;
    const std::string command = "git -C '" NEZUMI_SOURCE_ROOT "' describe --always --dirty --tags 2>/dev/null";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    for (int c = 0; pipe != nullptr && (c = std::fgetc(pipe.get())) != EOF && c != '\n';) text += static_cast<char>(c);
    return text.empty() ? "unknown" : text;
}

/// "Xeon at 2.1 GHz, 2 cores": the processor's own name and how many of its cores are ours.
inline std::string machine() {
    std::string model = "unknown processor";
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const auto colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) {
            model = line.substr(colon + 2);
            break;
        }
    }
    return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores";
}

/// Says what follows: to be called first by every benchmark.
inline void print_header(const std::string& title, const std::string& settings) {
#ifdef NDEBUG
    const char* build = "release";
#else
    const char* build = "with asserts: figures mean nothing";
#endif
    std::printf("%s\n  settings: %s\n  machine:  %s\n  commit:   %s (%s)\n\n", title.c_str(), settings.c_str(),
                machine().c_str(), commit().c_str(), build);
    std::fflush(stdout);
}

/// [s] of CPU time that this thread has used: others on this machine do not count.
inline double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// [s] of CPU time that `work()` takes on this thread.
template <class Work>
double time_of(const Work& work) {
    const double begin = thread_seconds();
    work();
    return thread_seconds() - begin;
}

inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// "ok" or "MISSED" for a figure that must not exceed its limit.
inline const char* verdict(double figure, double limit) { return figure <= limit ? "ok" : "MISSED"; }

}  // namespace nezumi::bench
