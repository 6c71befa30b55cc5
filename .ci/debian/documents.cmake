# What Debian wants to read in a package: copyright, changelogs, the manual pages, and what shells complete by. Runs while the package is made: the date is
# that of the package, and the texts may have changed since CMake ran.
# Needs package, source, program (a command that runs it here), version, debian_name, contact.
set(root $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX})
set(doc ${root}/share/doc/${package})

# LICENSE is its name, whose it is, and its text.
file(READ ${source}/LICENSE license)
string(REGEX MATCH "^MIT License\n\n(Copyright [^\n]*)\n\n(.*)\n$" license "${license}")
set(copyright ${CMAKE_MATCH_1})
string(REPLACE "\n" "\n " license " ${CMAKE_MATCH_2}")
string(REPLACE "\n \n" "\n .\n" license "${license}")
string(REPLACE "Copyright (c)" "Copyright:" copyright "${copyright}")
file(WRITE ${doc}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: nezumi

Files: *
${copyright}
License: MIT
${license}
")

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${doc}/changelog.Debian "nezumi (${version}) ${debian_name}; urgency=medium

  * What is new stands in changelog.gz.

 -- ${contact}  ${date}
")
configure_file(${source}/CHANGELOG.md ${doc}/changelog COPYONLY)
set(compressed ${doc}/changelog.Debian ${doc}/changelog)
if(package STREQUAL nezumi)
  # What the program itself says of its command line.
  set(manual ${root}/share/man/man1)
  execute_process(COMMAND ${program} manual ${manual} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB pages ${manual}/*.1)
  list(APPEND compressed ${pages})
  foreach(place bash-completion/completions/nezumi zsh/vendor-completions/_nezumi fish/vendor_completions.d/nezumi.fish)
    string(REGEX REPLACE "^([a-z]+).*" "\\1" shell ${place})
    execute_process(COMMAND ${program} completion ${shell} OUTPUT_VARIABLE script COMMAND_ERROR_IS_FATAL ANY)
    file(WRITE ${root}/share/${place} "${script}")
  endforeach()
endif()
execute_process(COMMAND gzip -9nf ${compressed} COMMAND_ERROR_IS_FATAL ANY)
