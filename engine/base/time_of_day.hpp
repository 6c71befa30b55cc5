// The wall clock, for the stamps of real robots: other programs compare these stamps with their own clock.
#pragma once

namespace nezumi {

/// [s] since 1970. It may jump.
double time_of_day();

}  // namespace nezumi
