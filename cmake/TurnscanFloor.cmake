# Compile settings of our own code, and the function that declares one floor.

# Headers lie beside their sources and are included as <turnscan/FLOOR/NAME.hpp>, before and after
# installation: in the build tree a link named turnscan stands for src/.
file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/include")
file(CREATE_LINK "${CMAKE_SOURCE_DIR}/src" "${CMAKE_BINARY_DIR}/include/turnscan" SYMBOLIC)

set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
find_program(TURNSCAN_CCACHE ccache)
if(TURNSCAN_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${TURNSCAN_CCACHE}")
  set(CMAKE_C_COMPILER_LAUNCHER "${TURNSCAN_CCACHE}")
endif()

add_library(turnscan_settings INTERFACE)
target_compile_features(turnscan_settings INTERFACE cxx_std_20)
# -ffp-contract=off: the same bytes with and without FMA units.
target_compile_options(turnscan_settings INTERFACE -ffp-contract=off)
add_library(turnscan_warnings INTERFACE)
target_compile_options(turnscan_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow
                                                   -Wnon-virtual-dtor -Woverloaded-virtual)
# GCC 12 sees uninitialised values in every std::optional<double> that it inlines.
target_compile_options(turnscan_warnings
                       INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
if(TURNSCAN_WERROR)
  target_compile_options(turnscan_warnings INTERFACE -Werror)
endif()
if(TURNSCAN_SANITIZE)
  add_compile_options(-fsanitize=${TURNSCAN_SANITIZE} -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${TURNSCAN_SANITIZE})
endif()

# turnscan_floor(NAME SOURCES a.cpp ... HEADERS a.hpp ... [USES floors or public libraries]
#                [PRIVATE_LIBRARIES ...])
# Declares the static library turnscan_NAME (turnscan::NAME). Private libraries stay out of our
# headers.
function(turnscan_floor name)
  cmake_parse_arguments(FLOOR "" "" "SOURCES;HEADERS;USES;PRIVATE_LIBRARIES" ${ARGN})
  set(target turnscan_${name})
  add_library(${target} STATIC ${FLOOR_SOURCES})
  add_library(turnscan::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(
    ${target} PUBLIC "$<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/include>"
                     "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${FLOOR_USES})
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:turnscan_settings>
                                          $<BUILD_INTERFACE:turnscan_warnings>)
  foreach(library IN LISTS FLOOR_PRIVATE_LIBRARIES)
    target_link_libraries(${target} PRIVATE ${library})
  endforeach()
  foreach(header IN LISTS FLOOR_HEADERS)
    install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/${header}"
            DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/turnscan/${name}")
  endforeach()
  set_property(GLOBAL APPEND PROPERTY TURNSCAN_FLOORS ${target})
endfunction()

# turnscan_test(NAME SOURCES a.cpp ... [USES targets]): a GoogleTest program; each of its tests is
# one CTest test named FLOOR.Suite.Sentence.
function(turnscan_test name)
  cmake_parse_arguments(TEST "" "" "SOURCES;USES" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${TEST_SOURCES})
  target_link_libraries(${target} PRIVATE ${TEST_USES} GTest::gtest_main GTest::gmock
                                          turnscan_settings turnscan_warnings)
  target_include_directories(${target} PRIVATE "${CMAKE_SOURCE_DIR}")
  target_compile_definitions(
    ${target} PRIVATE TURNSCAN_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  include(GoogleTest)
  gtest_discover_tests(${target} TEST_PREFIX "${name}." PROPERTIES TIMEOUT 600
                       DISCOVERY_TIMEOUT 60 DISCOVERY_MODE PRE_TEST)
endfunction()
