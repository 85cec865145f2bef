# Each way to use hapbeam from a project of one's own, and what is said where something is missing.

# Where jansson is installed, model files are part of what is used; one that was fetched is this build's alone.
set(model_files OFF)
if(TARGET jansson::jansson)
  get_target_property(is_imported jansson::jansson IMPORTED)
  if(is_imported)
    set(model_files ON)
  endif()
endif()
set(source ${CMAKE_CURRENT_SOURCE_DIR}/consumer)
set(binary ${CMAKE_CURRENT_BINARY_DIR}/consumer)
set(no_jansson -DCMAKE_DISABLE_FIND_PACKAGE_jansson=ON -DHAPBEAM_JANSSON_INCLUDE_DIR=nowhere)

# Configures a project in FOLDER.
function(hapbeam_test_configure name folder)
  add_test(NAME "consumer/${name}" COMMAND ${CMAKE_COMMAND} -S ${folder} -B ${binary}/${name}
    -G ${CMAKE_GENERATOR} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} ${ARGN})
endfunction()

function(hapbeam_test_consumer name)
  add_test(NAME "consumer/${name}" COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${source} ${binary}/${name}
    --build-generator ${CMAKE_GENERATOR}
    --build-options -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0
      -DHAPBEAM_MODEL_FILES=${model_files} ${ARGN}
    --test-command consumer)
  set_tests_properties("consumer/${name}" PROPERTIES COST 10)
  # Without a build type nothing is optimised, which is said; with one it is not.
  hapbeam_test_configure(${name}_without_build_type ${source} ${ARGN} -DCMAKE_BUILD_TYPE=)
  set_tests_properties("consumer/${name}_without_build_type" PROPERTIES PASS_REGULAR_EXPRESSION "CMAKE_BUILD_TYPE is empty")
  set_tests_properties("consumer/${name}" PROPERTIES FAIL_REGULAR_EXPRESSION "CMAKE_BUILD_TYPE is empty")
endfunction()

hapbeam_test_consumer(add_subdirectory -DHAPBEAM_FOLDER=${PROJECT_SOURCE_DIR})
hapbeam_test_configure(add_subdirectory_without_jansson ${source} -DHAPBEAM_FOLDER=${PROJECT_SOURCE_DIR}
  -DHAPBEAM_MODEL_FILES=OFF ${no_jansson})

# Nothing is fetched by who does not ask for it: what is missing is named.
set(headers_alone -DHAPBEAM_BUILD_TESTS=OFF -DHAPBEAM_BUILD_BENCHMARKS=OFF -DHAPBEAM_BUILD_EXAMPLES=OFF)
function(hapbeam_test_missing name message)
  hapbeam_test_configure(${name} ${PROJECT_SOURCE_DIR} ${headers_alone} ${ARGN})
  set_tests_properties("consumer/${name}" PROPERTIES PASS_REGULAR_EXPRESSION "hapbeam: ${message}")
endfunction()
hapbeam_test_missing(without_eigen "Eigen 3.4 or later is not installed;" -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON)
hapbeam_test_missing(with_jansson_that_is_not_there "jansson 2.10 or later" -DHAPBEAM_WITH_JANSSON=ON ${no_jansson})
hapbeam_test_missing(without_catch2 "Catch2 2.13 or 3" -DHAPBEAM_BUILD_TESTS=ON -DCMAKE_DISABLE_FIND_PACKAGE_Catch2=ON)
hapbeam_test_missing(with_openhaptics_that_is_not_there "HAPBEAM_WITH_OPENHAPTICS=ON, but" -DHAPBEAM_WITH_OPENHAPTICS=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_OpenHaptics=ON)
hapbeam_test_configure(headers_alone ${PROJECT_SOURCE_DIR} ${headers_alone} ${no_jansson} -DHAPBEAM_INSTALL=ON
  -DCMAKE_INSTALL_PREFIX=${binary}/headers_alone/prefix)

if(HAPBEAM_INSTALL)
  # What a package was configured with is what it needs where it is used.
  set(prefix ${binary}/prefix)
  add_test(NAME "consumer/install" COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
  set_tests_properties("consumer/install" PROPERTIES FIXTURES_SETUP hapbeam_prefix COST 10)
  hapbeam_test_consumer(find_package -DCMAKE_PREFIX_PATH=${prefix})
  hapbeam_test_configure(find_package_without_jansson ${source} -DCMAKE_PREFIX_PATH=${prefix} ${no_jansson})
  set(of_prefix find_package find_package_without_build_type find_package_without_jansson)
  if(model_files)
    set_tests_properties("consumer/find_package_without_jansson" PROPERTIES
      PASS_REGULAR_EXPRESSION "this hapbeam has model files")
  endif()
  # A compiler that has never heard of CMake.
  find_program(HAPBEAM_PKG_CONFIG pkg-config)
  mark_as_advanced(HAPBEAM_PKG_CONFIG)
  if(HAPBEAM_PKG_CONFIG AND HAPBEAM_BASH AND UNIX)
    add_test(NAME "consumer/pkg_config" COMMAND ${HAPBEAM_BASH} ${source}/pkg_config.sh
      ${CMAKE_CXX_COMPILER} ${prefix} ${model_files} ${PROJECT_VERSION})
    list(APPEND of_prefix pkg_config)
  endif()
  list(TRANSFORM of_prefix PREPEND consumer/)
  set_tests_properties(${of_prefix} PROPERTIES FIXTURES_REQUIRED hapbeam_prefix)

  add_test(NAME "consumer/install_without_jansson" COMMAND ${CMAKE_COMMAND} --install ${binary}/headers_alone)
  set_tests_properties("consumer/headers_alone" PROPERTIES FIXTURES_SETUP hapbeam_headers_alone)
  set_tests_properties("consumer/install_without_jansson" PROPERTIES
    FIXTURES_REQUIRED hapbeam_headers_alone FIXTURES_SETUP hapbeam_prefix_without_jansson)
  hapbeam_test_configure(find_package_configured_without_jansson ${source}
    -DCMAKE_PREFIX_PATH=${binary}/headers_alone/prefix -DHAPBEAM_MODEL_FILES=OFF)
  set_tests_properties("consumer/find_package_configured_without_jansson" PROPERTIES
    FIXTURES_REQUIRED hapbeam_prefix_without_jansson)
endif()
