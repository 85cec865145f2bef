# What the tests of a folder cost is Eigen, Catch2 and the same models, instantiated again in each file.  So the files of a
# folder are compiled a few at a time: a unit includes all that its files include, then each file in a namespace of its own.
# HAPBEAM_TEST_UNIT is the size of a unit in bytes of source; 0 compiles each file by itself.
#
# As a script it writes one unit:  cmake -D UNIT=out.cpp -D "FILES=a.cpp;b.cpp" -P units.cmake

if(CMAKE_SCRIPT_MODE_FILE)
  set(headers)
  set(bodies)
  foreach(file IN LISTS FILES)
    get_filename_component(folder ${file} DIRECTORY)
    get_filename_component(name ${file} NAME_WE)
    get_filename_component(room ${folder} NAME)  # two rooms of a folder may have a file of the same name
    file(STRINGS ${file} includes REGEX "^#include ")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^#include \"(.*)\"$" "${folder}/\\1" beside "${line}")
      if(EXISTS "${beside}")
        set(line "#include \"${beside}\"")
      endif()
      list(APPEND headers "${line}")
    endforeach()
    string(APPEND bodies "namespace ${room}_${name}_cpp {\n#include \"${file}\"\n}\n")
  endforeach()
  list(REMOVE_DUPLICATES headers)
  list(JOIN headers "\n" headers)
  file(WRITE ${UNIT} "${headers}\n\n${bodies}")
  return()
endif()

set(HAPBEAM_UNITS_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
set(HAPBEAM_TEST_UNIT 40000 CACHE STRING "Compile the tests of a folder together, up to so many bytes; 0: each file by itself")

# hapbeam_gather(NAME VARIABLE FILE...): the units that compile the files.  A file that opens a namespace, specialises a
# template or asks the preprocessor outside of all namespaces is compiled as it is.
function(hapbeam_gather name variable)
  set(units)
  set(gathered)
  foreach(file IN LISTS ARGN)
    file(READ ${file} text)
    if(text MATCHES "\n(namespace [a-z]|template <>|#if|#define|extern)")
      list(APPEND units ${file})
    else()
      list(APPEND gathered ${file})
    endif()
  endforeach()

  set(files)
  set(bytes 0)
  set(count 0)
  foreach(file IN LISTS gathered ITEMS "")
    set(size 0)
    if(file)
      file(SIZE ${file} size)
      # Reduced models and what trains them cost twice as much.
      file(STRINGS ${file} reduced REGEX "^#include .(hapbeam/rom|hapbeam/scene|rom)/")
      if(reduced)
        math(EXPR size "2 * ${size}")
      endif()
    endif()
    math(EXPR bytes "${bytes} + ${size}")
    if(files AND (NOT file OR bytes GREATER HAPBEAM_TEST_UNIT))
      list(LENGTH files length)
      if(length EQUAL 1)
        list(APPEND units ${files})
      else()
        math(EXPR count "${count} + 1")
        set(unit ${CMAKE_CURRENT_BINARY_DIR}/units/${name}_${count}.cpp)
        add_custom_command(OUTPUT ${unit} VERBATIM COMMENT ""
          COMMAND ${CMAKE_COMMAND} -D UNIT=${unit} -D "FILES=${files}" -P ${HAPBEAM_UNITS_SCRIPT}
          DEPENDS ${files} ${HAPBEAM_UNITS_SCRIPT})
        list(APPEND units ${unit})
      endif()
      set(files)
      set(bytes ${size})
    endif()
    list(APPEND files ${file})
  endforeach()
  set(${variable} ${units} PARENT_SCOPE)
endfunction()
