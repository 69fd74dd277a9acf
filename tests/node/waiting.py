"""What tests wait for."""
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray

LEVELS = ['OK', 'WARN', 'ERROR', 'STALE']
REPORT_TIME = 2.5  # [s] in which every node has reported, at 1 Hz


def described(statuses):
    """A line for each: level, name and message; values of the first, and of what is not well."""
    lines = []
    for status in statuses:
        values = ', '.join('%s: %s' % (v.key, v.value) for v in status.values if not lines or status.level)
        lines.append('  %s %s: %s {%s}' % (LEVELS[status.level], status.name, status.message, values))
    return '\n'.join(lines)


def diagnosed():
    """What diagnostics say now."""
    if not rospy.core.is_initialized():
        return 'this test is no node, and has no diagnostics'
    statuses = {}
    subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray,
                                  lambda message: statuses.update((s.name, s) for s in message.status))
    time.sleep(REPORT_TIME)
    subscriber.unregister()
    return 'diagnostics:\n' + (described(list(statuses.values())) or '  none in %g s' % REPORT_TIME)


def wait_for(condition, seconds, what):
    """Of wall time."""
    end = time.time() + seconds
    while time.time() < end:
        if condition():
            return
        time.sleep(0.01)
    raise AssertionError('waited %.1f s for: %s; %s' % (seconds, what, diagnosed()))
