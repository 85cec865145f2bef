# hapbeam_find_jansson: the target jansson::jansson, if jansson 2.10 or later is installed.
#
# Shared by the build and by the installed package, which offers hapbeam::model_file where this finds it.
# jansson's own package first; distributions that build it without CMake have none, so its header and library second.

function(hapbeam_find_jansson)
  if(NOT TARGET jansson::jansson)
    find_package(jansson 2.10 CONFIG QUIET)
  endif()
  if(TARGET jansson::jansson)
    get_target_property(is_imported jansson::jansson IMPORTED)
    if(is_imported)
      # A project that adds this one as a folder links it from above, where a local target is unknown.
      set_target_properties(jansson::jansson PROPERTIES IMPORTED_GLOBAL TRUE)
    endif()
    return()
  endif()

  find_path(HAPBEAM_JANSSON_INCLUDE_DIR jansson.h DOC "Folder of jansson.h")
  find_library(HAPBEAM_JANSSON_LIBRARY jansson DOC "The jansson library")
  mark_as_advanced(HAPBEAM_JANSSON_INCLUDE_DIR HAPBEAM_JANSSON_LIBRARY)
  set(header ${HAPBEAM_JANSSON_INCLUDE_DIR}/jansson.h)
  if(NOT EXISTS ${header} OR NOT HAPBEAM_JANSSON_LIBRARY)
    return()
  endif()
  file(STRINGS ${header} version REGEX "^#define JANSSON_VERSION ")
  string(REGEX MATCH "[0-9]+[0-9.]*" version "${version}")
  if(version VERSION_LESS 2.10)
    return()
  endif()
  add_library(jansson::jansson UNKNOWN IMPORTED GLOBAL)
  set_target_properties(jansson::jansson PROPERTIES
    IMPORTED_LOCATION ${HAPBEAM_JANSSON_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${HAPBEAM_JANSSON_INCLUDE_DIR})
endfunction()
