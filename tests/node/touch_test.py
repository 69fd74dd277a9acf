#!/usr/bin/env python3
"""The mouse on the arm: what RViz says while a link is dragged, and what the simulated arm does."""
import math
import os
import signal
import subprocess
import time
import unittest
import xmlrpc.client

import rosgraph
import rospkg
import rospy
import rostest
from anthrob_msgs.msg import ExternalWrenches, SphericalJointStates
from geometry_msgs.msg import Point, Quaternion
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit, Marker, MarkerArray
from waiting import wait_for

WRIST = Point(y=-0.21)   # [m] in the forearm's frame: y runs up the bone, the elbow bends towards z
LIMIT = 30.0             # [N]
STIFFNESS = 100.0        # [N/m]
SILENCE = 0.5            # [s] without a word from RViz
DURATION = 0.2           # [s] of a push that is not renewed


CONFIG = os.path.join(rospkg.RosPack().get_path('anthrob_bringup'), 'config', 'anthrob')
GO_THERE, FORGET = 1, 2  # entries of the menu


def size(vector):
    return math.sqrt(vector.x ** 2 + vector.y ** 2 + vector.z ** 2)


def forearm_at(elbow):
    """Orientation of the forearm in the world while the humerus hangs as at rest."""
    yaw, roll = math.pi / 4 + 2.2707982412787193, math.pi / 2 - elbow
    z, x = (math.cos(yaw / 2), math.sin(yaw / 2)), (math.cos(roll / 2), math.sin(roll / 2))
    return Quaternion(w=z[0] * x[0], x=z[0] * x[1], y=z[1] * x[1], z=z[1] * x[0])


class Touch(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.wrenches, cls.arrows, cls.markers, cls.elbow, cls.shoulder = [], [], [], None, None
        cls.subscribers = [
            rospy.Subscriber('external_wrenches', ExternalWrenches, cls.wrenches.append, queue_size=1000, tcp_nodelay=True),
            rospy.Subscriber('push/force', MarkerArray, cls.arrows.append, queue_size=100),
            rospy.Subscriber('push/update_full', InteractiveMarkerInit, cls.see_markers, queue_size=10),
            rospy.Subscriber('spherical_joint_states', SphericalJointStates, cls.see_shoulder, queue_size=1, tcp_nodelay=True),
            rospy.Subscriber('joint_states', JointState, cls.see_joints, queue_size=1, tcp_nodelay=True)]
        cls.feedback = rospy.Publisher('push/feedback', InteractiveMarkerFeedback, queue_size=10)
        cls.reset = rospy.ServiceProxy('sim/reset', Trigger)
        wait_for(lambda: 'forearm' in cls.markers and cls.feedback.get_num_connections() and cls.elbow is not None
                 and cls.shoulder is not None, 20,
                 'a marker on the forearm')

    @classmethod
    def see_markers(cls, message):
        cls.markers = [marker.name for marker in message.markers]

    @classmethod
    def see_joints(cls, message):
        cls.elbow = message.position[message.name.index('elbow')]

    @classmethod
    def see_shoulder(cls, message):
        cls.shoulder = 2.0 * math.acos(min(1.0, message.orientation[0].w))

    def turned(self):
        """How far the arm is from rest [rad]: the humerus may swing rather than the elbow bend."""
        return abs(self.elbow) + self.shoulder

    def setUp(self):
        self.say('MOUSE_UP')
        self.reset()
        wait_for(lambda: abs(self.elbow) < 0.05, 5, 'the arm at rest')
        time.sleep(0.5)  # a hand is no faster; the node has seen the new posture then
        del self.wrenches[:], self.arrows[:]

    def say(self, event, y=0.0, z=0.0):
        """As RViz does: the marker's place in the frame of the link."""
        message = InteractiveMarkerFeedback(client_id='touch_test', marker_name='forearm', control_name='pull')
        message.header.frame_id = 'forearm'
        message.event_type = getattr(InteractiveMarkerFeedback, event)
        message.pose.position = Point(y=y, z=z)
        message.pose.orientation.w = 1.0
        message.mouse_point = WRIST
        message.mouse_point_valid = event != 'POSE_UPDATE'
        self.feedback.publish(message)

    def drag(self, y, z):
        self.say('MOUSE_DOWN')
        self.say('POSE_UPDATE', y, z)

    def hold_until(self, condition, what):
        """The mouse stands still: RViz says every quarter of a second that its button is down."""
        def held():
            if rospy.get_time() > self.said + 0.25:
                self.said = rospy.get_time()
                self.say('KEEP_ALIVE')
            return condition()
        self.said = rospy.get_time()
        wait_for(held, 10, what)

    def pushes(self):
        return [m for m in self.wrenches if m.link]

    def ended(self):
        return bool(self.wrenches) and not self.wrenches[-1].link

    # ---- the tests, in the order of their names

    def test_a_marker_is_on_every_link_that_moves(self):
        self.assertEqual(sorted(self.markers), ['forearm', 'humerus'])

    def test_b_a_drag_lifts_the_arm_and_its_end_lets_it_go(self):
        self.drag(0.15, 0.2)
        self.hold_until(lambda: self.turned() > 0.2, 'the arm is lifted')
        first = next(m for m in self.pushes() if size(m.wrench[0].force) > 1.0)  # from when the mouse moved
        self.assertEqual(first.link, ['forearm'])
        self.assertEqual(first.point[0], WRIST)
        # The arm is at rest still: the spring alone.
        self.assertAlmostEqual(size(first.wrench[0].force), STIFFNESS * 0.25, delta=0.5)
        self.assertLessEqual(max(m.left[0].to_sec() for m in self.pushes()), DURATION + 1e-9)
        # The mouse stands still in the world, so that the force falls as the arm follows.
        self.hold_until(lambda: size(self.pushes()[-1].wrench[0].force) < 0.8 * STIFFNESS * 0.25, 'a smaller force')
        wait_for(lambda: any('N' in marker.text for array in self.arrows for marker in array.markers), 5, 'the force as text')
        lifted = self.turned()
        self.say('MOUSE_UP')
        wait_for(self.ended, 0.5, 'the end of the push')
        wait_for(lambda: self.turned() < lifted - 0.1, 5, 'the arm falls')
        self.assertTrue(self.ended())
        self.assertEqual([(m.action, m.header.frame_id) for m in self.arrows[-1].markers], 2 * [(Marker.DELETE, 'world')])

    def test_c_the_force_has_a_limit(self):
        self.drag(0.0, 2.0)
        self.hold_until(lambda: len(self.pushes()) > 50, 'pushes')
        forces = [size(m.wrench[0].force) for m in self.pushes()]
        self.assertAlmostEqual(max(forces), LIMIT, delta=1e-9)

    def test_d_a_window_that_falls_silent_lets_go(self):
        self.drag(0.1, 0.1)
        begin = rospy.get_time()
        wait_for(self.pushes, 2, 'the push')
        wait_for(self.ended, 3, 'its end')
        self.assertGreater(self.wrenches[-1].header.stamp.to_sec() - begin, SILENCE - 0.1)
        self.assertLess(self.wrenches[-1].header.stamp.to_sec() - begin, SILENCE + DURATION + 0.3)

    def test_e_nonsense_moves_nothing(self):
        self.say('POSE_UPDATE', 0.3, 0.3)  # nobody grabbed it
        self.say('MOUSE_DOWN', y=float('nan'))
        self.say('POSE_UPDATE', z=float('inf'))
        rospy.sleep(0.3)
        self.assertEqual(self.pushes(), [])

    def test_f_a_ghost_is_turned_and_the_arm_follows(self):
        handles, ghosts = [], []
        watchers = [rospy.Subscriber('posture/update_full', InteractiveMarkerInit, handles.append, queue_size=10),
                    rospy.Subscriber('posture/ghost', MarkerArray, ghosts.append, queue_size=100)]
        feedback = rospy.Publisher('posture/feedback', InteractiveMarkerFeedback, queue_size=10)
        controller = subprocess.Popen(['rosrun', 'anthrob_control', 'anthrob_computed_force',
                                       '_model:=' + os.path.join(CONFIG, 'model_II.yaml'),
                                       '_settings:=' + os.path.join(CONFIG, 'control.yaml')])
        self.addCleanup(controller.wait)
        self.addCleanup(controller.terminate)

        def say(event, elbow=0.0, entry=0):
            message = InteractiveMarkerFeedback(client_id='touch_test', marker_name='forearm', control_name='axis_0')
            message.header.frame_id = 'world'
            message.event_type = getattr(InteractiveMarkerFeedback, event)
            message.pose.orientation = forearm_at(elbow)
            message.menu_entry_id = entry
            feedback.publish(message)

        def remark():
            return ([m.text for m in ghosts[-1].markers if m.ns == 'remark'] + [''])[0] if ghosts else ''

        wait_for(lambda: handles and handles[-1].markers and feedback.get_num_connections(), 15, 'handles on the joints')
        rings = {marker.name: len([c for c in marker.controls if c.interaction_mode == c.ROTATE_AXIS])
                 for marker in handles[-1].markers}
        self.assertEqual(rings, {'humerus': 3, 'forearm': 1})

        say('MOUSE_DOWN')
        say('POSE_UPDATE', 3.0)
        wait_for(lambda: remark() == 'elbow: at its stop', 5, 'a ghost at the stop')
        say('MENU_SELECT', entry=FORGET)
        wait_for(lambda: ghosts[-1].markers[0].action == Marker.DELETEALL, 5, 'no ghost')

        say('POSE_UPDATE', 0.8)
        say('MOUSE_UP')
        wait_for(lambda: remark().startswith('right-click'), 5, 'a ghost')
        self.assertLess(self.elbow, 0.2)  # nothing moves before the menu is asked
        say('MENU_SELECT', entry=GO_THERE)
        wait_for(lambda: abs(self.elbow - 0.8) < 0.1, 10, 'the arm where the ghost is')
        wait_for(lambda: ghosts[-1].markers[0].action == Marker.DELETEALL, 5, 'no ghost')
        del watchers[:]

    def test_z_a_push_ends_when_the_node_dies(self):
        self.drag(0.1, 0.1)
        wait_for(self.pushes, 2, 'the push')
        node = xmlrpc.client.ServerProxy(rosgraph.Master('/touch_test').lookupNode('/anthrob/touch'))
        os.kill(node.getPid('/touch_test')[2], signal.SIGKILL)
        killed = rospy.get_time()
        wait_for(self.ended, 2, 'its end')
        self.assertLess(self.wrenches[-1].header.stamp.to_sec() - killed, DURATION + 0.1)


if __name__ == '__main__':
    rospy.init_node('touch_test')
    rostest.rosrun('anthrob_tests', 'touch', Touch)
