# The Python module: python/suspension_health_monitor over compiled parts, _core of src/python and, with ROS, _bags.
# BUILD_PYTHON: ON builds it where pybind11 is found.
option(BUILD_PYTHON "Build the Python module, where pybind11 is found" ON)
set(python_module OFF)
set(python_module_reason "BUILD_PYTHON is off")
if(BUILD_PYTHON AND SANITIZE)
  set(python_module_reason "the interpreter has no sanitizers")
elseif(BUILD_PYTHON)
  find_program(PYTHON_EXECUTABLE python3)  # catkin has its own; pybind11 would look for old versions first
  set(Python_EXECUTABLE ${PYTHON_EXECUTABLE})
  # pybind11 from 2.6 on calls what this defines with Development; a newer catkin has looked for an Interpreter only.
  find_package(Python 3 QUIET COMPONENTS Interpreter Development)
  find_package(pybind11 CONFIG QUIET)
  set(python_module_reason "pybind11 is not found (Debian, Ubuntu: pybind11-dev)")
  if(pybind11_FOUND)
    set(python_module ON)
    set(python_module_reason "pybind11 ${pybind11_VERSION}, ${PYTHON_EXECUTABLE}")
  endif()
endif()
message(STATUS "Python module: ${python_module} (${python_module_reason})")

get_filename_component(python_repository ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)

# add_python_part(PART DIRECTORY SOURCE...): the compiled part _PART, which lands in a folder of the build.
function(add_python_part part directory)
  set(target suspension_health_monitor_python_${part})
  pybind11_add_module(${target} NO_EXTRAS ${ARGN})  # link time optimisation costs more than it gives
  target_include_directories(${target} PRIVATE ${python_repository}/include)
  # Python has its own Interruption and Progress, of the same header, which need fewer members.
  target_compile_options(${target} PRIVATE ${strict_warnings}
    $<$<CXX_COMPILER_ID:Clang>:-Wno-unused-private-field>)
  target_compile_features(${target} PRIVATE cxx_std_17)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME _${part} LIBRARY_OUTPUT_DIRECTORY ${directory}
    UNITY_BUILD_BATCH_SIZE 2)  # with pybind11 two take as much memory as four others
endfunction()

file(GLOB python_core_sources CONFIGURE_DEPENDS ${python_repository}/src/python/*.cpp)
list(FILTER python_core_sources EXCLUDE REGEX "/bags_[a-z_]*\\.cpp$")
file(GLOB python_bags_sources CONFIGURE_DEPENDS ${python_repository}/src/python/bags_*.cpp)
