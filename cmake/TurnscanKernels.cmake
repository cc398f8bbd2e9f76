# turnscan_kernels(TARGET NAME SOURCES NAME_portable.cpp NAME_avx2.cpp NAME_avx512.cpp
#                  OPTIONS option...)
# Adds the sources that suit the machine, each compiled with the options and for its instruction
# set. NAME.cpp, which chooses among them (core/kernel_choice.hpp), gets TURNSCAN_X86_KERNELS.
function(turnscan_kernels target name)
  cmake_parse_arguments(KERNEL "" "" "SOURCES;OPTIONS" ${ARGN})
  set(flags_portable)
  set(flags_avx2 -mavx2)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
  # GCC 12 warns about its own _mm512_undefined_ps (GCC bug 105593).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND flags_avx512 -Wno-maybe-uninitialized -Wno-uninitialized)
  endif()
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set_source_files_properties(${name}.cpp PROPERTIES COMPILE_DEFINITIONS TURNSCAN_X86_KERNELS)
  else()
    list(FILTER KERNEL_SOURCES INCLUDE REGEX "_portable")
  endif()
  foreach(source IN LISTS KERNEL_SOURCES)
    string(REGEX MATCH "_([a-z0-9]+)[.]cpp$" match "${source}")
    target_sources(${target} PRIVATE ${source})
    turnscan_source_options(${source} OPTIONS ${KERNEL_OPTIONS} ${flags_${CMAKE_MATCH_1}})
  endforeach()
endfunction()
