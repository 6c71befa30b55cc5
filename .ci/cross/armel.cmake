# The LEGO EV3 brick (ARM926: ARMv5TE, no floating point unit).
set(architecture armel)
set(triplet arm-linux-gnueabi)
set(CMAKE_SYSTEM_PROCESSOR armv5te)
set(CMAKE_CXX_STANDARD_LIBRARIES_INIT -latomic)  # it has no atomic instructions
set(emulator qemu-arm-static -cpu arm926)
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
# For this processor g++ 12 takes what a sort moves, values that have a variant, for uninitialized.
string(APPEND CMAKE_CXX_FLAGS_INIT " -Wno-maybe-uninitialized")
