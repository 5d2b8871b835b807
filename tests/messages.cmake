# add_message_test(<name> <exit status> <regular expression> <arguments>...)
# Each bad scene states what it expects in its first two lines.
file(GLOB BAD_SCENES CONFIGURE_DEPENDS bad_scenes/*.prm)
foreach(scene ${BAD_SCENES})
  get_filename_component(name ${scene} NAME_WE)
  file(STRINGS ${scene} lines LIMIT_COUNT 2)
  list(GET lines 0 first)
  list(GET lines 1 second)
  if(NOT first MATCHES "^# status: ([0-9]+)$")
    message(FATAL_ERROR "${scene} must begin with '# status: NUMBER'")
  endif()
  set(status ${CMAKE_MATCH_1})
  if(NOT second MATCHES "^# message: (.+)$")
    message(FATAL_ERROR "${scene} must have '# message: REGEX' in line 2")
  endif()
  add_message_test(${name} ${status} "${CMAKE_MATCH_1}" ${scene})
endforeach()

set(peanut ${CMAKE_SOURCE_DIR}/prm/food/peanut.prm)
add_message_test(missing_file 2 "no file '.*penut.prm'. Did you mean '.*peanut.prm'"
                 ${CMAKE_SOURCE_DIR}/prm/food/penut.prm)
add_message_test(folder_as_scene 2 "is a folder" ${CMAKE_SOURCE_DIR}/prm)
add_message_test(no_scene 2 "No scene is given")
add_message_test(unknown_option 2 "no option '--ouput'. Did you mean '--output'"
                 --ouput here ${peanut})
add_message_test(unwritable_output 4 "'/proc/morsel' cannot be created" ${peanut}
                 --output /proc/morsel)
add_message_test(no_checkpoint 2 "there is no checkpoint" ${peanut} --resume)
add_message_test(set_unknown_key 2 "Did you mean 'End time'" ${peanut} --set
                 "Time/Endtime=1")
add_message_test(set_unknown_section 2
                 "no section 'Body food/Materials'. Did you mean 'Body food/Material'"
                 ${peanut} --set "Body food/Materials/Density=1000")
add_message_test(set_without_value 2 "Give '--set" ${peanut} --set "Time/End time")
add_message_test(set_negative_depth 2 "'Depth' = '-0.01'.*must be positive" ${peanut}
                 --set Depth=-0.01)
add_message_test(set_word_for_number 2 "'Time/End time' = 'long'.*a number" ${peanut}
                 --set "Time/End time=long")
add_message_test(bad_print_format 2 "xml" --print-parameters xml)

# Good calls.
add_message_test(help 0 "Exit status: 0 done, 2 bad input" --help)
add_message_test(version 0 "^morsel [0-9]+\\.[0-9]+\\.[0-9]+$" --version)
add_message_test(print_prm 0 "set Young's modulus += 0" --print-parameters prm)
add_message_test(print_json 0 "\"entry\": \"Young's modulus\"" --print-parameters json)
add_message_test(print_of_scene 0 "set Young's modulus += 23900000" --print-parameters
                 prm ${peanut})
add_message_test(validate 0 "." --validate ${peanut})

# Mistakes on several ranks: found by all of them, in the shared part of the
# reading, or by the one rank whose cells show it.
function(add_ranks_test name pattern)
  add_test(NAME messages/${name}_3_ranks
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/check_ranks.sh 3 2 ${pattern}
                   $<TARGET_FILE:morsel> ${ARGN})
  set_tests_properties(messages/${name}_3_ranks PROPERTIES
    LABELS messages TIMEOUT 60 PROCESSORS 2)
endfunction()
set(cracked_plate ${CMAKE_SOURCE_DIR}/prm/fracture/m1_xfem.prm)
add_ranks_test(food_scene "no file '.*penut.prm'" ${CMAKE_SOURCE_DIR}/prm/food/penut.prm)
add_ranks_test(unknown_key "Did you mean" ${cracked_plate} --set XFEM/Degre=2)
add_ranks_test(crack_outside "crack" ${cracked_plate} --set
               "Cracks/Paths=0.02, 0.005 > 0.03, 0.005")
add_ranks_test(kink_in_enrichment "smaller enrichment radius" ${cracked_plate} --set
               "Cracks/Paths=0, 0.005 > 0.0008, 0.005 > 0.0018, 0.0052")
add_ranks_test(solver_of_one_rank "works on one rank only" ${cracked_plate} --set
               XFEM/Solver=umfpack)
