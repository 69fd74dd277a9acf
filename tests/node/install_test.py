#!/usr/bin/env python3
"""What is installed is whole: launch files, tools and the simulator run from the install space alone, and packages of other
people build on it (tests/downstream)."""
import glob
import os
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

import rospy
import rostest
from anthrob_msgs.msg import MuscleStates

HERE = os.path.dirname(os.path.realpath(__file__))


def cached(build, name):
    with open(os.path.join(build, 'CMakeCache.txt')) as file:
        return re.search('^%s:PATH=(.*)$' % name, file.read(), re.MULTILINE).group(1)


def install(build, devel, folder):
    """Into a folder as if it had been configured for that: catkin writes the prefix, and the devel space if that was sourced,
    into its *Config.cmake and setup files. @return the install space"""
    prefix = cached(build, 'CMAKE_INSTALL_PREFIX')
    subprocess.run(['cmake', '--install', build], env=dict(os.environ, DESTDIR=folder), stdout=subprocess.DEVNULL, check=True)
    space = folder + prefix
    for name in glob.glob(space + '/*.*') + glob.glob(space + '/share/*/cmake/*') + glob.glob(space + '/lib/pkgconfig/*'):
        with open(name) as file:
            text = file.read()
        with open(name, 'w') as file:
            file.write(text.replace(prefix, space).replace(devel, space))
    return space


def only(space):
    """The environment of a shell that has sourced the install space's setup and nothing else."""
    bare = {name: os.environ[name] for name in ('ROS_MASTER_URI', 'ROS_IP', 'ROS_HOSTNAME') if name in os.environ}
    bare.update(HOME=os.path.dirname(space), PATH='/usr/sbin:/usr/bin:/sbin:/bin', LANG='C.UTF-8', ROS_PYTHON_VERSION='3')
    text = subprocess.check_output(['bash', '-c', '. "$0/setup.bash" && env -0', space], env=bare, text=True)
    return dict(line.split('=', 1) for line in text.split('\0') if line)


class Install(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        build = rospy.get_param('~build')
        cls.devel = cached(build, 'CATKIN_DEVEL_PREFIX')
        cls.space = install(build, cls.devel, cls.folder)
        cls.environment = only(cls.space)
        cls.model = cls.space + '/share/anthrob_bringup/config/anthrob/model_II.yaml'

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def start(self, *command, **options):
        return subprocess.Popen(command, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)

    def run_installed(self, *command):
        process = self.start(*command)
        text, _ = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, ' '.join(command) + ': ' + text)
        return text

    def build(self, name, *options):
        """@return the folder with the programs of tests/downstream/`name`"""
        build = os.path.join(self.folder, name)
        self.run_installed('cmake', '-S', os.path.join(HERE, '..', 'downstream', name), '-B', build, *options)
        self.run_installed('cmake', '--build', build, '-j2')
        return build

    def test_launch_files_name_programs_that_are_there(self):
        self.assertIn('/anthrob/simulator', self.run_installed('roslaunch', '--nodes', 'anthrob_bringup', 'sim.launch'))
        self.run_installed('python3', os.path.join(HERE, 'launch_files_test.py'), '--text')

    def test_tools_run(self):
        self.assertIn('backlash', self.run_installed('rosrun', 'anthrob_sim', 'anthrob_effects'))
        self.assertIn('lateral_deltoid', self.run_installed('rosrun', 'anthrob_sim', 'anthrob_muscles', '--robot', 'anthrob'))
        self.run_installed('rosrun', 'anthrob_virtual_robot', 'anthrob_score', '--help')

    def test_programs_find_their_libraries(self):
        # Scripts link nothing.
        programs = [name for name in glob.glob(self.space + '/lib/anthrob_*/*') if open(name, 'rb').read(4) == b'\x7fELF']
        self.assertGreater(len(programs), 20)
        found = self.run_installed('ldd', *programs)
        self.assertNotIn('not found', found)
        self.assertNotIn(self.devel, found)

    def test_cores_link_no_ros(self):
        cores = glob.glob(self.space + '/lib/libanthrob_*_core.so')
        self.assertGreater(len(cores), 6)
        self.assertNotRegex(self.run_installed('ldd', *cores), 'libros|libcpp_common')

    def test_headers_need_no_more_than_their_package_exports(self):
        self.assertGreater(len(glob.glob(self.build('headers', '-DINSTALL_SPACE=' + self.space) + '/anthrob_*.cpp')), 8)

    def test_a_controller_of_another_workspace_moves_the_simulated_robot(self):
        controller = self.build('controller', '-DPYTHON_EXECUTABLE=/usr/bin/python3') + '/devel/lib/downstream_controller/controller'
        simulation = self.start('roslaunch', 'anthrob_bringup', 'sim.launch', start_new_session=True)
        try:
            states = rospy.wait_for_message('/anthrob/muscle_states', MuscleStates, timeout=30)
            self.assertEqual(len(states.name), 11)
            said = self.run_installed(controller, self.model, '__ns:=/anthrob')
            self.assertIn('commanded 11 muscles', said)
        finally:
            os.killpg(simulation.pid, signal.SIGINT)
            simulation.communicate(timeout=30)

    def test_effects_of_another_workspace_are_found(self):
        library = self.build('effects') + '/libdownstream_effects.so'
        robot = os.path.join(self.folder, 'robot')
        shutil.copytree(os.path.dirname(self.model), robot)
        model = os.path.join(robot, 'model_downstream.yaml')
        with open(model, 'w', encoding='utf-8') as text:
            text.write('extends: %s\neffect_libraries: [%s]\n' % (os.path.basename(self.model), library))
        listed = self.run_installed('env', 'ANTHROB_EFFECT_LIBRARIES=' + library, 'rosrun', 'anthrob_sim', 'anthrob_effects', '--model', model)
        for effect in 'downstream_cord', 'downstream_dirt':
            self.assertIn(effect, listed)

    def test_a_program_without_ros_steps_the_simulation(self):
        simulation = self.build('simulation') + '/simulation'
        self.assertEqual(self.run_installed(simulation, self.model), '0.100 s\n')
        self.assertNotIn('libros', self.run_installed('ldd', simulation))


if __name__ == '__main__':
    rospy.init_node('install_test')
    rostest.rosrun('anthrob_tests', 'install', Install)
