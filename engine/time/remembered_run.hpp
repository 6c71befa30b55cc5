// What the time line of a run shows without computing it again: where robots were, and what went wrong when.
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
    /// [bytes] of all rows; when they are more, the oldest are dropped.
    static constexpr std::size_t most_bytes = std::size_t{64} << 20;
    /// Marks of a branch; further ones are not kept.
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
    /// Before its first movement a thing is in one row as well.
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

    /// Call this after each tick of the present. What is known already is not kept again. `generation` is the one of
    /// the running system: after a change, nothing has begun to touch in this tick.
    void note(std::size_t branch, const ActTime& now, int generation, const System& system);
    /// The rows of a branch and of its parents before it, of one start: at most `most`, spread evenly.
    std::vector<Row> rows(const RunHistory& history, std::size_t branch, int start, std::size_t most) const;
    std::vector<Mark> marks(const RunHistory& history, std::size_t branch, int start) const;
    /// Memory of its rows [bytes].
    std::size_t bytes() const { return bytes_; }

private:
    struct Branch {
        std::deque<Row> rows{};
        std::vector<Mark> marks{};
        ActTime noted{.start = 0};  // the last tick
    };
    void note_marks(Branch& branch, const ActTime& now, bool is_new, const System& system);
    void note_row(Branch& branch, const ActTime& now, const System& system);
    void note_things(Branch& branch, Row& row, const World& world);
    void drop_oldest();

    std::deque<Branch> branches_;
    std::size_t bytes_ = 0;
    int generation_ = 0;
    std::vector<Pose3D> things_;  // at the last row
    int things_generation_ = 0;
    std::vector<bool> touching_;  // index: robot; after the last tick
    std::vector<bool> failed_;    // index: component
};

}  // namespace nezumi
