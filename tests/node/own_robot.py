"""A robot, simulated or with emulated ECUs, launched by the test itself with a ROS master of its own: for tests that treat
both badly."""
import os
import signal
import subprocess
import sys
import threading
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
from anthrob_msgs.msg import MuscleCommand, MuscleStates
from diagnostic_msgs.msg import DiagnosticArray
from std_srvs.srv import Trigger
from back_end import BackEnd
from free_port import free_port
from waiting import wait_for

EMULATED = 'backend:=emulated' in sys.argv
PACE = float(os.environ.get('ANTHROB_PACE', '1.0')) if EMULATED else 1.0  # seconds of the robot in one of the wall clock
NODE = '/anthrob/driver' if EMULATED else '/anthrob/simulator'
MUSCLE = 'lateral_deltoid'
PULL = 1.0  # [V] for a minute, by which no unit sees too large a force
# For what takes milliseconds, or at most some seconds by the watches of the node: the rest is for a busy machine.
PATIENCE = 15.0 / PACE
PORT = free_port()
os.environ['ROS_MASTER_URI'] = 'http://localhost:' + PORT
OUTSIDE = {key: value for key, value in os.environ.items() if key != 'ROS_NAMESPACE'}


class Core:
    """A ROS master."""

    def start(self):
        self.process = subprocess.Popen(['rosmaster', '--core', '-p', PORT], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, start_new_session=True, env=OUTSIDE)
        wait_for(rosgraph.is_master_online, 120, 'the master')

    def kill(self):
        self.process.kill()
        self.process.wait()


class OwnRobot(unittest.TestCase):
    """Each test begins with a motor at PULL, by commands that go on."""
    command = None

    @classmethod
    def setUpClass(cls):
        cls.core = Core()
        cls.core.start()
        options = ['backend:=emulated', 'can:=vcan0', 'realtime:=true', 'pace:=%g' % PACE] if EMULATED else ['backend:=sim']
        cls.robot = subprocess.Popen(['roslaunch', 'anthrob_bringup', 'robot.launch'] + options, start_new_session=True,
                                     env=OUTSIDE)
        rospy.init_node('own_robot_test', disable_signals=True)
        cls.seen = {}
        rospy.Subscriber('/anthrob/muscle_states', MuscleStates, cls.receive_states, queue_size=10)
        rospy.Subscriber('/diagnostics', DiagnosticArray, cls.receive_report, queue_size=10)
        cls.publisher = rospy.Publisher('/anthrob/muscle_command', MuscleCommand, queue_size=10)
        threading.Thread(target=cls.renew_command, daemon=True).start()
        cls.back_end = BackEnd()
        rospy.wait_for_service('/anthrob/gains', 180)
        wait_for(lambda: len(cls.seen) == 2 and cls.publisher.get_num_connections() > 0, 180, 'connections')
        wait_for(lambda: cls.call('enable').success, 30 / PACE, 'the first enable')

    @classmethod
    def tearDownClass(cls):
        cls.core.process.send_signal(signal.SIGCONT)
        os.killpg(cls.robot.pid, signal.SIGINT)
        cls.robot.wait(60)
        cls.core.kill()

    @classmethod
    def receive_states(cls, message):
        cls.seen['states'] = message

    @classmethod
    def receive_report(cls, message):
        if message.status[0].name in ('/anthrob: driver', '/anthrob: simulator'):
            cls.seen['report'] = message.status[0]

    @classmethod
    def renew_command(cls):
        while True:
            if OwnRobot.command:
                cls.publisher.publish(OwnRobot.command)
            time.sleep(0.05)

    @classmethod
    def call(cls, name):
        return rospy.ServiceProxy('/anthrob/' + name, Trigger)()

    def tearDown(self):
        OwnRobot.command = None

    def recover(self):
        OwnRobot.command = None
        wait_for(self.is_registered, PATIENCE, 'registration')
        wait_for(lambda: self.call('clear_faults').success, 30 / PACE, 'clear_faults')

    def start(self):
        self.recover()
        wait_for(lambda: self.call('enable').success, 30 / PACE, 'enable')
        OwnRobot.command = MuscleCommand(name=[MUSCLE], mode=[0], reference=[PULL])
        self.wait_for(lambda: abs(self.volts() - PULL) < 0.02, PATIENCE, '%g V' % PULL)

    def wait_for(self, condition, seconds, what):
        wait_for(self.back_end.unless_lost(condition), seconds, what)

    @property
    def states(self):
        return self.seen['states']

    @property
    def values(self):
        """Of the back end's own diagnostics."""
        return {value.key: value.value for value in self.seen['report'].values}

    def volts(self):
        return self.states.voltage[self.states.name.index(MUSCLE)]

    def is_stopped(self):
        return set(self.states.ecu_state) == {MuscleStates.STOPPING} and self.volts() == 0.0

    def is_registered(self):
        """Whether whoever starts now finds the stop."""
        try:
            _, subscribers, services = rosgraph.Master('/test').getSystemState()
        except OSError:
            return False
        return all(NODE in dict(known).get('/anthrob/emergency_stop', []) for known in (subscribers, services))

    def server(self):
        """That of the back end, which every node has for the others; and its address."""
        uri = rosgraph.Master('/test').lookupNode(NODE)
        return xmlrpc.client.ServerProxy(uri), uri

    def check_a_new_program_stops_it(self, *command):
        begin = time.time()
        program = subprocess.Popen(command, env=OUTSIDE, stdout=subprocess.DEVNULL)
        self.addCleanup(program.wait)
        self.wait_for(self.is_stopped, PATIENCE, ' '.join(command) + ' to stop the motors')
        print('%s: stopped after %.2f s' % (' '.join(command), time.time() - begin))
        self.assertFalse(self.call('enable').success)

    def check_stop_by_topic(self):
        self.check_a_new_program_stops_it('rostopic', 'pub', '-1', '/anthrob/emergency_stop', 'std_msgs/Empty')

    def check_stop_by_service(self):
        # A call that finds no descriptor ends with an error; whoever wants to stop a robot tries again.
        self.check_a_new_program_stops_it('bash', '-c', 'until rosservice call /anthrob/emergency_stop; do sleep 0.1; done')
