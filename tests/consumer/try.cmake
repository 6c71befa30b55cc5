# Installs the build to a folder of its own, then configures, builds and runs the consumer against nothing but that,
# links each component alone, and runs the installed nezumi. What is installed must not name the sources.
# Usage: cmake -DBUILD=build/release -DSOURCE=. -DGENERATOR=Ninja -DCOMPILER=g++ -DFLAGS= -P tests/consumer/try.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

set(place ${BUILD}/consumer)
file(REMOVE_RECURSE ${place})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${place}/prefix)

execute_process(COMMAND grep -rlF "${SOURCE}/" ${place}/prefix OUTPUT_VARIABLE named RESULT_VARIABLE result)
if(NOT result EQUAL 1)  # grep's word for: nowhere
  message(FATAL_ERROR "these installed files name ${SOURCE}:\n${named}")
endif()
# Headers are installed with all that they include, and Eigen is for the rooms alone: it takes long to compile.
execute_process(COMMAND grep -rlE "# *include *<Eigen/" ${place}/prefix/include OUTPUT_VARIABLE named RESULT_VARIABLE result)
if(NOT result EQUAL 1)
  message(FATAL_ERROR "these installed headers include Eigen:\n${named}")
endif()
execute_process(COMMAND grep -rhoE "^# *include *\"[^\"]+" ${place}/prefix/include OUTPUT_VARIABLE included)
string(REGEX MATCHALL "[^\"\n]+\n" included "${included}")
if(NOT included)
  message(FATAL_ERROR "no installed header includes another: what is looked for in ${place}/prefix/include?")
endif()
foreach(header IN LISTS included)
  string(STRIP "${header}" header)
  if(NOT EXISTS ${place}/prefix/include/nezumi/${header})
    message(FATAL_ERROR "an installed header includes \"${header}\", which is not installed")
  endif()
endforeach()
run(${CMAKE_COMMAND} -E chdir / ${place}/prefix/bin/nezumi run
    ${place}/prefix/share/nezumi/behaviors/systems/stop_at_wall.lua --headless --speed max --duration 1)

set(begin "import nezumi, nezumi_env\nwith nezumi.start('${place}/prefix/share/nezumi/behaviors/systems/stop_at_wall.lua'")
run(${CMAKE_COMMAND} -E env PYTHONPATH=${place}/prefix/lib/python3/dist-packages /usr/bin/python3 -B -c
    "${begin}, program='${place}/prefix/bin/nezumi') as console:\n  console.step(10)\n  assert console.eval('now()') == 0.1")

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${place}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${place}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${place}/build)
run(${place}/build/component)
run(${place}/build/consumer)

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/alone -B ${place}/alone -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${place}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS} -O0")
run(${CMAKE_COMMAND} --build ${place}/alone)
