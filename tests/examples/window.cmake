# The window of phantom on a display that nobody sees: its pictures, its changes while it runs, a mouse in it.

set(display ${CMAKE_COMMAND} -E env ${driver} ${HAPBEAM_XVFB_RUN} -a -s "-screen 0 1280x720x24")

# hapbeam_test_file(NAME NEEDS fixture [REFUSED] COMMAND command...): what a program says of a file that was made.
function(hapbeam_test_file name)
  cmake_parse_arguments(arg "REFUSED" "NEEDS" "COMMAND" ${ARGN})
  add_test(NAME examples/${name} WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} COMMAND ${arg_COMMAND})
  set_tests_properties(examples/${name} PROPERTIES LABELS examples TIMEOUT 60 FIXTURES_REQUIRED "${arg_NEEDS}")
  if(arg_REFUSED)
    set_tests_properties(examples/${name} PROPERTIES PASS_REGULAR_EXPRESSION "^different: ")
  endif()
endfunction()

if(HAPBEAM_SANITIZE MATCHES address)
  target_sources(phantom PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/keep_modules.cpp)
endif()

add_executable(compare_pictures compare_pictures.cpp)
target_link_libraries(compare_pictures PRIVATE hapbeam_checks hapbeam_window)
target_include_directories(compare_pictures PRIVATE ${PROJECT_SOURCE_DIR}/examples)
add_dependencies(hapbeam_tests compare_pictures)

# Each scene looks as it did when its reference was looked at (docs/images/scenes.sh), but for what depends on the machine:
# the line and the diagram of how long a tick takes.  Under sanitizers it is drawn for half a second.
set(times 0.78,0.15,1,0.185 0.775,0.655,1,1)
foreach(scene_at thesis:3.5 ruler:1.6 strip:3.5 string:4.5 arch:1.75 comb:2 needle:1.2 hook:4.1 fishing-rod:7.2 probe:2.4 catheter:4.5 knot:4)
  string(REPLACE ":" ";" scene_at ${scene_at})
  list(GET scene_at 0 scene)
  list(GET scene_at 1 at)
  if(HAPBEAM_SANITIZE)
    set(at 0.5)
  endif()
  hapbeam_test_example(phantom window_${scene} STATUS 0 OUTPUT "^$" BEFORE ${display} MAKES hapbeam_picture_${scene}
    OPTIONS --scene ${scene} --screenshot window_${scene}.png --at ${at})
  set_tests_properties(examples/phantom_window_${scene} PROPERTIES TIMEOUT 300)
  if(NOT HAPBEAM_SANITIZE)
    hapbeam_test_file(picture_${scene} NEEDS hapbeam_picture_${scene}
      COMMAND compare_pictures same window_${scene}.png ${CMAKE_CURRENT_SOURCE_DIR}/pictures/${scene}.png ${times})
  endif()
endforeach()
if(NOT HAPBEAM_SANITIZE)
  hapbeam_test_file(picture_of_another_scene NEEDS hapbeam_picture_strip REFUSED
    COMMAND compare_pictures same window_strip.png ${CMAKE_CURRENT_SOURCE_DIR}/pictures/string.png ${times})
  hapbeam_test_example(phantom window_later STATUS 0 OUTPUT "^$" BEFORE ${display} MAKES hapbeam_picture_later
    OPTIONS --scene arch --screenshot window_later.png --duration 2)
  hapbeam_test_file(picture_of_another_time NEEDS hapbeam_picture_later REFUSED
    COMMAND compare_pictures same window_later.png ${CMAKE_CURRENT_SOURCE_DIR}/pictures/arch.png ${times})
endif()

# Two hands on an arch.
set(at 1.4)
if(HAPBEAM_SANITIZE)
  set(at 0.5)
endif()
hapbeam_test_example(phantom window_two_hands STATUS 0 OUTPUT "^$" BEFORE ${display} MAKES hapbeam_picture_two_hands
  OPTIONS --hands 2 --scene arch --screenshot window_two_hands.png --at ${at})
set_tests_properties(examples/phantom_window_two_hands PROPERTIES TIMEOUT 300)
if(NOT HAPBEAM_SANITIZE)
  hapbeam_test_file(picture_two_hands NEEDS hapbeam_picture_two_hands
    COMMAND compare_pictures same window_two_hands.png ${CMAKE_CURRENT_SOURCE_DIR}/pictures/two_hands.png ${times})
endif()

# A ruler that swings, and where it was in the pictures before.
if(NOT HAPBEAM_SANITIZE)
  hapbeam_test_example(phantom window_twang STATUS 0 OUTPUT "^$" BEFORE ${display} MAKES hapbeam_picture_twang
    OPTIONS --scene ruler --element with-mass --screenshot window_twang.png --at 3.2)
  hapbeam_test_file(picture_twang NEEDS hapbeam_picture_twang
    COMMAND compare_pictures same window_twang.png ${CMAKE_CURRENT_SOURCE_DIR}/pictures/twang.png ${times})
endif()

# 600 changes of scene, model and coupling, a hand that presses and windows of other sizes in between: the force changes by no more than the
# guard's 10 N a millisecond, but where the arch snaps and lets go.  Then each scene has been pressed with each element and each number of
# them.  Under sanitizers sixty.
set(changes 600)
if(HAPBEAM_SANITIZE)
  set(changes 60)
endif()
hapbeam_test_example(phantom window_changes STATUS 0 OUTPUT "ticks, 0 missed" BEFORE ${display} MAKES hapbeam_tour
  OPTIONS --tour ${changes} --lock-step --record tour.csv)
set_tests_properties(examples/phantom_window_changes PROPERTIES TIMEOUT 1200 COST 20)
hapbeam_test_file(slew_of_changes NEEDS hapbeam_tour COMMAND check_recordings slew tour.csv 10000)
# The same in real time, where each second change comes while the one before is under way.
hapbeam_test_example(phantom window_tour STATUS 0 OUTPUT "^\n[0-9]+ ticks, [0-9]+ missed" BEFORE ${display} OPTIONS --tour 100)
set_tests_properties(examples/phantom_window_tour PROPERTIES TIMEOUT 300 COST 5)
# Without a coupling the bar throws the arm about, faster than that: the check can fail.
hapbeam_test_example(phantom record_buzz STATUS 0 OUTPUT "bounce" MAKES hapbeam_buzz
  OPTIONS --beam thesis --lock-step --duration 6 --coupling direct --place 0.254 --depth 0.01 --script press --record buzz.csv)
hapbeam_test_file(slew_of_buzz NEEDS hapbeam_buzz COMMAND check_recordings slew buzz.csv 10000)
set_tests_properties(examples/slew_of_buzz PROPERTIES WILL_FAIL TRUE)

# A window that ends, by itself or by Ctrl-C, leaves the summary; it shows the opening scene unless another is asked for.
hapbeam_test_example(phantom window_timed STATUS 0 OUTPUT "^\n[0-9]+ ticks, [0-9]+ missed" FIELDS scene=strip
  BEFORE ${display} OPTIONS --duration 1)
if(HAPBEAM_XDOTOOL AND CMAKE_SYSTEM_NAME STREQUAL Linux)
  hapbeam_test_example(phantom window_interrupted STATUS 0 OUTPUT "^\ninterrupted after [0-9]+ ticks" FIELDS scene=strip
    BEFORE ${display} bash ${CMAKE_CURRENT_SOURCE_DIR}/interrupt.sh --window)
endif()

# The X server or the window may be lost.
if(HAPBEAM_XDOTOOL)
  foreach(end server window destroyed)
    hapbeam_test_end(phantom ${end})
    hapbeam_test_end(phantom_emulated ${end} --device phantom)
  endforeach()
endif()
# A screenshot that cannot be written ends the run, and the report is written.
hapbeam_test_example(phantom window_screenshot_not_writable STATUS 1 FIELDS ${always} interrupted=true
  OUTPUT "^phantom: no/such/folder/x.png: the screenshot cannot be written\n$" BEFORE ${display}
  OPTIONS --scene strip --screenshot no/such/folder/x.png --at 0.2)

# What a mouse pressed in the window, the hand that is led along its recording presses without one.
if(HAPBEAM_XDOTOOL)
  add_test(NAME examples/window_mouse WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
    COMMAND ${display} bash ${CMAKE_CURRENT_SOURCE_DIR}/press_with_mouse.sh $<TARGET_FILE:phantom> mouse.csv strip)
  set_tests_properties(examples/window_mouse PROPERTIES LABELS examples TIMEOUT 300 FIXTURES_SETUP hapbeam_mouse)
  hapbeam_test_file(mouse_draws_along NEEDS hapbeam_mouse COMMAND check_recordings beside mouse.csv 0.005)
  hapbeam_test_example(phantom replay_mouse STATUS 0 OUTPUT "lock step" NEEDS hapbeam_mouse MAKES hapbeam_mouse_replayed
    OPTIONS --scene strip --replay mouse.csv --record mouse_again.csv)
  hapbeam_test_file(mouse_is_replayed NEEDS hapbeam_mouse_replayed
    COMMAND check_recordings same mouse.csv mouse_again.csv 1e-9)
  if(TARGET train)
    add_test(NAME examples/window_saves_scene WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
      COMMAND ${display} bash ${CMAKE_CURRENT_SOURCE_DIR}/save_scene.sh $<TARGET_FILE:phantom> 1206,293)
    set_tests_properties(examples/window_saves_scene PROPERTIES LABELS examples TIMEOUT 300)
  endif()
  # In space: pulled in the plane of the view, pushed into depth by the wheel, seen from another side.  The needle is felt from
  # above, and from the front.
  add_test(NAME examples/window_mouse_in_space WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
    COMMAND ${display} bash ${CMAKE_CURRENT_SOURCE_DIR}/press_with_mouse.sh $<TARGET_FILE:phantom> mouse_in_space.csv needle)
  set_tests_properties(examples/window_mouse_in_space PROPERTIES LABELS examples TIMEOUT 300 FIXTURES_SETUP hapbeam_mouse_in_space)
  hapbeam_test_file(mouse_presses_from_two_sides NEEDS hapbeam_mouse_in_space COMMAND check_recordings sides mouse_in_space.csv)
  # hapbeam_test_choice(PROGRAM NAME X,Y X,Y FIELDS field...): from the list at the first place the entry at the second one is chosen.
  # A reduced model of the scene is trained and takes over while the hand presses; a real device does, where there is one.
  function(hapbeam_test_choice program name list entry)
    set(screen ${name}_screen)
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/${screen})
    string(REPLACE "1280x720x24" "1280x720x24 -fbdir ${screen}" seen "${display}")
    hapbeam_test_example(${program} ${name} STATUS 0 OUTPUT "^\n(interrupted after )?[0-9]+ ticks" ${ARGN}
      BEFORE ${seen} bash ${CMAKE_CURRENT_SOURCE_DIR}/choose.sh ${screen} ${list} ${entry} OPTIONS --scene thesis)
  endfunction()
  hapbeam_test_choice(phantom window_trains 1170,170 1170,323 FIELDS model=pod stated_force_error_max)
  hapbeam_test_choice(phantom_emulated window_device 1170,242 1170,282 FIELDS "device=emulated Phantom")
  set_tests_properties(examples/phantom_window_trains examples/phantom_emulated_window_device PROPERTIES TIMEOUT 300 COST 5)
else()
  message(STATUS "Without xdotool the mouse in the window of phantom is not tested")
endif()
