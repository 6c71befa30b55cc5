// A bell that one thread rings and another waits for, together with files.
#pragma once

#include <span>

namespace nezumi::hw {

class Wake {
public:
    Wake();
    ~Wake();
    Wake(const Wake&) = delete;
    Wake& operator=(const Wake&) = delete;

    /// Ends a `wait` that runs, or the next one. From any thread; never waits itself.
    void ring() const;
    /// Waits until it rings, `file` (-1: none) has something to read or is at its end, or these seconds are over.
    void wait(double seconds, int file = -1) const;

private:
    int bell_;
};

}  // namespace nezumi::hw
