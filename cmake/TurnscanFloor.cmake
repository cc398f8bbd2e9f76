# The function that declares one floor.

# turnscan_floor(NAME SOURCES a.cpp ... [PUBLIC_HEADERS ...] [PROJECT_HEADERS ...]
#                [PRIVATE_HEADERS ...] [USES floors or public libraries] [PRIVATE_LIBRARIES ...])
# Declares the static library turnscan_NAME (turnscan::NAME). Headers are included by their path
# below src/. Public ones are installed; project ones may be included by other rooms and floors;
# private ones only from their own folder, and by tests (tests/checks/check_tree.py). Private
# libraries stay out of our headers.
function(turnscan_floor name)
  set(kinds PUBLIC_HEADERS PROJECT_HEADERS PRIVATE_HEADERS)
  cmake_parse_arguments(FLOOR "" "" "SOURCES;USES;PRIVATE_LIBRARIES;${kinds}" ${ARGN})
  set(target turnscan_${name})
  add_library(${target} STATIC ${FLOOR_SOURCES})
  add_library(turnscan::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name}
                                             VERIFY_INTERFACE_HEADER_SETS ON)
  target_sources(
    ${target}
    PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/src" FILES ${FLOOR_PUBLIC_HEADERS}
    PRIVATE FILE_SET project_headers TYPE HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/src"
            FILES ${FLOOR_PROJECT_HEADERS}
    PRIVATE FILE_SET private_headers TYPE HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/src"
            FILES ${FLOOR_PRIVATE_HEADERS})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${FLOOR_USES})
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:turnscan_settings>
                                          $<BUILD_INTERFACE:turnscan_warnings>)
  foreach(library IN LISTS FLOOR_PRIVATE_LIBRARIES)
    target_link_libraries(${target} PRIVATE ${library})
  endforeach()
  turnscan_use_precompiled(${target})
  turnscan_unity(${target})
  set_property(GLOBAL APPEND PROPERTY TURNSCAN_FLOORS ${target})
endfunction()
