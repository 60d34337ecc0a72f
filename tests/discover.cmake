# Writes the ctest entries of a doctest program: one a test case, labelled with its suite.
#
#   cmake -DPROGRAM=... -DOUTPUT=... -DFOLDER=... -P discover.cmake
#
# doctest's own doctest_discover_tests asks once a test case for its suite, and loses test cases with a comma
# in their names.

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

set(script "")
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
  string(REPLACE "," "\\," filter "${name}")
  string(APPEND script "add_test([==[${name}]==] [==[${PROGRAM}]==] [==[--test-case=${filter}]==])\n"
                       "set_tests_properties([==[${name}]==] PROPERTIES WORKING_DIRECTORY [==[${FOLDER}]==] "
                       "TIMEOUT 900 COST ${cost} LABELS [==[${suite}]==])\n")
endforeach()
file(WRITE "${OUTPUT}" "${script}")
