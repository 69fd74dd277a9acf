#!/usr/bin/env python3
"""Two back ends must not speak for one robot: the second one refuses, and the first goes on."""
import contextlib
import os
import signal
import socket
import subprocess
import time
import unittest

import rosgraph
import rosnode
import rospkg
import rosservice
import rospy
import rostest
from anthrob_msgs.msg import MuscleStates
from std_srvs.srv import Trigger


def where(node):
    """Its address by the master, which changes when another process takes the name."""
    return rosnode.get_api_uri(rosgraph.Master('/test'), node, skip_cache=True)


def wait_for(condition):
    end = time.monotonic() + 40
    while not condition():
        assert time.monotonic() < end, 'waited in vain'
        time.sleep(0.1)


def wait_for_states(master):
    """Until somebody publishes the robot's states at that master."""
    topics = rosgraph.Master('/test', master)
    wait_for(lambda: '/anthrob/muscle_states' in [topic for topic, _ in topics.getSystemState()[0]])


@contextlib.contextmanager
def other_master():
    """The address of one where nobody else has a simulator."""
    with socket.socket() as free:
        free.bind(('localhost', 0))
        port = free.getsockname()[1]
    uri = 'http://localhost:%d' % port
    core = subprocess.Popen(['roscore', '-p', str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                            env=dict(os.environ, ROS_MASTER_URI=uri), start_new_session=True)
    try:
        wait_for(lambda: rosgraph.is_master_online(uri))
        yield uri
    finally:
        core.terminate()
        core.communicate()


class SecondBackend(unittest.TestCase):

    def start(self, name, namespace='/anthrob', master=os.environ['ROS_MASTER_URI']):
        config = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config', 'anthrob')
        return subprocess.Popen(['rosrun', 'anthrob_sim', 'anthrob_simulator', '__name:=' + name, '__ns:=' + namespace,
                                 '_model:=' + os.path.join(config, 'model_I.yaml')],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True,
                                env=dict(os.environ, ROS_MASTER_URI=master))

    def check_goes_on(self):
        """The first one's states and services: a second one that offers the same would take their place."""
        rospy.wait_for_message('muscle_states', MuscleStates, 20)
        self.assertEqual(rosservice.get_service_node('/anthrob/emergency_stop'), '/anthrob/simulator')
        for service in 'disable', 'enable':
            self.assertTrue(rospy.ServiceProxy(service, Trigger)().success, service)
        self.assertTrue(rospy.get_param('/use_sim_time'))  # it publishes the clock

    def check_refused(self, name, why, namespace='/anthrob'):
        first = where('/anthrob/simulator')
        self.check_goes_on()
        second = self.start(name, namespace)
        said = second.communicate(timeout=40)[0]
        self.assertEqual(second.returncode, 2, said)
        self.assertIn(why, said)
        self.check_goes_on()
        self.assertEqual(where('/anthrob/simulator'), first)

    def test_a_second_simulator_is_refused(self):
        self.check_refused('second', '/anthrob/simulator publishes it already')

    def test_a_second_one_of_the_same_name_is_refused(self):
        self.check_refused('simulator', '/anthrob/simulator runs already')

    def test_a_second_launch_ends_no_node_of_the_first(self):
        first = {node: where(node) for node in rosnode.get_node_names('/anthrob')}
        self.assertGreater(len(first), 2, first)
        outside = {key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'}
        second = subprocess.run(['roslaunch', 'anthrob_bringup', 'sim.launch', 'model:=I'], env=outside, timeout=40,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertIn('/anthrob/simulator runs already', second.stdout)
        self.check_goes_on()
        for node, uri in first.items():
            self.assertEqual(where(node), uri, node)
            self.assertTrue(rosnode.rosnode_ping(node, max_count=1, skip_cache=True), node)

    def test_one_of_another_robot_is_refused_too(self):
        self.check_refused('simulator', '/clock: /anthrob/simulator publishes it already', namespace='/elsewhere')

    def test_one_that_is_held_up_is_refused_to(self):
        with other_master() as master:
            held = self.start('held', master=master)
            try:
                wait_for_states(master)
                os.killpg(held.pid, signal.SIGSTOP)  # it accepts connections and answers nothing
                second = self.start('held', master=master)
                said = second.communicate(timeout=40)[0]
                self.assertEqual(second.returncode, 2, said)
                self.assertIn('/anthrob/held runs already', said)
            finally:
                os.killpg(held.pid, signal.SIGKILL)
                held.communicate()

    def test_a_dead_one_of_the_same_name_is_no_obstacle(self):
        with other_master() as master:
            dead = self.start('simulator', master=master)
            wait_for_states(master)
            where_it_was = rosgraph.Master('/test', master).lookupNode('/anthrob/simulator')
            os.killpg(dead.pid, signal.SIGKILL)
            dead.communicate()
            heir = self.start('simulator', master=master)
            try:
                wait_for(lambda: rosgraph.Master('/test', master).lookupNode('/anthrob/simulator') != where_it_was)
                # It is offered after all refusals.
                wait_for(lambda: '/anthrob/enable' in [
                    name for name, nodes in rosgraph.Master('/test', master).getSystemState()[2]] or heir.poll())
                self.assertIsNone(heir.poll())
            finally:
                heir.terminate()
                heir.communicate()


if __name__ == '__main__':
    rospy.init_node('second_backend_test')
    rostest.rosrun('anthrob_tests', 'second_backend', SecondBackend)
