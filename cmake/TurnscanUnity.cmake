# Unity builds: several sources of one room are compiled as one, because half of the time that is
# left with precompiled headers goes into the templates that each source instantiates again.
#
# Sources that are compiled together share their anonymous namespaces: names in them are unique
# within a room. A build without (the preset dev) compiles less after a small change.
option(TURNSCAN_UNITY "Compile the sources of a room together" OFF)

# turnscan_unity(TARGET): groups the sources of each folder, at most ten together.
# Sources with options of their own stay alone.
function(turnscan_unity target)
  if(NOT TURNSCAN_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "[.]cpp$")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A class whose members have types of an anonymous namespace is no mistake: the source that it is
  # in is included, but once.
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>")
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "room_${folder}" room)
    if(NOT DEFINED count_${room})
      set(count_${room} 0)
    endif()
    math(EXPR group "${count_${room}} / 10")
    math(EXPR count_${room} "${count_${room}} + 1")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${room}_${group}")
  endforeach()
endfunction()
