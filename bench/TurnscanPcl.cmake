# turnscan_pcl: the parts of PCL that the benchmarks compare with, without what PCL's own CMake
# package adds to every target that links it (VTK's and Qt's include folders and definitions).
# A target that sees PCL is never built with -march=native: its alignment would differ from that of
# Debian's PCL, whose filters then crash.
find_package(Boost REQUIRED)
find_path(TURNSCAN_PCL_INCLUDE_DIR pcl/pcl_config.h
          PATH_SUFFIXES pcl-1.13 pcl-1.14 pcl-1.15 REQUIRED)
add_library(turnscan_pcl INTERFACE IMPORTED)
target_include_directories(turnscan_pcl SYSTEM INTERFACE "${TURNSCAN_PCL_INCLUDE_DIR}")
target_link_libraries(turnscan_pcl INTERFACE Eigen3::Eigen Boost::headers)
foreach(part common octree kdtree search filters features surface registration)
  find_library(TURNSCAN_PCL_${part} pcl_${part} REQUIRED)
  target_link_libraries(turnscan_pcl INTERFACE "${TURNSCAN_PCL_${part}}")
endforeach()
