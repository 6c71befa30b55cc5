// Compares a driver's writes with those of a log: the same values at about the same time.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace nezumi::hw {

/// Two runs never have exactly the same times, and a ramp has different steps in each run. So a write matches if,
/// within `window` of its time, the other run had the same text in that file, or a smaller and a larger number.
class WriteComparison {
public:
    struct Write {
        double tm = 0;  ///< [s]
        std::string text;
        int line = 0;  ///< line of the log; 0: written now
    };
    using Writes = std::map<std::string, std::vector<Write>, std::less<>>;  ///< by path, in order of time

    static constexpr double window = 0.2;  ///< [s]
    /// Two numbers differ if their distance is more than `part` times the larger one, and more than `least`.
    static constexpr double part = 0.1, least = 5;

    /// `file` is the log's name; its writes from `start` to `end` [s] are compared.
    WriteComparison(std::string file, Writes logged, double start, double end)
        : file_(std::move(file)), start_(start), end_(end), logged_(std::move(logged)) {}

    /// Records a write. `tm` must not be smaller than in any earlier call, for any file.
    void wrote(const std::string& path, double tm, std::string text);
    /// Moves all earlier writes later by `seconds`, because the clock was set.
    void move_written(double seconds);
    /// Compares everything that can be decided at `now` [s]. Returns one line per file at the start of a difference.
    std::vector<std::string> compare(double now);

    int compared() const { return compared_; }
    int differences() const { return differences_; }

private:
    struct Progress {
        std::size_t logged = 0, written = 0;  // number of writes already compared
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
