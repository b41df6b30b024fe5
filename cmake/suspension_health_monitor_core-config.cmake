# find_package(suspension_health_monitor_core): the library without ROS.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(Boost)
find_dependency(Ceres)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/suspension_health_monitor_core_targets.cmake)
