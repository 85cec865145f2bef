include(CMakePackageConfigHelpers)

install(DIRECTORY include/ DESTINATION include FILES_MATCHING PATTERN "*.hpp")
install(FILES LICENSE DESTINATION share/licenses/hapbeam)
install(TARGETS hapbeam EXPORT hapbeam)
install(EXPORT hapbeam NAMESPACE hapbeam:: FILE hapbeamTargets.cmake DESTINATION share/cmake/hapbeam)

configure_file(cmake/hapbeamConfig.cmake.in hapbeamConfig.cmake @ONLY)
# Below 1.0 a minor version may break its users.
write_basic_package_version_file(hapbeamConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  ${PROJECT_BINARY_DIR}/hapbeamConfig.cmake ${PROJECT_BINARY_DIR}/hapbeamConfigVersion.cmake cmake/jansson.cmake
  cmake/FindOpenHaptics.cmake cmake/build_type.cmake
  DESTINATION share/cmake/hapbeam)
