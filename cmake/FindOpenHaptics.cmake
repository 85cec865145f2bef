# FindOpenHaptics: the target OpenHaptics::HD, where the OpenHaptics developer kit (HDAPI) is installed.
#
# Hints: OpenHaptics_ROOT, as a CMake or environment variable; OH_SDK_BASE and 3DTOUCH_BASE, which the vendor's installers
# set; the usual folders.  OpenHaptics_INCLUDE_DIR (with HD/hd.h) and OpenHaptics_HD_LIBRARY say it outright.
# The kit's own licence forbids to hand its files on: nothing is fetched.

file(GLOB OpenHaptics_places
  /opt/OpenHaptics/*/* C:/OpenHaptics/*/* "C:/Program Files/SensAble/3DTouch" "C:/Program Files (x86)/SensAble/3DTouch")
# The highest version first.
list(SORT OpenHaptics_places COMPARE NATURAL ORDER DESCENDING)
set(OpenHaptics_places "$ENV{OH_SDK_BASE}" "$ENV{3DTOUCH_BASE}" ${OpenHaptics_places} /opt/OpenHaptics)

set(OpenHaptics_lib_folders lib lib64)
if(WIN32)
  if(CMAKE_SIZEOF_VOID_P EQUAL 8)
    set(OpenHaptics_lib_folders lib/x64/Release lib/x64 lib/win64 lib)
  else()
    set(OpenHaptics_lib_folders lib/Win32/Release lib/Win32 lib)
  endif()
endif()

# OpenHaptics_ROOT is heeded by itself where policy CMP0074 is new, which is the caller's choice.
find_path(OpenHaptics_INCLUDE_DIR HD/hd.h
  HINTS ${OpenHaptics_ROOT} $ENV{OpenHaptics_ROOT} PATHS ${OpenHaptics_places} PATH_SUFFIXES include usr/include
  DOC "Folder of HD/hd.h")
find_library(OpenHaptics_HD_LIBRARY NAMES HD hd
  HINTS ${OpenHaptics_ROOT} $ENV{OpenHaptics_ROOT} PATHS ${OpenHaptics_places}
  PATH_SUFFIXES ${OpenHaptics_lib_folders} usr/lib usr/lib64
  DOC "The library of HDAPI")
mark_as_advanced(OpenHaptics_INCLUDE_DIR OpenHaptics_HD_LIBRARY)
unset(OpenHaptics_places)
unset(OpenHaptics_lib_folders)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenHaptics REQUIRED_VARS OpenHaptics_HD_LIBRARY OpenHaptics_INCLUDE_DIR)

if(OpenHaptics_FOUND AND NOT TARGET OpenHaptics::HD)
  # Imported, so that its headers are a system's, whose warnings are nobody's.
  add_library(OpenHaptics::HD UNKNOWN IMPORTED GLOBAL)
  set_target_properties(OpenHaptics::HD PROPERTIES
    IMPORTED_LOCATION ${OpenHaptics_HD_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OpenHaptics_INCLUDE_DIR})
endif()
