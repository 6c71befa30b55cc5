// Lets a thread wait for a call from another thread, and for data of a file at the same time.
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
    /// Waits until `ring` is called, or until `file` (-1: none) has data or has ended; at most `seconds`.
    void wait(double seconds, int file = -1) const;

private:
    int bell_;
};

}  // namespace nezumi::hw
