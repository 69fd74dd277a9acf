#!/usr/bin/env python3
"""What ./catkin_ws.sh does on other systems and beside another ROS. Commands that it would run are functions here, which a
shell takes before programs: nothing is installed."""
import os
import subprocess
import unittest

import rostest

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
UBUNTU = 'PRETTY_NAME="Ubuntu 20.04.6 LTS"\nVERSION_CODENAME=focal'
DEBIAN = 'PRETTY_NAME="Debian GNU/Linux 12 (bookworm)"\nVERSION_CODENAME=bookworm'
NOTHING = {'dpkg-query': 'false'}
# Whether as root or through sudo: says what it was asked for, and fails.
FAKES = {'apt-get': 'echo asked: apt-get "$@"; false', 'sudo': 'echo asked: "$@"; false'}


def run(command, functions, **environment):
    """Status and all that ./catkin_ws.sh said."""
    names = {'BASH_FUNC_%s%%%%' % name: '() { %s; }' % body for name, body in {**FAKES, **functions}.items()}
    done = subprocess.run(['bash', os.path.join(TOP, 'catkin_ws.sh'), command], env={**os.environ, **names, **environment},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, timeout=50)
    return done.returncode, done.stdout


def system(release):
    return {'cat': "printf '%%s\\n' '%s'" % release}


class WorkspaceScript(unittest.TestCase):
    def test_installs_nothing_on_another_system(self):
        status, said = run('deps', {**NOTHING, **system(UBUNTU)})
        self.assertEqual(status, 1)
        self.assertEqual(said, 'catkin_ws.sh: needed packages are missing; only Debian 12 (bookworm) has them, and this '
                               'is Ubuntu 20.04.6 LTS: use a container of debian:12 (README, On another system)\n')

    def test_says_so_where_no_system_tells_its_name(self):
        status, said = run('deps', {**NOTHING, 'cat': 'false'})
        self.assertEqual(status, 1)
        self.assertIn('this is another system: use', said)

    def test_installs_on_debian_12(self):
        status, said = run('deps', {**NOTHING, **system(DEBIAN)})
        self.assertEqual(status, 1)
        self.assertIn('asked: apt-get update', said)
        self.assertIn('apt-get update failed', said)

    def test_asks_for_no_system_where_all_is_there(self):
        self.assertEqual(run('deps', {'dpkg-query': 'echo install ok installed', **system(UBUNTU)}), (0, ''))

    def environment_with(self, distribution):
        """What a command of the script sees of variables that a ROS of /elsewhere has set."""
        names = ('CMAKE_PREFIX_PATH', 'LD_LIBRARY_PATH', 'PKG_CONFIG_PATH', 'ROS_PACKAGE_PATH')
        status, said = run('help', {'cat': 'env'}, ROS_DISTRO=distribution, ROS_MASTER_URI='http://there:11311',
                           **dict.fromkeys(names, '/elsewhere'))
        self.assertEqual(status, 0)
        self.assertIn('ROS_MASTER_URI=http://there:11311\n', said)
        return said, [name for name in names if name + '=/elsewhere\n' in said], names

    def test_forgets_another_ros(self):
        said, left, _ = self.environment_with('noetic')
        self.assertEqual(left, [])
        self.assertNotIn('ROS_DISTRO=', said)

    def test_keeps_overlays(self):
        _, left, names = self.environment_with('Debian')
        self.assertEqual(left, list(names))


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'workspace_script', WorkspaceScript)
