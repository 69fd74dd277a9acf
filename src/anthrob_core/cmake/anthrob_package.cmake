# What every package of the suite repeats.

set(ANTHROB_TEST_MAIN ${CMAKE_CURRENT_LIST_DIR}/test_main.cpp)

# Language, warnings and include folders; to be called after catkin_package().
# include/ holds the doors, for others; src/ what only the package itself and its tests include.
macro(anthrob_package)
  set(CMAKE_CXX_STANDARD 17)
  set(CMAKE_CXX_STANDARD_REQUIRED ON)
  if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
  endif()
  add_compile_options(-Wall -Wextra -Wpedantic -Wshadow)
  # Several sources are compiled as one: most of the time goes into headers. For work on few files: -DCMAKE_UNITY_BUILD=OFF.
  if(NOT DEFINED CMAKE_UNITY_BUILD)
    set(CMAKE_UNITY_BUILD ON)
    set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)
  endif()
  # Every library names all that it needs.
  add_link_options(-Wl,--no-undefined)
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/include)
    include_directories(include)
  endif()
  include_directories(src)
  include_directories(SYSTEM ${catkin_INCLUDE_DIRS} ${EIGEN3_INCLUDE_DIRS})
  # The top of the workspace is found through the real folder: packages may be linked from elsewhere.
  get_filename_component(anthrob_top ${PROJECT_SOURCE_DIR} REALPATH)
  get_filename_component(anthrob_top ${anthrob_top}/../.. ABSOLUTE)
  set(ANTHROB_CONFIG_DIR ${anthrob_top}/config)
endmacro()

# anthrob_sources(VARIABLE FOLDER [EXCLUDE FOLDER...]): all .cpp below a folder of the package.
function(anthrob_sources variable folder)
  cmake_parse_arguments(arg "" "" "EXCLUDE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${folder}/*.cpp)
  foreach(excluded ${arg_EXCLUDE})
    list(FILTER sources EXCLUDE REGEX "^${excluded}/")
  endforeach()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# anthrob_install(TARGET...): programs, libraries, and the package's doors.
function(anthrob_install)
  install(TARGETS ${ARGN}
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/include)
    install(DIRECTORY include/${PROJECT_NAME}/ DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
  endif()
endfunction()

# anthrob_tests(LIBRARIES ... [FOLDER test] [SOURCES ...] [DEFINITIONS ...] [TOOLS ...] [EXCLUDE FOLDER...])
# One program ${PROJECT_NAME}_test of all *_test.cpp below the folder. CTest runs it once for each of these files, side by side.
# SOURCES are compiled in beside them; TOOLS are programs that the tests start: anthrob_plot is ANTHROB_PLOT to them.
function(anthrob_tests)
  cmake_parse_arguments(arg "" "FOLDER" "LIBRARIES;SOURCES;DEFINITIONS;TOOLS;EXCLUDE" ${ARGN})
  if(NOT arg_FOLDER)
    set(arg_FOLDER test)
  endif()
  anthrob_sources(files ${arg_FOLDER} EXCLUDE ${arg_EXCLUDE})
  list(FILTER files INCLUDE REGEX "_test\\.cpp$")
  set(program ${PROJECT_NAME}_test)
  add_executable(${program} EXCLUDE_FROM_ALL ${files} ${arg_SOURCES} ${ANTHROB_TEST_MAIN})
  target_include_directories(${program} PRIVATE ${arg_FOLDER})
  target_compile_definitions(${program} PRIVATE ANTHROB_CONFIG_DIR="${ANTHROB_CONFIG_DIR}" ${arg_DEFINITIONS})
  # They are compiled more often than they run.
  target_compile_options(${program} PRIVATE -O1)
  target_link_libraries(${program} ${arg_LIBRARIES} gtest)
  foreach(tool ${arg_TOOLS})
    string(TOUPPER ${tool} name)
    target_compile_definitions(${program} PRIVATE ${name}="$<TARGET_FILE:${tool}>")
    add_dependencies(${program} ${tool})
  endforeach()
  add_dependencies(tests ${program})
  foreach(file ${files})
    string(REGEX REPLACE "^${arg_FOLDER}/(.*)_test\\.cpp$" "\\1" name ${file})
    string(REPLACE "/" "_" name ${name})
    set(results ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/gtest-${name}.xml)
    catkin_run_tests_target(gtest ${name} gtest-${name}.xml
      COMMAND "$<TARGET_FILE:${program}> --file=${file} --gtest_output=xml:${results}"
      DEPENDENCIES ${program})
  endforeach()
endfunction()
