#!/usr/bin/env python3
"""Whoever sends nonsense to a back end, or takes all its descriptors, does not keep others from stopping it."""
import contextlib
import resource
import socket
import struct
import time
import urllib.parse

import rospy
import rostest
from anthrob_msgs.msg import MuscleCommand
from anthrob_msgs.srv import Gains, GainsRequest
from back_end import all_begin_anew
from own_robot import PATIENCE, PULL, OwnRobot
from waiting import wait_for

MANY = 33000000
LIMIT = 200  # descriptors


class FalseCommand(MuscleCommand):
    """Claims many names in 56 bytes."""

    def serialize(self, buff):
        buff.write(struct.pack('<IIIII', 0, 0, 0, 0, MANY) + bytes(36))


class FalseGains(GainsRequest):

    def serialize(self, buff):
        buff.write(struct.pack('<I', MANY) + bytes(36))


@all_begin_anew
class Hostile(OwnRobot):

    @contextlib.contextmanager
    def few_descriptors(self):
        """So that it needs few connections to take them all."""
        server, _ = self.server()
        pid = server.getPid('/test')[2]
        before = resource.prlimit(pid, resource.RLIMIT_NOFILE)
        resource.prlimit(pid, resource.RLIMIT_NOFILE, (LIMIT, before[1]))
        try:
            yield
        finally:
            resource.prlimit(pid, resource.RLIMIT_NOFILE, before)

    @contextlib.contextmanager
    def connections(self, count, port):
        with contextlib.ExitStack() as stack:
            sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
            for one in sockets:
                one.setblocking(False)
                one.connect_ex(('localhost', port))
            yield sockets

    def ports(self):
        """Of its two servers: for topics and services, and for other nodes."""
        server, uri = self.server()
        topics = server.requestTopic('/test', '/anthrob/muscle_states', [['TCPROS']])[2][2]
        return topics, urllib.parse.urlparse(uri).port

    def test_counts_beyond_the_message(self):
        rejected = int(self.values['rejected_commands'])
        for _ in range(40):
            self.publisher.publish(FalseCommand())
            time.sleep(0.02)
            self.assertGreater(self.volts(), 0.9 * PULL)
        self.wait_for(lambda: int(self.values['rejected_commands']) >= rejected + 40, PATIENCE, 'refusals in diagnostics')
        self.assertIn('%d entries' % MANY, self.values['last_rejection'])
        self.assertGreater(self.volts(), 0.9 * PULL)
        begin = time.time()
        answer = rospy.ServiceProxy('/anthrob/gains', Gains)(FalseGains())
        self.assertLess(time.time() - begin, PATIENCE)
        self.assertFalse(answer.success)
        self.assertIn('%d entries' % MANY, answer.message)
        self.check_stop_by_topic()

    def check_idle_connections(self, stop):
        with self.few_descriptors():
            topics, nodes = self.ports()
            with self.connections(LIMIT, topics), self.connections(LIMIT, nodes):
                stop()

    def test_idle_connections_keep_nobody_from_the_stop_service(self):
        self.check_idle_connections(self.check_stop_by_service)

    def test_idle_connections_keep_nobody_from_the_stop_topic(self):
        self.check_idle_connections(self.check_stop_by_topic)

    def test_connections_that_are_not_idle_stop_the_motors(self):
        """What has said something may be somebody's, and is not shut down."""
        with self.few_descriptors():
            topics, _ = self.ports()
            with self.connections(LIMIT, topics) as connections:
                silent = set(connections)

                def is_stopped():
                    for one in list(silent):
                        with contextlib.suppress(OSError):  # it is not connected yet
                            one.send(b'?')
                            silent.remove(one)
                    return self.is_stopped()
                wait_for(is_stopped, PATIENCE, 'the motors to stop')
                self.wait_for(lambda: 'file descriptors are free' in self.seen['report'].message
                              + self.values.get('last_stop', ''), PATIENCE, 'the reason in diagnostics')


if __name__ == '__main__':
    rostest.rosrun('anthrob_tests', 'hostile', Hostile)
