# Tests that need ROS or the built programs. test/core has its own CMakeLists.txt, because it runs without ROS too.
find_package(roslaunch REQUIRED)
find_package(rostest REQUIRED)
set(programs ${installed_libraries} ${installed_programs} ${python_parts})

# test/ros/NAME.test, with its gtest node in test/ros/NAME.cpp (own main) or in an executable Python file that it names.
# Every <test> needs a test-name of its own, because that names the result file.
file(GLOB rostests CONFIGURE_DEPENDS test/ros/*.test)
foreach(rostest ${rostests})
  get_filename_component(name ${rostest} NAME_WE)
  if(EXISTS ${PROJECT_SOURCE_DIR}/test/ros/${name}.cpp)
    add_rostest_gtest(${name} ${rostest} test/ros/${name}.cpp)
    configure_shell_target(${name} ${shell})
    if(programs)
      add_dependencies(${name} ${programs})
    endif()
  else()
    add_rostest(${rostest} DEPENDENCIES ${programs})
  endif()
endforeach()

# An argument without a default, such as the bag to replay, is for the user to give.
file(GLOB launch_files RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS launch/*.launch)
foreach(launch_file ${launch_files})
  roslaunch_add_file_check(${launch_file} IGNORE_UNSET_ARGS DEPENDENCIES ${programs})
endforeach()

# test/cli/NAME_test.py: pytest from outside. SUSPENSION_BAG is the program under test, PYTHON_MODULE whether it was built.
file(GLOB pytests CONFIGURE_DEPENDS test/cli/*_test.py)
foreach(pytest ${pytests})
  get_filename_component(name ${pytest} NAME_WE)
  set(result ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/pytest-${name}.xml)
  set(program ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION}/suspension_bag)
  string(JOIN " " command env PYTHONDONTWRITEBYTECODE=1 SUSPENSION_BAG=${program} PYTHON_MODULE=${python_module}
    ${PYTHON_EXECUTABLE} -m pytest
    -p no:cacheprovider --rootdir=${PROJECT_SOURCE_DIR}/test -o junit_family=xunit1 --junitxml=${result} ${pytest})
  catkin_run_tests_target(pytest ${name} pytest-${name}.xml
    COMMAND "${command}"
    DEPENDENCIES ${programs}
    WORKING_DIRECTORY ${PROJECT_BINARY_DIR})
endforeach()

# test/tools/NAME_test.cpp: what the parts of the command line give one another, one executable.
file(GLOB tools_tests CONFIGURE_DEPENDS test/tools/*_test.cpp)
catkin_add_gtest(tools_test ${tools_tests} src/tools/long_work.cpp)
configure_shell_target(tools_test suspension_health_monitor_tools)
target_link_libraries(tools_test $<IF:$<TARGET_EXISTS:GTest::gtest_main>,GTest::gtest_main,gtest_main>)
