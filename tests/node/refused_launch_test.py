#!/usr/bin/env python3
"""Launch files beside a robot that somebody else drives, in true time: refused, all is as it was, and none of their
nodes commands that robot."""
import contextlib
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import rosnode
import rosservice
import rospy
import rostest
from free_port import free_port
from anthrob_msgs.msg import MuscleCommand, MuscleStates, SphericalJointStates
from geometry_msgs.msg import Quaternion, Vector3
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger, TriggerResponse


MUSCLES = ['lateral_deltoid', 'anterior_deltoid', 'posterior_deltoid', 'supraspinatus', 'infraspinatus', 'teres_minor',
           'teres_major', 'pectoralis_major', 'biceps_brachii', 'triceps_brachii', 'brachialis']


class Robot:
    """An enabled robot at rest, which tells what it was asked for."""

    def __init__(self):
        self.asked = []
        self.muscles = rospy.Publisher('muscle_states', MuscleStates, queue_size=10)
        self.joints = rospy.Publisher('joint_states', JointState, queue_size=10)
        self.balls = rospy.Publisher('spherical_joint_states', SphericalJointStates, queue_size=10)
        self.commands = rospy.Subscriber('muscle_command', MuscleCommand,
                                         lambda command: self.asked.append('muscle_command'))
        self.service = rospy.Service('enable', Trigger, self.enable)
        self.runs = True
        self.thread = threading.Thread(target=self.publish)
        self.thread.start()

    def enable(self, request):
        self.asked.append('enable')
        return TriggerResponse(success=True)

    def publish(self):
        count = len(MUSCLES)
        while self.runs:
            states = MuscleStates(name=MUSCLES, mode=bytes(count), ecu_state=bytes([MuscleStates.ENABLED] * count))
            for quantity in 'position', 'velocity', 'current', 'voltage', 'reference':
                setattr(states, quantity, [0.0] * count)
            states.force = [5.0] * count
            joints = JointState(name=['elbow'], position=[0.1], velocity=[0.0])
            balls = SphericalJointStates(name=['shoulder'], orientation=[Quaternion(w=1.0)], angular_velocity=[Vector3()])
            for message, publisher in (states, self.muscles), (joints, self.joints), (balls, self.balls):
                message.header.stamp = rospy.Time.now()
                publisher.publish(message)
            time.sleep(0.005)

    def close(self):
        self.runs = False
        self.thread.join()
        for connection in self.muscles, self.joints, self.balls, self.commands:
            connection.unregister()
        self.service.shutdown()


class RefusedLaunch(unittest.TestCase):

    def launch(self, arguments, environment):
        return subprocess.run(['roslaunch', 'anthrob_bringup'] + arguments, env=environment, timeout=120,
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

    def test_commands_no_robot_but_its_own_simulator(self):
        robot = Robot()
        outside = {key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'}
        try:
            with tempfile.TemporaryDirectory() as folder:
                for arguments in (['computed_force.launch'], ['demo.launch', 'bag:=' + folder + '/demo.bag'],
                                  ['record.launch', 'protocol:=tier2_equilibria', 'out:=' + folder + '/record',
                                   'enable:=true'],
                                  ['record_zero_gravity.launch', 'out:=' + folder + '/zero']):
                    said = self.launch(arguments, outside)
                    # The simulator may end the launch before the other node has begun.
                    self.assertRegex(said, '~back_end: simulator: but {0} publishes /anthrob/muscle_states|'
                                           '/anthrob/muscle_states: {0} publishes it already'.format(rospy.get_name()))
                    self.assertEqual(robot.asked, [], arguments[0])
                    self.assertFalse(rospy.get_param('/use_sim_time'))
        finally:
            robot.close()

    def test_a_node_refuses_what_cannot_be_meant_and_ends_the_launch(self):
        port = free_port()  # of a master on which no robot runs
        alone = {key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'}
        alone['ROS_MASTER_URI'] = 'http://localhost:' + port
        late = r': expected above 0 and at most 1, because faster than real time measurements come too late'
        with tempfile.TemporaryDirectory() as folder:
            bag = 'bag:=' + folder + '/demo.bag'
            for arguments, expected in (
                    (['demo.launch', bag, 'mocap:=cameras'], "parameter ~mocap: 'cameras': expected virtual or none"),
                    (['demo.launch', bag, 'rate:=1.5'], r'parameter ~simulator_rate: 1\.5' + late),
                    (['computed_force.launch', 'rate:=0'], 'parameter ~simulator_rate: 0' + late),
                    (['robot.launch', 'backend:=emulated', 'can:=can0'], '~can: can0: expected a virtual|--can: can0: expected vcan0'),
                    (['robot.launch', 'homed:=true'], 'parameter ~homed: true: expected false, since a robot finds its zero by home'),
                    (['record.launch', 'out:=' + folder + '/out'], 'parameter ~protocol: missing; expected a protocol file')):
                with self.subTest(' '.join(arguments)):
                    said = subprocess.run(['roslaunch', '-p', port, 'anthrob_bringup'] + arguments, env=alone, timeout=120,
                                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
                    self.assertRegex(said, expected)
                    self.assertRegex(said, r'REQUIRED process \[.*\] has died!\n.*exit code 2')

    def test_ends_no_node_of_the_same_name(self):
        outside = {key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'}
        for name, arguments in (('/anthrob/mocap', ['mocap.launch']),
                                ('/anthrob/computed_force', ['computed_force.launch', 'sim:=false'])):
            with self.named_as(name):
                said = subprocess.run(['timeout', '-s', 'INT', '8', 'roslaunch', 'anthrob_bringup'] + arguments,
                                      env=outside, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
                self.assertIn(name + ' runs already', said)


if __name__ == '__main__':
    rospy.init_node('refused_launch_test')
    rostest.rosrun('anthrob_tests', 'refused_launch', RefusedLaunch)
