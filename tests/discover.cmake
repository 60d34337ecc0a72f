# Writes the ctest entries of a doctest program: one a test case, labelled with its suite; or one a suite (BY_SUITE).
#
#   cmake -DPROGRAM=... -DOUTPUT=... -DFOLDER=... [-DBY_SUITE=ON] -P discover.cmake
#
# doctest's own doctest_discover_tests asks once a test case for its suite, and loses test cases with a comma
# in their names.

cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} --list-test-cases --reporters=xml OUTPUT_VARIABLE listing
                COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "<semicolon/>" listing "${listing}")
string(REGEX MATCHALL "<TestCase [^\n]*" cases "${listing}")

function(unescape text result)
  string(REPLACE "<semicolon/>" ";" text "${text}")
  string(REPLACE "&lt;" "<" text "${text}")
  string(REPLACE "&gt;" ">" text "${text}")
  string(REPLACE "&quot;" "\"" text "${text}")
  string(REPLACE "&apos;" "'" text "${text}")
  string(REPLACE "&amp;" "&" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

function(entry name filter cost suite)
  string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] ${filter})\n"
                       "set_tests_properties([==[${name}]==] PROPERTIES WORKING_DIRECTORY [==[${FOLDER}]==] "
                       "TIMEOUT 900 COST ${cost} LABELS [==[${suite}]==])\n")
  set(script "${script}" PARENT_SCOPE)
endfunction()

set(script "")
set(suites "")
foreach(case IN LISTS cases)
  if(NOT case MATCHES "name=\"([^\"]*)\"( testsuite=\"([^\"]*)\")?")
    message(FATAL_ERROR "no test case in: ${case}")
  endif()
  set(suite "${CMAKE_MATCH_3}")
  unescape("${CMAKE_MATCH_1}" name)
  # Long ones first: at the end one of them would leave the other processor idle.
  set(cost 0)
  if(suite MATCHES "^(slow|deep)")
    set(cost 1)
  endif()
  if(BY_SUITE)
    if(suite STREQUAL "")
      message(FATAL_ERROR "no suite: ${name}")
    endif()
    list(APPEND suites "${suite}")
    continue()
  endif()
  string(REPLACE "," "\\," filter "${name}")
  entry("${name}" "[==[--test-case=${filter}]==]" ${cost} "${suite}")
endforeach()
list(REMOVE_DUPLICATES suites)
foreach(suite IN LISTS suites)
  entry("${suite}" "[==[--test-suite=${suite}]==]" 0 "${suite}")
endforeach()
file(WRITE "${OUTPUT}" "${script}")
