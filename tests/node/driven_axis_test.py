#!/usr/bin/env python3
"""Stops, disable and the command time-out reach joints that are driven by efforts, on a robot without muscles."""
import time
import unittest

import rospy
import rostest
from anthrob_msgs.srv import SetState, SetStateRequest, Step
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import JointState
from std_msgs.msg import Empty
from std_srvs.srv import Trigger


class DrivenAxis(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.states, cls.reports = [], []
        cls.subscribers = [rospy.Subscriber('joint_states', JointState, cls.states.append, queue_size=1000),
                           rospy.Subscriber('/diagnostics', DiagnosticArray, cls.reports.append)]
        cls.effort = rospy.Publisher('joint_effort_command', JointState, queue_size=10, tcp_nodelay=True)
        cls.stop_topic = rospy.Publisher('emergency_stop', Empty, queue_size=1)
        rospy.wait_for_service('sim/step', 30)
        for name in ['enable', 'disable', 'emergency_stop', 'clear_faults', 'sim/reset']:
            setattr(cls, name.split('/')[-1], staticmethod(rospy.ServiceProxy(name, Trigger)))
        cls.set_state = staticmethod(rospy.ServiceProxy('sim/set_state', SetState))
        cls.step = staticmethod(rospy.ServiceProxy('sim/step', Step))

    def setUp(self):
        self.wait_until(lambda: self.effort.get_num_connections() > 0 and self.stop_topic.get_num_connections() > 0)
        self.clear_faults()
        self.enable()
        self.reset()

    def wait_until(self, condition):
        end = time.time() + 20
        while not condition():
            self.assertLess(time.time(), end)
            time.sleep(0.005)

    def push(self, newtons):
        self.effort.publish(JointState(name=['axis'], effort=[newtons]))
        time.sleep(0.1)

    def effort_after(self, steps):
        stamp = self.step(steps=steps).stamp
        self.wait_until(lambda: self.states and self.states[-1].header.stamp >= stamp)
        return self.states[-1].effort[0]

    def check_effort_becomes(self, newtons):
        """However long the command is under way: time stands still but for these steps."""
        self.wait_until(lambda: self.effort_after(1) == newtons)

    def test_lock_step_waits_for_its_effort(self):
        for k in range(1, 40):
            command = JointState(name=['axis'], effort=[float(k)])
            command.header.stamp = rospy.Time(0, k)
            self.effort.publish(command)
            answer = self.step(steps=1, command_stamp=command.header.stamp)
            self.assertTrue(answer.success, answer.message)
            self.wait_until(lambda: self.states and self.states[-1].header.stamp >= answer.stamp)
            self.assertEqual(self.states[-1].effort[0], float(k))
        answer = self.step(steps=1, command_stamp=rospy.Time(0, 40))
        self.assertFalse(answer.success)
        self.assertIn('no joint_effort_command', answer.message)

    def check_stop_is_latched(self):
        self.assertEqual(self.effort_after(2), 0.0)
        self.push(50.0)
        self.assertEqual(self.effort_after(2), 0.0)
        answer = self.enable()
        self.assertFalse(answer.success)
        self.assertIn('clear_faults', answer.message)
        self.assertTrue(self.clear_faults().success)
        self.push(50.0)
        self.assertEqual(self.effort_after(2), 0.0)
        self.assertTrue(self.enable().success)
        self.assertEqual(self.effort_after(2), 0.0)
        self.push(50.0)
        self.check_effort_becomes(50.0)

    def test_emergency_stop_service_is_latched(self):
        self.push(50.0)
        self.check_effort_becomes(50.0)
        self.assertTrue(self.emergency_stop().success)
        self.check_stop_is_latched()

    def test_emergency_stop_topic_is_latched(self):
        self.push(50.0)
        self.check_effort_becomes(50.0)
        self.stop_topic.publish(Empty())
        time.sleep(0.1)
        self.check_stop_is_latched()

    def test_disable(self):
        self.push(50.0)
        self.check_effort_becomes(50.0)
        self.assertTrue(self.disable().success)
        self.assertEqual(self.effort_after(2), 0.0)
        self.push(50.0)
        self.assertEqual(self.effort_after(2), 0.0)

    def test_timeout_stops_and_a_fresh_command_resumes(self):
        self.push(50.0)
        self.check_effort_becomes(50.0)
        self.assertEqual(self.effort_after(450), 50.0)
        self.assertEqual(self.effort_after(100), 0.0)
        self.push(20.0)
        self.check_effort_becomes(20.0)

    def test_nothing_of_a_state_that_broke_down_is_shown_or_lives_on(self):
        # No axis bears that: the numbers leave all sense within a step or two.
        self.push(1e300)
        shown = len(self.states)
        answer = self.step(steps=10)
        self.assertFalse(answer.success)
        self.assertIn('numerical failure', answer.message)
        self.wait_until(lambda: self.reports and 'numerical failure' in self.reports[-1].status[0].message)
        time.sleep(0.3)
        self.assertEqual(len(self.states), shown)
        for request in SetStateRequest(), SetStateRequest(joint_name=['axis'], joint_position=[0.2]):
            answer = self.set_state(request)
            self.assertTrue(answer.success, answer.message)
            self.assertTrue(self.step(steps=10).success)
            where = request.joint_position[0] if request.joint_position else 0.0
            self.wait_until(lambda: self.states and abs(self.states[-1].position[0] - where) < 1e-12)
            self.assertEqual((self.states[-1].velocity[0], self.states[-1].effort[0]), (0.0, 0.0))
            # Again, for the other request.
            self.push(1e300)
            self.assertFalse(self.step(steps=10).success)
        self.assertFalse(self.set_state(SetStateRequest(joint_name=['axis'], joint_position=[1.0])).success)
        self.assertFalse(self.step(steps=1).success)  # a refused posture does not hide the failure
        self.assertTrue(self.reset().success)
        self.assertTrue(self.step(steps=1).success)

    def test_diagnostics_name_the_joint_and_what_was_refused(self):
        self.effort.publish(JointState(name=['nobody'], effort=[1.0]))
        time.sleep(0.1)
        self.emergency_stop()

        def told():
            statuses = {s.name: s for s in self.reports[-1].status} if self.reports else {}
            if '/driven_axis: axis' not in statuses:
                return False
            values = {v.key: v.value for v in statuses['/driven_axis: simulator'].values}
            return statuses['/driven_axis: axis'].message == 'STOPPING' and 'nobody' in values['last_effort_rejection']

        self.wait_until(told)


if __name__ == '__main__':
    rospy.init_node('driven_axis_test')
    rostest.rosrun('anthrob_tests', 'driven_axis', DrivenAxis)
