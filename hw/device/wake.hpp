// Wakes a thread that waits, also for files.
#pragma once

namespace nezumi::hw {

class Wake {
public:
    Wake();
    ~Wake();
    Wake(const Wake&) = delete;
    Wake& operator=(const Wake&) = delete;

    /// Ends the present or the next `wait`. Any thread may call it; never blocks.
    void ring() const;
    /// Waits for `ring`, for `file` (-1: none) to have data or an end, or for at most `seconds`.
    void wait(double seconds, int file = -1) const;

private:
    int bell_;
};

}  // namespace nezumi::hw
