// The wall clock: the stamps of real robots, which other programs compare with their own.
#pragma once

namespace nezumi {

/// [s] since 1970. It may jump.
double time_of_day();

}  // namespace nezumi
