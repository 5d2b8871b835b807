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
add_message_test(static_resume 2 "a static scene is solved at once"
                 ${CMAKE_SOURCE_DIR}/prm/fracture/m1_xfem.prm --resume)
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

add_message_test(calibrate_no_damage 2
                 "--calibrate: .* has nothing to calibrate, since .*Damage/Enabled' is false"
                 --calibrate ${CMAKE_SOURCE_DIR}/prm/sph/tension_block.prm)
add_message_test(calibrate_study 2 "--calibrate: .* is a study. give a scene"
                 --calibrate ${CMAKE_SOURCE_DIR}/prm/studies/fracture/m2_angle.prm)
add_message_test(calibrate_misspelt 2 "no section 'Calibraton'. Did you mean 'Calibration'"
                 ${peanut} --set Calibraton/Seeds=2)
add_message_test(calibrate_seeds 2 "'Calibration/Seeds' = '0'.*from 1" ${peanut} --set
                 Calibration/Seeds=0)

# Accuracies that are none, and one that nobody reaches.
set(m1 ${CMAKE_SOURCE_DIR}/prm/fracture/m1_xfem.prm)
foreach(accuracy good 0 -0.001 1 100% nan "0.1 percent")
  string(MAKE_C_IDENTIFIER "plan_${accuracy}" name)
  add_message_test(${name} 2
                   "--plan: '${accuracy}' is no accuracy. give a relative error above 0"
                   ${m1} "--plan=${accuracy}")
endforeach()
add_message_test(plan_out_of_reach 2
                 "no recorded cracked plate reaches 1e-10 %. the best that is known is .* % by 'XFEM"
                 ${m1} --plan 1e-12)
add_message_test(plan_study 2 "is a study. give a scene"
                 ${CMAKE_SOURCE_DIR}/prm/studies/fracture/m2_angle.prm --plan 1e-3)
add_message_test(plan_bad_scene 2 "Did you mean 'Degree'" ${m1} --plan 1e-3 --set
                 "XFEM/Degre=2")
add_message_test(plan_without_record 0 "No record fits scene .*is updated Lagrangian"
                 ${CMAKE_SOURCE_DIR}/prm/sph/objectivity.prm --plan 1e-3)

# Cracked plates: one entry of M1 gone wrong.
add_message_test(plate_degree_0 2 "'XFEM/Degree' = '0'.*a whole number from 1 to 8"
                 ${m1} --set "XFEM/Degree=0")
add_message_test(plate_radius_beyond_plate 2 "'XFEM/Enrichment radius' is 0.02 m. it must be below half the plate's smaller side, 0.005 m"
                 ${m1} --set "XFEM/Enrichment radius=0.02")
add_message_test(plate_radius_nan 2 "'XFEM/Enrichment radius' = 'nan' is not allowed"
                 ${m1} --set "XFEM/Enrichment radius=nan")
add_message_test(plate_modulus_0 2 "'Material/Young's modulus' = '0'.*from 1 to 1e"
                 ${m1} --set "Material/Young's modulus=0")
add_message_test(plate_modulus_negative 2 "'Material/Young's modulus' = '-1'.*in Pa"
                 ${m1} --set "Material/Young's modulus=-1")
add_message_test(plate_poisson_half 2 "'Material/Poisson's ratio' = '0.5'.*from 0 to 0.499"
                 ${m1} --set "Material/Poisson's ratio=0.5")
add_message_test(plate_corners 2 "'Plate/Upper corner' .-0.01, 0.01. m must exceed 'Plate/Lower corner' .0, 0. m"
                 ${m1} --set "Plate/Upper corner=-0.01, 0.01")
add_message_test(plate_huge 2 "by 1e-9 to 1e6 m"
                 ${m1} --set "Plate/Upper corner=1e300, 0.01")
add_message_test(plate_load_without_component 2 "'Boundary/Top traction' has '1000' where two finite numbers"
                 ${m1} --set "Boundary/Top traction=1000")
add_message_test(plate_text_for_pair 2 "'Cracks/Paths' has 'a, b' where two finite numbers"
                 ${m1} --set "Cracks/Paths=a, b > c, d")
add_message_test(plate_empty_pair 2 "'Cracks/Paths' has ',' where two finite numbers"
                 ${m1} --set "Cracks/Paths=0, 0.005 > ,")
add_message_test(plate_nan_in_pair 2 "'Cracks/Paths' has '0, nan' where two finite numbers"
                 ${m1} --set "Cracks/Paths=0, nan > 0.001, 0.005")
add_message_test(plate_far_away 2 "lies outside the plate"
                 ${m1} --set "Cracks/Paths=0, 0.005 > 1e300, 0.005")
add_message_test(plate_huge_load 2 "'Boundary/Top traction' is '0, 1e300' Pa. at most 1e15"
                 ${m1} --set "Boundary/Top traction=0, 1e300")
add_message_test(plate_unknown_key 2 "Did you mean 'Degree'"
                 ${m1} --set "XFEM/Degre=3")
add_message_test(plate_ring_too_large 2 "'Stress intensity/Ring radius' is 0.0011 m, which does not fit at the crack tip .0.001, 0.005. m.*0.001 m from the tip"
                 ${m1} --set "Stress intensity/Ring radius=0.0011")
add_message_test(plate_growth_too_large 2 "'Stress intensity/Energy growth' is 1 m. it must be below"
                 ${m1} --set "Stress intensity/Energy growth=1")
add_message_test(plate_too_many_references 2 "'Stress intensity/Reference I' has 2 value.s., but the scene has 1 crack tip"
                 ${m1} --set "Stress intensity/Reference I=64, 65")
add_message_test(plate_reference_text 2 "give numbers separated by commas in Pa"
                 ${m1} --set "Stress intensity/Reference I=x")
add_message_test(plate_formula_without_edge_crack 2 "'Stress intensity/Formula' is 'edge crack in tension', which holds for a straight crack from the left"
                 ${m1} --set "Cracks/Paths=0.002, 0.005 > 0.004, 0.005")
add_message_test(plate_too_large 2 "make 5.12064e.08 unknowns, whose solution takes about .* GB"
                 ${m1} --set "XFEM/Cells along x=2000" --set "XFEM/Cells along y=2000"
                 --set XFEM/Degree=8)
add_message_test(plate_radius_beyond_segment 2
                 "'XFEM/Enrichment radius' is 0.0012 m. it must be below the length of the crack's segment"
                 ${m1} --set "Cracks/Paths=0, 0.005 > 0.003, 0.005 > 0.0036, 0.006"
                 --set "Stress intensity/Formula=none"
                 --set "XFEM/Enrichment radius=0.0012")
add_message_test(plate_mixed_loads 2 "both tractions and displacements load the plate"
                 ${m1} --set "Stress intensity/Energy growth=1e-5"
                 --set "Boundary/Right support=displacement"
                 --set "Boundary/Right displacement=1e-6, 0")
add_message_test(plate_unwritable_output 4 "'/proc/morsel' cannot be created" ${m1}
                 --output /proc/morsel)

# Good calls.
add_message_test(help 0 "Exit status: 0 done, 2 bad input" --help)
add_message_test(version 0 "^morsel [0-9]+\\.[0-9]+\\.[0-9]+$" --version)
add_message_test(print_prm 0 "set Young's modulus += 0" --print-parameters prm)
add_message_test(print_json 0 "\"entry\": \"Young's modulus\"" --print-parameters json)
add_message_test(print_of_scene 0 "set Young's modulus += 23900000" --print-parameters
                 prm ${peanut})
add_message_test(validate 0 "." --validate ${peanut})
add_message_test(study_validate 0 "Study 'm1_convergence_b' is sound: 15 runs"
                 --validate ${CMAKE_SOURCE_DIR}/prm/studies/fracture/m1_convergence_b.prm)
add_message_test(collection_validate 0 "Collection 'thesis_quick' is sound: [0-9]+ studies"
                 --validate ${CMAKE_SOURCE_DIR}/prm/studies/thesis/thesis_quick.prm)
add_message_test(study_parameters 0 "set Side by side"
                 --print-parameters prm ${CMAKE_SOURCE_DIR}/prm/studies/fracture/m1_convergence_b.prm)
add_message_test(collection_parameters 0 "set Parts"
                 --print-parameters prm ${CMAKE_SOURCE_DIR}/prm/studies/thesis/thesis_quick.prm)
add_message_test(plate_validate 0 "Unknowns +7610" --validate ${m1})
add_message_test(plate_validate_adaptive 0 "about .* unknowns after 3 adaptive" --validate
                 ${m1} --set "XFEM/Adaptive steps=3")
add_message_test(plate_without_crack 0 "off +tip enrichment at 0 tip" --validate ${m1}
                 --set Cracks/Paths= --set "Stress intensity/Formula=none"
                 --set "Stress intensity/Reference I=" --set "Stress intensity/Reference II=")
add_message_test(plate_parameters 0 "set Enrichment radius += 0.0008" --print-parameters
                 prm ${m1})

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
               "Cracks/Paths=0, 0.005 > 0.0008, 0.005 > 0.0018, 0.0052" --set
               "Stress intensity/Formula=none")
add_ranks_test(updated_lagrangian "'updated Lagrangian', which runs on one rank only"
               ${CMAKE_SOURCE_DIR}/prm/sph/tension_block_updated.prm)
add_ranks_test(static_particles "static solution runs on one rank"
               ${CMAKE_SOURCE_DIR}/prm/sph/beam_static.prm)
add_ranks_test(solver_of_one_rank "works on one rank only" ${cracked_plate} --set
               XFEM/Solver=umfpack)
