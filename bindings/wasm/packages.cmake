# Replaces installed packages in the web build: Debian's headers that need no library, and Lua, ODE, libccd, libpng and
# zlib from Debian's sources, which .ci/web has unpacked.
set(web_sources ${PROJECT_SOURCE_DIR}/build/web-sources)
if(NOT EXISTS ${web_sources}/complete)
  message(FATAL_ERROR "there are no sources in ${web_sources}: build by .ci/web")
endif()

# Only these headers of this computer are used: the others do not fit emscripten.
set(web_headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${web_headers})
foreach(name apriltag eigen3/Eigen fmt nlohmann ode tl)
  cmake_path(GET name FILENAME link)
  file(CREATE_LINK /usr/include/${name} ${web_headers}/${link} SYMBOLIC)
endforeach()
include_directories(SYSTEM ${web_headers})

# Adds a library that is not ours, so without our warnings.
function(web_library name)
  add_library(web_${name} STATIC ${ARGN})
  set_target_properties(web_${name} PROPERTIES C_STANDARD 11 C_EXTENSIONS ON)
  target_compile_options(web_${name} PRIVATE -w)
endfunction()

file(GLOB sources ${web_sources}/lua/src/*.c)
list(FILTER sources EXCLUDE REGEX "/luac?\\.c$")
web_library(lua ${sources})
target_compile_definitions(web_lua PRIVATE LUA_COMPAT_5_3)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/config/lua5.4-deb-multiarch.h CONTENT "#define DEB_HOST_MULTIARCH \"web\"\n")
target_include_directories(web_lua SYSTEM PUBLIC ${web_sources}/lua/src ${PROJECT_BINARY_DIR}/config)

# As Debian configures it, without tri-meshes, which nezumi does not use, and without threads.
file(GLOB sources ${web_sources}/ode/ode/src/*.cpp ${web_sources}/ode/ode/src/*.c ${web_sources}/ode/ode/src/joints/*.cpp
                  ${web_sources}/ode/ou/src/ou/*.cpp)
list(FILTER sources EXCLUDE REGEX "trimesh|gimpact|threading_pool|export-dif")
web_library(ode ${sources} ${web_sources}/ode/ode/src/collision_trimesh_disabled.cpp)
file(GLOB sources ${web_sources}/ccd/src/*.c)
web_library(ccd ${sources})
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/config/config.h CONTENT [[
#pragma once
#define HAVE_GETTIMEOFDAY 1
#define HAVE_ISNAN 1
#define HAVE_SYS_TIME_H 1
#define HAVE_SYS_TYPES_H 1
#define HAVE_UNISTD_H 1
#define ODE_PLATFORM_LINUX
#include <alloca.h>
#include <inttypes.h>
#include <malloc.h>
#include <stdint.h>
#include "typedefs.h"
]])
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/config/ccd/config.h CONTENT "#pragma once\n#define CCD_DOUBLE\n")
target_include_directories(web_ccd PUBLIC ${PROJECT_BINARY_DIR}/config ${web_sources}/ccd/src)
target_compile_definitions(web_ccd PUBLIC CCD_STATIC_DEFINE)
target_include_directories(web_ode PRIVATE ${PROJECT_BINARY_DIR}/config ${web_sources}/ode/ode/src
                                           ${web_sources}/ode/ode/src/joints ${web_sources}/ode/ou/include
                                           ${web_sources}/ode/libccd/src/custom)
target_compile_definitions(web_ode PUBLIC dIDEDOUBLE PRIVATE ODE_LIB dNODEBUG dOU_ENABLED _OU_NAMESPACE=odeou
                           _OU_FEATURE_SET=_OU_FEATURE_SET_BASICS _OU_TARGET_OS=_OU_TARGET_OS_GENUNIX dTHREADING_INTF_DISABLED CCD_IDEDOUBLE
                           dLIBCCD_ENABLED dLIBCCD_SYSTEM dLIBCCD_CYL_CYL dLIBCCD_CAP_CYL dLIBCCD_CONVEX_BOX dLIBCCD_CONVEX_CAP
                           dLIBCCD_CONVEX_CYL dLIBCCD_CONVEX_SPHERE dLIBCCD_CONVEX_CONVEX)
target_link_libraries(web_ode PRIVATE web_ccd)

file(GLOB sources ${web_sources}/zlib/*.c)
list(FILTER sources EXCLUDE REGEX "/gz[a-z]*\\.c$")
web_library(zlib ${sources})
target_include_directories(web_zlib PUBLIC ${web_sources}/zlib)
file(GLOB sources ${web_sources}/png/png*.c)
list(FILTER sources EXCLUDE REGEX "/pngtest\\.c$")
web_library(png ${sources})
configure_file(${web_sources}/png/scripts/pnglibconf.h.prebuilt ${PROJECT_BINARY_DIR}/config/pnglibconf.h COPYONLY)
target_include_directories(web_png PUBLIC ${PROJECT_BINARY_DIR}/config ${web_sources}/png)
target_link_libraries(web_png PUBLIC web_zlib)

web_library(fmt ${web_sources}/fmt/src/format.cc)
web_library(apriltag ${web_sources}/apriltag/tag36h11.c)

# Code that rarely runs is optimized for size.
foreach(name apriltag ccd fmt png zlib)
  target_compile_options(web_${name} PRIVATE -Oz)
endforeach()

# The packages have the names that the rooms use.
macro(nezumi_package room package)
endmacro()
macro(nezumi_module room prefix module)
endmacro()
foreach(name PkgConfig::APRILTAG PkgConfig::LUA PkgConfig::ODE PNG::PNG Eigen3::Eigen fmt::fmt tl::expected nlohmann_json::nlohmann_json
             Threads::Threads PkgConfig::YAML)
  add_library(${name} INTERFACE IMPORTED GLOBAL)
endforeach()
target_link_libraries(PkgConfig::APRILTAG INTERFACE web_apriltag)
target_link_libraries(fmt::fmt INTERFACE web_fmt)
target_link_libraries(PkgConfig::LUA INTERFACE web_lua)
target_link_libraries(PkgConfig::ODE INTERFACE web_ode)
target_link_libraries(PNG::PNG INTERFACE web_png)
