# Installs program and library, builds the example with what is installed, and runs
# both: the example must end well, in the state that is known. Python finds module and
# program in the installation.
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/prefix)
set(build ${CMAKE_CURRENT_BINARY_DIR}/example)
file(REMOVE_RECURSE ${prefix} ${build})
foreach(command
    "--install;${BUILD};--prefix;${prefix}"
    "-S;${EXAMPLE};-B;${build};-G;${GENERATOR};-DCMAKE_PREFIX_PATH=${prefix};-DDEAL_II_DIR=${DEAL_II_DIR};-DCMAKE_CXX_COMPILER=${COMPILER}"
    "--build;${build}")
  execute_process(COMMAND ${CMAKE_COMMAND} ${command} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${prefix}/bin/crevasse --version COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${build}/creeping_string
  OUTPUT_VARIABLE output ECHO_OUTPUT_VARIABLE COMMAND_ERROR_IS_FATAL ANY)
if(NOT output MATCHES "r changes by [0-9.]+e-1[0-9], lowest node -0.05\n$")
  message(FATAL_ERROR "The example ends in another state.")
endif()
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env --unset=CREVASSE_PROGRAM
    PYTHONPATH=${prefix}/share/crevasse/python ${PYTHON} -B -c "
import crevasse
from crevasse.program import find_program
run = crevasse.run('${SCENE}', {'Contact/Solver': 'automatic'}, force=True)
print(find_program(), len(run.periods), run.probe('C').opening.max())"
  OUTPUT_VARIABLE output ECHO_OUTPUT_VARIABLE COMMAND_ERROR_IS_FATAL ANY)
if(NOT output MATCHES "^${prefix}/bin/crevasse 3 0.0106[0-9]+\n$")
  message(FATAL_ERROR "Python has run another program, or to another result.")
endif()
