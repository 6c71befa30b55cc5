# Lists a test executable's cases for ctest; Catch2's own script breaks names at a semicolon.
# SLOTS: how many of ctest's a case takes that computes.
# Usage: cmake -DTESTS=path -DCASES=file -DPREFIX=engine/ -DFOLDER=where -DSANITIZED=OFF|address|thread -DCATCH2=version
#              -DSLOTS=number -P discover.cmake

if(CATCH2 VERSION_LESS 3)
  set(list_names --list-test-names-only)
  set(must_run --warn NoTests)
else()
  set(list_names --list-tests --verbosity quiet)
  set(must_run "")  # as it is
endif()

# Appends an add_test for each case that matches `spec`.
function(list_cases spec properties)
  execute_process(COMMAND ${TESTS} ${spec} ${list_names} OUTPUT_VARIABLE names RESULT_VARIABLE count
                  WORKING_DIRECTORY ${FOLDER})
  if(NOT count MATCHES "^[0-9]+$")  # Catch2 2 exits with the number of cases, Catch2 3 with 0; a crash is a word
    message(FATAL_ERROR "${TESTS} does not run: ${count}")
  endif()
  # CMake's lists break at semicolons, and do not break within brackets.
  string(ASCII 1 open)
  string(ASCII 2 close)
  string(REGEX REPLACE "\n$" "" names "${names}")
  string(REPLACE ";" "\\;" names "${names}")
  string(REPLACE "[" "${open}" names "${names}")
  string(REPLACE "]" "${close}" names "${names}")
  string(REPLACE "\n" ";" names "${names}")
  list(LENGTH names listed)
  if(CATCH2 VERSION_LESS 3 AND NOT listed EQUAL count AND count LESS 255)  # two cases of one name: it complains, and lists none
    execute_process(COMMAND ${TESTS} ${spec} ${list_names} WORKING_DIRECTORY ${FOLDER})
    message(FATAL_ERROR "${TESTS} lists ${listed} cases, and says that it has ${count}")
  endif()
  foreach(name IN LISTS names)
    string(REPLACE "${open}" "[" name "${name}")
    string(REPLACE "${close}" "]" name "${name}")
    string(REGEX REPLACE "([][,\"\\])" "\\\\\\1" found "${name}")
    # SKIPPED: Catch2 knows no skipping; a case that can't be tried here throws this with the reason.
    # NoTests: a name that Catch2 does not find again must fail, not pass by running nothing. ASAN_OPTIONS: a test that
    # runs away in memory must end before the machine does. LSAN_OPTIONS: what libraries keep until the process ends.
    string(APPEND script
      "add_test([==[${PREFIX}${name}]==] [==[${TESTS}]==] [==[${found}]==] ${must_run})\n"
      "set_tests_properties([==[${PREFIX}${name}]==] PROPERTIES WORKING_DIRECTORY [==[${FOLDER}]==] TIMEOUT 120 "
      "SKIP_REGULAR_EXPRESSION [==[SKIPPED: ]==] "
      "ENVIRONMENT [==[ASAN_OPTIONS=hard_rss_limit_mb=4096;LSAN_OPTIONS=suppressions=${FOLDER}/tests/unit/leaks.txt:print_suppressions=0;TSAN_OPTIONS=suppressions=${FOLDER}/tests/unit/lock_orders.txt]==] "
      "${properties})\n")
  endforeach()
  set(script "${script}" PARENT_SCOPE)
endfunction()

if(SANITIZED)
  set(unsanitized "~[long]")
endif()
if(SANITIZED STREQUAL thread)
  # This sanitizer keeps signals back until a thread calls something that it knows, which a loop of Lua's never does.
  list_cases("~[watchdog]~[wallclock]~[long]~[.]" "PROCESSORS ${SLOTS}")
  list_cases("[wallclock][threads]~[watchdog]~[.]" "LABELS wallclock")
else()
  list_cases("~[watchdog]~[wallclock]~[.]${unsanitized}" "PROCESSORS ${SLOTS}")
  list_cases("[watchdog]~[wallclock]~[.]${unsanitized}" "LABELS watchdog PROCESSORS ${SLOTS}")
  if(SANITIZED)
    set(threads "[threads]")  # threads and processes at work together, within times that even a sanitizer keeps
  endif()
  list_cases("[wallclock]${threads}~[.]" "LABELS wallclock")
endif()
file(WRITE ${CASES} "${script}")
