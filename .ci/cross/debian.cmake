# Debian's cross compiler for `triplet`, against the packages for `architecture` that .ci/sysroot has unpacked.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_CXX_COMPILER ${triplet}-g++)
# How g++ 7 changed what it passes in registers is of no interest: all is built with this one.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
set(CMAKE_STRIP ${triplet}-strip)
get_filename_component(sysroot ${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot/${architecture} ABSOLUTE)
set(CMAKE_SYSROOT ${sysroot})
set(CMAKE_LIBRARY_ARCHITECTURE ${triplet})
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${sysroot})
set(ENV{PKG_CONFIG_LIBDIR} ${sysroot}/usr/lib/${triplet}/pkgconfig:${sysroot}/usr/share/pkgconfig)
# What libraries need themselves; those of linear algebra have folders of their own.
set(libraries ${sysroot}/usr/lib/${triplet})
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-Wl,-rpath-link,${libraries} -Wl,-rpath-link,${libraries}/blas -Wl,-rpath-link,${libraries}/lapack")

# How a program for it runs here.
file(GLOB folders ${libraries} ${libraries}/blas ${libraries}/lapack)
list(JOIN folders ":" folders)
set(CMAKE_CROSSCOMPILING_EMULATOR ${emulator} -L ${sysroot} -E LD_LIBRARY_PATH=${folders})

set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${architecture})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${libraries})
