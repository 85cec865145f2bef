# Each third party is found on the system first and fetched at a pinned release second, if HAPBEAM_FETCH allows it.
# Version ranges stand here and nowhere else; what each is for stands in the README.
include_guard()
include(${CMAKE_CURRENT_LIST_DIR}/jansson.cmake)

# Fetches what hapbeam_find_... has not found, or says how to go on.
macro(hapbeam_fetch name what)
  if(NOT HAPBEAM_FETCH)
    message(FATAL_ERROR "hapbeam: ${what} is not installed; install it, or let it be fetched with -DHAPBEAM_FETCH=ON")
  endif()
  include(FetchContent)
  FetchContent_Declare(${name} ${ARGN})
  FetchContent_MakeAvailable(${name})
endmacro()

# Eigen 3.4 or later.  Its version file accepts its own major version alone, hence one call for each.
function(hapbeam_find_eigen)
  if(TARGET Eigen3::Eigen)
    return()
  endif()
  find_package(Eigen3 3.4 CONFIG QUIET)
  if(NOT Eigen3_FOUND)
    find_package(Eigen3 5 CONFIG QUIET)
  endif()
  if(Eigen3_FOUND)
    # A project that adds this one as a folder links hapbeam from above, where a local target is unknown.
    set_target_properties(Eigen3::Eigen PROPERTIES IMPORTED_GLOBAL TRUE)
    return()
  endif()
  # SOURCE_SUBDIR names no folder of Eigen's, so that its own tests, documentation and BLAS are not added.
  hapbeam_fetch(eigen "Eigen 3.4 or later"
    GIT_REPOSITORY https://gitlab.com/libeigen/eigen GIT_TAG 3.4.0 GIT_SHALLOW TRUE
    SOURCE_SUBDIR headers-alone)
  if(NOT TARGET Eigen3::Eigen)
    add_library(Eigen3::Eigen INTERFACE IMPORTED GLOBAL)
    target_include_directories(Eigen3::Eigen INTERFACE ${eigen_SOURCE_DIR})
  endif()
endfunction()

# jansson 2.10 or later, as HAPBEAM_WITH_JANSSON says: ON must have it, AUTO has it where it is installed or fetched.
function(hapbeam_find_or_fetch_jansson)
  if(NOT HAPBEAM_WITH_JANSSON)
    return()
  endif()
  hapbeam_find_jansson()
  if(TARGET jansson::jansson OR (HAPBEAM_WITH_JANSSON STREQUAL "AUTO" AND NOT HAPBEAM_FETCH))
    return()
  endif()
  set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)
  set(JANSSON_BUILD_DOCS OFF)
  set(JANSSON_BUILD_SHARED_LIBS OFF)
  set(JANSSON_EXAMPLES OFF)
  set(JANSSON_INSTALL OFF)
  set(JANSSON_WITHOUT_TESTS ON)
  hapbeam_fetch(jansson "jansson 2.10 or later, which HAPBEAM_WITH_JANSSON=ON needs,"
    GIT_REPOSITORY https://github.com/akheron/jansson GIT_TAG v2.15.1 GIT_SHALLOW TRUE)
  if(NOT TARGET jansson::jansson)
    add_library(jansson::jansson ALIAS jansson)
  endif()
endfunction()

# OpenHaptics 3.0 or later, as HAPBEAM_WITH_OPENHAPTICS says.  Its licence leaves nothing to fetch.
function(hapbeam_find_openhaptics)
  if(NOT HAPBEAM_WITH_OPENHAPTICS)
    return()
  endif()
  list(PREPEND CMAKE_MODULE_PATH ${PROJECT_SOURCE_DIR}/cmake)
  find_package(OpenHaptics MODULE QUIET)
  if(NOT HAPBEAM_WITH_OPENHAPTICS STREQUAL "AUTO" AND NOT TARGET OpenHaptics::HD)
    message(FATAL_ERROR "hapbeam: HAPBEAM_WITH_OPENHAPTICS=ON, but the OpenHaptics developer kit is not found; OpenHaptics_ROOT says where it is")
  endif()
endfunction()

# What the window of an example needs: GLFW 3.3, OpenGL, Dear ImGui 1.86 or later as a library with its GLFW and OpenGL 3
# backends, and stb_image_write.  All as the system has them, or no hapbeam_window: fetching a GUI to press a beam would be
# more than anybody asked for, and without it the example runs headless.
function(hapbeam_find_window)
  find_package(glfw3 3.3 CONFIG QUIET)
  set(OpenGL_GL_PREFERENCE GLVND)
  find_package(OpenGL QUIET)
  find_path(HAPBEAM_IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
  find_path(HAPBEAM_IMGUI_BACKENDS_INCLUDE_DIR imgui_impl_glfw.h PATH_SUFFIXES imgui/backends backends imgui)
  find_library(HAPBEAM_IMGUI_LIBRARY imgui)
  find_path(HAPBEAM_STB_INCLUDE_DIR stb_image_write.h PATH_SUFFIXES stb)
  # Debian's Dear ImGui leaves the rasterising of fonts to stb's library; built elsewhere it has its own.
  find_library(HAPBEAM_STB_LIBRARY stb)
  set(stb)
  if(HAPBEAM_STB_LIBRARY)
    set(stb ${HAPBEAM_STB_LIBRARY})
  endif()
  mark_as_advanced(HAPBEAM_STB_LIBRARY HAPBEAM_IMGUI_INCLUDE_DIR HAPBEAM_IMGUI_BACKENDS_INCLUDE_DIR HAPBEAM_IMGUI_LIBRARY HAPBEAM_STB_INCLUDE_DIR)
  if(NOT (TARGET glfw AND TARGET OpenGL::GL AND HAPBEAM_IMGUI_INCLUDE_DIR AND HAPBEAM_IMGUI_BACKENDS_INCLUDE_DIR
          AND HAPBEAM_IMGUI_LIBRARY AND HAPBEAM_STB_INCLUDE_DIR))
    return()
  endif()
  add_library(hapbeam_window INTERFACE)
  target_include_directories(hapbeam_window SYSTEM INTERFACE
    ${HAPBEAM_IMGUI_INCLUDE_DIR} ${HAPBEAM_IMGUI_BACKENDS_INCLUDE_DIR} ${HAPBEAM_STB_INCLUDE_DIR})
  target_link_libraries(hapbeam_window INTERFACE ${HAPBEAM_IMGUI_LIBRARY} ${stb} glfw OpenGL::GL ${CMAKE_DL_LIBS})
endfunction()

# Catch2 3 or 2.13.  A macro: include(Catch) after it needs the module path that find_package sets.
macro(hapbeam_find_catch2)
  find_package(Catch2 3 CONFIG QUIET)
  if(NOT Catch2_FOUND)
    find_package(Catch2 2.13 CONFIG QUIET)
  endif()
  if(NOT Catch2_FOUND)
    hapbeam_fetch(catch2 "Catch2 2.13 or 3, which the tests need (HAPBEAM_BUILD_TESTS),"
      GIT_REPOSITORY https://github.com/catchorg/Catch2 GIT_TAG v2.13.10 GIT_SHALLOW TRUE)
    list(APPEND CMAKE_MODULE_PATH ${catch2_SOURCE_DIR}/contrib)
  endif()
endmacro()

# Google Benchmark 1.7 or later.
function(hapbeam_find_benchmark)
  find_package(benchmark 1.7 CONFIG QUIET)
  if(NOT benchmark_FOUND)
    set(BENCHMARK_ENABLE_TESTING OFF)
    set(BENCHMARK_ENABLE_INSTALL OFF)
    set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)
    hapbeam_fetch(benchmark "Google Benchmark 1.7 or later, which the benchmarks need (HAPBEAM_BUILD_BENCHMARKS),"
      GIT_REPOSITORY https://github.com/google/benchmark GIT_TAG v1.7.1 GIT_SHALLOW TRUE)
  endif()
endfunction()

# pybind11 2.10 or later, and the Python that it compiles for.  A macro: pybind11_add_module reads variables that these set.
macro(hapbeam_find_pybind11)
  find_package(Python3 COMPONENTS Interpreter Development.Module REQUIRED)
  set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
  find_package(pybind11 2.10 CONFIG QUIET)
  if(NOT pybind11_FOUND)
    hapbeam_fetch(pybind11 "pybind11 2.10 or later, which the package for Python needs (HAPBEAM_BUILD_PYTHON),"
      GIT_REPOSITORY https://github.com/pybind/pybind11 GIT_TAG v2.10.3 GIT_SHALLOW TRUE)
  endif()
endmacro()
