include(CMakePackageConfigHelpers)

# What was decided when this was configured is what the package has, on every machine.  A jansson that was fetched is not
# installed along, so such a package is one without.
function(hapbeam_record variable target)
  set(${variable} OFF PARENT_SCOPE)
  if(TARGET ${target})
    get_target_property(is_imported ${target} IMPORTED)
    if(is_imported)
      set(${variable} ON PARENT_SCOPE)
    endif()
  endif()
endfunction()
hapbeam_record(hapbeam_has_model_file jansson::jansson)
hapbeam_record(hapbeam_has_openhaptics OpenHaptics::HD)

install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(TARGETS hapbeam EXPORT hapbeam)
set(package ${CMAKE_INSTALL_DATADIR}/cmake/hapbeam)
install(EXPORT hapbeam NAMESPACE hapbeam:: FILE hapbeamTargets.cmake DESTINATION ${package})

configure_file(cmake/hapbeamConfig.cmake.in hapbeamConfig.cmake @ONLY)
# Below 1.0 a minor version may break its users.
write_basic_package_version_file(hapbeamConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  ${PROJECT_BINARY_DIR}/hapbeamConfig.cmake ${PROJECT_BINARY_DIR}/hapbeamConfigVersion.cmake cmake/jansson.cmake
  cmake/FindOpenHaptics.cmake cmake/build_type.cmake
  DESTINATION ${package})

# For builds without CMake: pkg-config --cflags hapbeam.
file(RELATIVE_PATH from_pc ${CMAKE_INSTALL_FULL_DATADIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR})
set(packages hapbeam)
if(hapbeam_has_model_file)
  list(APPEND packages hapbeam-model-file)
endif()
foreach(name IN LISTS packages)
  configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
endforeach()
