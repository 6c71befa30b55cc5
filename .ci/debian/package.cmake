# The Debian packages, made by .ci/package: nezumi, all that runs a robot, and nezumi-dev, headers and libraries for C++
# programs. They are two because a robot has no use for the second, which asks for a gigabyte of development packages.
#
# The component `program` of `cmake --install` has more than an installation by hand: what belongs to the system.
set(debian ${CMAKE_CURRENT_LIST_DIR})
set(doc_dir ${CMAKE_INSTALL_DATADIR}/doc)

macro(nezumi_system_files destination)
  install(FILES ${ARGN} DESTINATION ${destination} COMPONENT program EXCLUDE_FROM_ALL)
endmacro()
nezumi_system_files(lib/udev/rules.d hw/udev/60-nezumi.rules)
nezumi_system_files(lib/systemd/system hw/boot/nezumi.service)
nezumi_system_files(lib/sysusers.d hw/boot/nezumi.sysusers RENAME nezumi.conf)
nezumi_system_files(/etc/default hw/boot/nezumi.default RENAME nezumi)
nezumi_system_files(${CMAKE_INSTALL_DATADIR}/polkit-1/rules.d hw/boot/nezumi.rules)
nezumi_system_files(${doc_dir}/nezumi README.md)
install(DIRECTORY docs DESTINATION ${doc_dir}/nezumi COMPONENT program EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "*.md" PATTERN "*.png")

# "0.1.0-1~deb12": its dependencies are those of the Debian that it was made on, and no other has them all.
file(STRINGS /etc/os-release release REGEX "^VERSION_(ID|CODENAME)=")
string(REGEX REPLACE ".*VERSION_ID=\"?([0-9.]+).*" "\\1" debian_release "${release}")
string(REGEX REPLACE ".*VERSION_CODENAME=\"?([a-z]+).*" "\\1" debian_name "${release}")
set(version ${PROJECT_VERSION}-1~deb${debian_release})
set(packages program dev)
if(NEZUMI_STATIC)
  set(version ${PROJECT_VERSION}-1)  # fits any Debian
  set(packages program)
endif()
set(CPACK_PACKAGE_CONTACT "the nezumi authors <nezumi@example.org>")
foreach(component ${packages})
  set(package nezumi)
  if(component STREQUAL dev)
    set(package nezumi-dev)
  endif()
  install(CODE "
    set(package ${package})
    set(source ${PROJECT_SOURCE_DIR})
    set(program ${CMAKE_CROSSCOMPILING_EMULATOR} \"$<TARGET_FILE:nezumi>\")
    set(version ${version})
    set(debian_name ${debian_name})
    set(contact \"${CPACK_PACKAGE_CONTACT}\")
    include(${debian}/documents.cmake)" COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

# What nezumi-dev's users compile with: the development packages that ./run installs.
file(STRINGS ${PROJECT_SOURCE_DIR}/.ci/packages needed REGEX "^(lib[^ ]*|[^ ]*-json3)-dev +# run:")
list(TRANSFORM needed REPLACE " .*" "")
list(JOIN needed ", " needed)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME nezumi)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL ${packages})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "behaviour engine for small wheeled robots")
set(CPACK_DEBIAN_PACKAGE_VERSION ${version})
set(CPACK_DEBIAN_PACKAGE_SOURCE nezumi)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Packed and unpacked in a fifth of the time of xz, which counts on a small computer.
set(CPACK_DEBIAN_COMPRESSION_TYPE gzip)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME nezumi)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "What a robot does is a Lua script against typed ports, which takes effect the
moment it is saved. Robots are simulated; a Raspberry Pi Mouse and a LEGO EV3
run the same file. With scenario tests, a console, and a service that starts
a system when the robot is switched on.")
if(NOT NEZUMI_SIMULATION)
  string(REPLACE "Robots are simulated; a" "A" CPACK_COMPONENT_PROGRAM_DESCRIPTION "${CPACK_COMPONENT_PROGRAM_DESCRIPTION}")
  string(REPLACE "With scenario tests," "Nothing is simulated here. With" CPACK_COMPONENT_PROGRAM_DESCRIPTION
                 "${CPACK_COMPONENT_PROGRAM_DESCRIPTION}")
endif()
if(NOT NEZUMI_STATIC)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
endif()
# Python is for nezumi.py, systemd-sysusers makes the service's user.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "python3, systemd | systemd-standalone-sysusers | systemd-sysusers")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "alsa-utils, espeak-ng, libjs-dygraphs, libjs-three, openssh-client")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libreoffice-calc, omniorb-nameserver, polkitd, python3, python3-uno")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA ${debian}/postinst ${debian}/prerm ${debian}/postrm ${debian}/conffiles)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME nezumi-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION "Headers, static libraries and CMake files for programs that run systems of
nezumi themselves, or add components in C++.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "nezumi (= ${version}), ${needed}")
include(CPack)
