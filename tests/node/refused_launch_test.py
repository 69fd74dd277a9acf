#!/usr/bin/env python3
"""sim.launch beside a robot that somebody else drives, in true time: refused, and all is as it was."""
import contextlib
import os
import subprocess
import sys
import time
import unittest

import rosnode
import rosservice
import rospy
import rostest
from anthrob_msgs.msg import MuscleStates
from std_srvs.srv import Trigger, TriggerResponse


class RefusedLaunch(unittest.TestCase):

    def launch(self, arguments, environment):
        return subprocess.run(['roslaunch', 'anthrob_bringup'] + arguments, env=environment, timeout=40,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout

    @contextlib.contextmanager
    def named_as(self, name):
        """Another node that lives, with that name."""
        namespace, base = name.rsplit('/', 1)
        program = 'import rospy; rospy.init_node("%s"); rospy.spin()' % base
        other = subprocess.Popen([sys.executable, '-c', program], env=dict(os.environ, ROS_NAMESPACE=namespace))
        try:
            while name not in rosnode.get_node_names():
                time.sleep(0.1)
            yield
            self.assertIsNone(other.poll())
        finally:
            other.terminate()
            other.wait()

    def check_is_as_it_was(self):
        self.assertEqual(rosservice.get_service_node('/anthrob/emergency_stop'), rospy.get_name())
        self.assertEqual(rospy.ServiceProxy('emergency_stop', Trigger)().message, 'the robot')
        # Who is started now would wait for ever for a clock that nobody publishes.
        self.assertFalse(rospy.get_param('/use_sim_time'))

    def test_leaves_services_and_time_of_the_robot_alone(self):
        states = rospy.Publisher('muscle_states', MuscleStates, queue_size=1)
        stop = rospy.Service('emergency_stop', Trigger, lambda request: TriggerResponse(success=True, message='the robot'))
        outside = {key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'}
        for model in 'I', 'misspelt':
            said = self.launch(['sim.launch', 'model:=' + model], outside)
            self.assertIn('%s publishes it already' % rospy.get_name(), said)
            self.check_is_as_it_was()
        # A node that is refused for its name does not get as far as topics.
        with self.named_as('/anthrob/driver'):
            said = self.launch(['robot.launch', 'backend:=emulated', 'pace:=0.5'], outside)
            self.assertIn('/anthrob/driver runs already', said)
            self.check_is_as_it_was()
        states.unregister()
        stop.shutdown()


if __name__ == '__main__':
    rospy.init_node('refused_launch_test')
    rostest.rosrun('anthrob_tests', 'refused_launch', RefusedLaunch)
