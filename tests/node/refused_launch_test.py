#!/usr/bin/env python3
"""sim.launch beside a robot that somebody else drives, in true time: refused, and all is as it was."""
import os
import subprocess
import unittest

import rosservice
import rospy
import rostest
from anthrob_msgs.msg import MuscleStates
from std_srvs.srv import Trigger, TriggerResponse


class RefusedLaunch(unittest.TestCase):

    def test_leaves_services_and_time_of_the_robot_alone(self):
        states = rospy.Publisher('muscle_states', MuscleStates, queue_size=1)
        stop = rospy.Service('emergency_stop', Trigger, lambda request: TriggerResponse(success=True, message='the robot'))
        outside = {key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'}
        second = subprocess.run(['roslaunch', 'anthrob_bringup', 'sim.launch', 'model:=I'], env=outside, timeout=40,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertIn('%s publishes it already' % rospy.get_name(), second.stdout)
        self.assertEqual(rosservice.get_service_node('/anthrob/emergency_stop'), rospy.get_name())
        self.assertEqual(rospy.ServiceProxy('emergency_stop', Trigger)().message, 'the robot')
        # Who is started now would wait for ever for a clock that nobody publishes.
        self.assertFalse(rospy.get_param('/use_sim_time'))
        states.unregister()
        stop.shutdown()


if __name__ == '__main__':
    rospy.init_node('refused_launch_test')
    rostest.rosrun('anthrob_tests', 'refused_launch', RefusedLaunch)
