# The function that declares one test program.
include(GoogleTest)

# Builds every unit test, and nothing that they do not need; and those of what parses bytes or has
# threads, which run under sanitizers on every change.
add_custom_target(unit_tests)
add_custom_target(sanitized_tests)

# Headers of every test, parsed once. A program, not a library, because it shares its flags with
# programs.
add_executable(turnscan_test_precompiled "${PROJECT_SOURCE_DIR}/cmake/empty.cpp")
target_link_libraries(turnscan_test_precompiled PRIVATE Eigen3::Eigen fmt::fmt tl::expected
                      nlohmann_json::nlohmann_json TBB::tbb GTest::gmock turnscan_settings turnscan_warnings)
turnscan_precompile(turnscan_test_precompiled ${TURNSCAN_COMMON_HEADERS} <gtest/gtest.h>
                    <gmock/gmock.h>)

# turnscan_use_test_precompiled(PROGRAM)
function(turnscan_use_test_precompiled target)
  target_precompile_headers(${target} REUSE_FROM turnscan_test_precompiled)
  target_link_libraries(${target} PRIVATE GTest::gmock)
  # GCC 12 sees overlong copies in "string + literal" (GCC bug 105329), and forgets that headers are
  # the system's when they are precompiled.
  target_compile_options(${target} PRIVATE
                         "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow>")
endfunction()

# turnscan_test(NAME [SANITIZED] SOURCES a.cpp ... [USES targets]): a GoogleTest program; each of its
# tests is one CTest test named FLOOR.Suite.Sentence, with the label unit. With a sanitizer, CTest knows
# parts of programs only. SANITIZED: of what parses bytes or has threads (with a sanitizer, the label
# sanitized, too).
function(turnscan_test name)
  cmake_parse_arguments(TEST "SANITIZED" "" "SOURCES;USES" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${TEST_SOURCES})
  target_link_libraries(${target} PRIVATE ${TEST_USES} turnscan_test_main turnscan_test_data
                                          turnscan_settings turnscan_warnings)
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}")
  turnscan_use_test_precompiled(${target})
  turnscan_unity(${target})
  if(TEST_SANITIZED AND NOT TURNSCAN_BUILD_SANITIZED_TESTS)
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  add_dependencies(unit_tests ${target})
  set(labels unit)
  if(TEST_SANITIZED)
    add_dependencies(sanitized_tests ${target})
    list(APPEND labels sanitized)
  endif()
  if(TURNSCAN_SANITIZE)
    # The start of a program takes longer than most of its tests: eight runs of it share them.
    foreach(shard RANGE 7)
      add_test(NAME ${name}.part_${shard} COMMAND ${target})
      set_tests_properties(${name}.part_${shard} PROPERTIES TIMEOUT 1200 LABELS "${labels}"
        ENVIRONMENT "GTEST_TOTAL_SHARDS=8;GTEST_SHARD_INDEX=${shard}")
    endforeach()
    return()
  endif()
  gtest_discover_tests(${target} TEST_PREFIX "${name}." PROPERTIES TIMEOUT 600 LABELS unit
                       DISCOVERY_TIMEOUT 60 DISCOVERY_MODE PRE_TEST)
endfunction()
