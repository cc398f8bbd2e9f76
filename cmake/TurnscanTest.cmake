# The function that declares one test program, and the main() that all of them share.
include(GoogleTest)

add_library(turnscan_test_main STATIC "${CMAKE_SOURCE_DIR}/tests/main.cpp")
target_link_libraries(turnscan_test_main PUBLIC GTest::gtest PRIVATE turnscan_settings
                                                                     turnscan_warnings)
# The tests run in a locale with a decimal comma, made here from Debian's package "locales".
set(TURNSCAN_TEST_LOCPATH "${CMAKE_BINARY_DIR}/locale")
if(NOT EXISTS "${TURNSCAN_TEST_LOCPATH}/de_DE.UTF-8")
  file(MAKE_DIRECTORY "${TURNSCAN_TEST_LOCPATH}")
  execute_process(COMMAND localedef -i de_DE -f UTF-8 "${TURNSCAN_TEST_LOCPATH}/de_DE.UTF-8"
                  RESULT_VARIABLE localedef_result OUTPUT_QUIET ERROR_QUIET)
endif()
if(EXISTS "${TURNSCAN_TEST_LOCPATH}/de_DE.UTF-8")
  target_compile_definitions(turnscan_test_main
                             PRIVATE TURNSCAN_TEST_LOCPATH="${TURNSCAN_TEST_LOCPATH}")
else()
  message(WARNING "localedef cannot make de_DE.UTF-8: the tests run in the C locale")
endif()

# turnscan_test(NAME SOURCES a.cpp ... [USES targets]): a GoogleTest program; each of its tests is
# one CTest test named FLOOR.Suite.Sentence, with the label unit.
function(turnscan_test name)
  cmake_parse_arguments(TEST "" "" "SOURCES;USES" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${TEST_SOURCES})
  target_link_libraries(${target} PRIVATE ${TEST_USES} turnscan_test_main GTest::gmock
                                          turnscan_settings turnscan_warnings)
  target_include_directories(${target} PRIVATE "${CMAKE_SOURCE_DIR}")
  target_compile_definitions(${target} PRIVATE TURNSCAN_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  gtest_discover_tests(${target} TEST_PREFIX "${name}." PROPERTIES TIMEOUT 600 LABELS unit
                       DISCOVERY_TIMEOUT 60 DISCOVERY_MODE PRE_TEST)
endfunction()
