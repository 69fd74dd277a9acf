#!/usr/bin/env python3
"""A second driver is refused before it opens the bus: its first frame there would stop the motors of the first one."""
import os
import subprocess
import unittest

import rospkg
import rospy
import rostest
from anthrob_msgs.msg import MuscleStates
from diagnostic_msgs.msg import DiagnosticArray


class SecondDriver(unittest.TestCase):

    def findings(self):
        """What diagnostics of the first one count since it runs."""
        rospy.wait_for_message('/diagnostics', DiagnosticArray, 60)
        report = rospy.wait_for_message('/diagnostics', DiagnosticArray, 60)
        return {value.key for status in report.status for value in status.values}

    def test_is_refused_before_it_is_on_the_bus(self):
        hardware = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config', 'anthrob', 'hardware.yaml')
        rospy.wait_for_message('muscle_states', MuscleStates, 60)
        for name, why in [('second', '/anthrob/driver publishes it already'),
                          ('driver', '/anthrob/driver runs already')]:
            # On a busy machine it takes a minute to start.
            done = subprocess.run(['rosrun', 'anthrob_driver', 'anthrob_driver', '__name:=' + name, '__ns:=/anthrob',
                                   '_can:=vcan0', '_hardware:=' + hardware],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=200)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(why, done.stdout)
            # Not its motors: on a busy machine they stop for want of frames, whoever else runs.
            found = self.findings()
            self.assertIn('frames_received', found)
            self.assertNotIn('second_host', found, name)
            rospy.wait_for_message('muscle_states', MuscleStates, 20)


if __name__ == '__main__':
    rospy.init_node('second_backend_driver_test')
    rostest.rosrun('anthrob_tests', 'second_backend_driver', SecondDriver)
