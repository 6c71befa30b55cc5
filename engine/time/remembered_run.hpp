// Data for the time line of a run, without computing the run again: positions of robots and things, collisions, errors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "engine/system/system.hpp"
#include "engine/time/run_history.hpp"

namespace nezumi {

class RememberedRun {
public:
    /// Rows per second of simulated time, at most one a tick [Hz].
    static constexpr double rate = 20;
    /// Memory for all rows [bytes]. If they need more, the oldest are dropped.
    static constexpr std::size_t most_bytes = std::size_t{64} << 20;
    /// The largest number of marks of a branch; further ones are not kept.
    static constexpr std::size_t most_marks = 1000;

    /// The true pose of a simulated robot [m, rad]; of a real one, its odometry.
    struct Pose {
        float x = 0, y = 0, heading = 0;
    };
    /// A thing of the arena that has moved, by its index in the world's things.
    struct MovedThing {
        std::size_t index = 0;
        Pose3D pose{};
    };
    /// The robots at one time, in their order in the system, and the things that have moved since the row before.
    /// The row before the first movement of a thing has its first pose.
    struct Row {
        ActTime when{};
        std::vector<Pose> robots{};
        std::vector<MovedThing> things{};
    };
    struct Mark {
        enum class Kind : unsigned char { error, collision };
        ActTime when{};
        Kind kind = Kind::error;
        std::string text{};  ///< "mouse touches wall"
    };

    /// Call this after each tick of the present. Moments that are known already are not stored again. `generation` is
    /// that of the running system: if it has changed, collisions and errors of this tick are not marked, because they
    /// may be older.
    void note(std::size_t branch, const ActTime& now, int generation, const System& system);
    /// The rows of a branch and of its parents before it, of one start: at most `most` (0: all), spread evenly.
    std::vector<Row> rows(const RunHistory& history, std::size_t branch, int start, std::size_t most) const;
    std::vector<Mark> marks(const RunHistory& history, std::size_t branch, int start) const;
    /// Memory of its rows [bytes].
    std::size_t bytes() const { return bytes_; }

private:
    struct Branch {
        std::deque<Row> rows{};
        std::vector<Mark> marks{};
        ActTime noted{.start = 0};  // latest stored time
    };
    void note_marks(Branch& branch, const ActTime& now, bool is_new, const System& system);
    void note_row(Branch& branch, const ActTime& now, const System& system);
    void note_things(Branch& branch, Row& row, const World& world);
    void drop_oldest();

    std::deque<Branch> branches_;
    std::size_t bytes_ = 0;
    int generation_ = 0;
    std::vector<Pose3D> things_;  // poses in the last row
    int things_generation_ = 0;
    std::vector<bool> touching_;  // by index of the robot: whether it touched something in the last tick
    std::vector<bool> failed_;    // by index of the component: whether it was in ERROR
};

}  // namespace nezumi
