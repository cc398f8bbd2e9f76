# turnscan_pcl: the parts of PCL that we use, without what PCL's own CMake package adds to every
# target that links it (VTK's and Qt's include folders and definitions).
if(NOT TARGET turnscan_pcl)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(Boost REQUIRED)
  find_path(TURNSCAN_PCL_INCLUDE_DIR pcl/pcl_config.h PATH_SUFFIXES pcl-1.13 REQUIRED)
  add_library(turnscan_pcl INTERFACE IMPORTED)
  target_include_directories(turnscan_pcl SYSTEM INTERFACE "${TURNSCAN_PCL_INCLUDE_DIR}")
  target_link_libraries(turnscan_pcl INTERFACE Eigen3::Eigen Boost::headers)
  foreach(part common octree kdtree search filters features surface registration)
    find_library(TURNSCAN_PCL_${part} pcl_${part} REQUIRED)
    target_link_libraries(turnscan_pcl INTERFACE "${TURNSCAN_PCL_${part}}")
  endforeach()
endif()
