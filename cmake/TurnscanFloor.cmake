# The function that declares one floor.

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
  turnscan_use_precompiled(${target})
  foreach(header IN LISTS FLOOR_HEADERS)
    install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/${header}"
            DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/turnscan/${name}")
  endforeach()
  set_property(GLOBAL APPEND PROPERTY TURNSCAN_FLOORS ${target})
endfunction()
