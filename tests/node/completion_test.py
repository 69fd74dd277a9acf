#!/usr/bin/env python3
"""What Tab offers in ./catkin_ws.sh shell."""
import os
import subprocess
import unittest

import rostest

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
# As bash calls a completion: by the function that is registered for the command.
TAB = '''. "$1"
COMP_LINE="$2" COMP_POINT=${#2}
read -ra COMP_WORDS <<<"$2"
[[ "$2" != *' ' ]] || COMP_WORDS+=('')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
[[ "$(complete -p "${COMP_WORDS[0]}")" =~ -F\\ ([a-z_]+) ]]
"${BASH_REMATCH[1]}" "${COMP_WORDS[0]}"
printf '%s\\n' "${COMPREPLY[@]}"
'''


def tab(line):
    done = subprocess.run(['bash', '-c', TAB, 'tab', os.path.join(TOP, 'scripts', 'completion.bash'), line], cwd=TOP,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=30)
    return done.stdout.split('\n')[:-1], done.stderr


class Completion(unittest.TestCase):
    def offers(self, line, *expected):
        offered, said = tab(line)
        self.assertEqual(said, '', line)
        self.assertLessEqual(set(expected), set(offered), line)
        return offered

    def test_packages_and_tools(self):
        self.offers('rosrun anthrob_si', 'anthrob_sim')
        self.offers('rosrun anthrob_sim anthrob_mu', 'anthrob_muscles')

    def test_options_of_tools_and_parameters_of_nodes(self):
        self.assertEqual(self.offers('rosrun anthrob_sim anthrob_muscles --m'), ['--model', '--muscle'])
        self.offers('rosrun anthrob_sim anthrob_replay --', '--model', '--in', '--out', '--help', '--version')
        self.assertEqual(self.offers('rosrun anthrob_sim anthrob_simulator _sta'), ['_state_rate:='])

    def test_robots_models_and_muscles(self):
        self.assertEqual(self.offers('rosrun anthrob_sim anthrob_muscles --robot anth'), ['anthrob'])
        self.offers('rosrun anthrob_sim anthrob_replay --model ', 'anthrob/II', 'two_muscle_rig/I')
        self.offers('rosrun anthrob_sim anthrob_replay --model config/anthrob/model_II', 'config/anthrob/model_II.yaml')
        self.assertEqual(self.offers('rosrun anthrob_sim anthrob_muscles --muscle bi'), ['biceps_brachii'])
        rig = self.offers('rosrun anthrob_sim anthrob_muscles --robot two_muscle_rig --model I --muscle ')
        self.assertEqual(sorted(rig), ['extensor', 'flexor'])
        self.offers('rosrun anthrob_sim anthrob_simulator _model:=anthrob/I', 'anthrob/I', 'anthrob/II')

    def test_arguments_of_launch_files_and_their_values(self):
        self.offers('roslaunch anthrob_bringup si', 'sim.launch')
        self.assertEqual(self.offers('roslaunch anthrob_bringup sim.launch mod'), ['model:='])
        self.assertEqual(self.offers('roslaunch anthrob_bringup sim.launch robot:=two_muscle_rig model:='), ['I', 'II', 'hill'])
        self.offers('roslaunch anthrob_bringup record.launch protocol:=', 'tier1_equilibria')

    def test_commands_of_the_workspace(self):
        self.offers('./catkin_ws.sh ', 'build', 'sim', 'demo', 'shell')
        self.offers('./catkin_ws.sh sim mo', 'model:=', 'mocap:=')
        self.offers('./catkin_ws.sh sim model:=II', 'II', 'III')
        self.offers('./catkin_ws.sh test anthrob_c', 'anthrob_calib', 'anthrob_core')
        self.offers('./catkin_ws.sh study d', 'discovery')


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'completion', Completion)
