// What a driver writes now against what a log has: the same at about the same time?
#pragma once

#include <map>
#include <string>
#include <vector>

namespace nezumi::hw {

/// No two runs are in step to the millisecond, and a ramp has other steps each time. A write is like the other run's
/// when within `window` of it the other had the same text in its file, or numbers around it.
class WriteComparison {
public:
    struct Write {
        double tm = 0;  ///< [s]
        std::string text;
        int line = 0;  ///< of the log; 0: of now
    };
    using Writes = std::map<std::string, std::vector<Write>, std::less<>>;  ///< by path, in the order of their times

    static constexpr double window = 0.2;  ///< [s]
    /// Numbers differ when they are further apart than this part of the larger, and `least`.
    static constexpr double part = 0.1, least = 5;

    /// `file` is the log, of which the writes from `start` to `end` [s] are compared.
    WriteComparison(std::string file, Writes logged, double start, double end)
        : file_(std::move(file)), start_(start), end_(end), logged_(std::move(logged)) {}

    /// Written now. Times do not go back, of any file.
    void wrote(const std::string& path, double tm, std::string text);
    /// The clock was set: what was written so far was so much [s] later.
    void move_written(double seconds);
    /// Compares what can be decided at `now` [s]. What differs: a line where it begins, for each file.
    std::vector<std::string> compare(double now);

    int compared() const { return compared_; }
    int differences() const { return differences_; }

private:
    struct Progress {
        std::size_t logged = 0, written = 0;  // so many are compared
        bool differs = false;
    };
    void judge(Progress& progress, bool is_like, std::vector<std::string>& told, std::string line);
    std::string in_force(const std::vector<Write>& writes, double tm) const;

    const std::string file_;
    const double start_, end_;
    Writes logged_, written_;
    std::map<std::string, Progress, std::less<>> progress_;
    int compared_ = 0, differences_ = 0;
};

}  // namespace nezumi::hw
