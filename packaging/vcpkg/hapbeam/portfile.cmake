# The sources are those of the checkout that this port lies in.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

set(VCPKG_BUILD_TYPE release) # headers alone
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES model-file HAPBEAM_WITH_JANSSON)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${features} -DHAPBEAM_WITH_OPENHAPTICS=OFF -DHAPBEAM_INSTALL=ON
    -DHAPBEAM_BUILD_TESTS=OFF -DHAPBEAM_BUILD_BENCHMARKS=OFF -DHAPBEAM_BUILD_EXAMPLES=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/hapbeam)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/lib")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
