"""Whether a back end lost a unit. A busy machine does that to a driver now and then, for emulated ECUs and driver share
its processors: motors are stopped then, and commands refused, until clear_faults and enable."""
import functools
import re
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray

ATTEMPTS = 4
# As `last_stop` of the driver's diagnostics begins where frames did not come in time.
UNIT_LOST = re.compile(r'(ecu_lost|bus_silent): |ecu_stopped: .*\((sync_lost|reference_lost)\)')


class UnitLost(AssertionError):
    """There is no use in waiting for more."""


def values_of(status):
    return {v.key: v.value for v in status.values}


class BackEnd:
    """What it reports of itself in /diagnostics, at 1 Hz."""

    def __init__(self):
        self.reports, self.first, self.stops = 0, 0, 0
        self.statuses = []
        self.subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, self.receive)

    def receive(self, message):
        self.statuses = message.status
        self.reports += 1

    def begin(self):
        """What was before is of no interest any more."""
        self.first = self.reports
        if self.statuses:
            self.stops = int(values_of(self.statuses[0]).get('stops', 0))

    def unit_lost(self):
        """Which one it has lost since begin(), in its own words; None if none, or if it stopped for another reason."""
        if self.reports == self.first:
            return None
        own = values_of(self.statuses[0])
        if int(own.get('stops', 0)) > self.stops:
            return own['last_stop'] if UNIT_LOST.match(own['last_stop']) else None
        # While nothing runs, nothing is stopped.
        lost = ['%s: %s: %s' % (status.name, key, value) for status in self.statuses
                for key, value in values_of(status).items() if key in ('ecu_lost', 'bus_silent')]
        return '; '.join(lost) or None

    def unit_lost_by_now(self):
        """The same, of a report that is newer than what went wrong."""
        wanted, end = self.reports + 3, time.time() + 10.0
        while self.reports < wanted and time.time() < end:
            time.sleep(0.05)
        return self.unit_lost()

    def unless_lost(self, condition):
        """For waiting: the condition, but no waiting for what a robot that lost a unit does not do."""
        def check():
            if condition():
                return True
            lost = self.unit_lost()
            if lost:
                raise UnitLost('the back end lost a unit: ' + lost)
            return False
        return check


def begins_anew_if_a_unit_is_lost(test):
    """A test that fails, and its back end says that it lost a unit meanwhile, begins anew, a few times. What fails
    for any other reason has failed. The test's object has a back_end; recover(), after a unit was lost; and start(), which
    clears faults and makes the robot ready."""
    @functools.wraps(test)
    def attempts(self):
        for left in reversed(range(ATTEMPTS)):
            self.back_end.begin()
            try:
                self.start()
                return test(self)
            except AssertionError as failure:
                # What a wait has seen is not asked for again: start() may have cleared it since.
                seen = isinstance(failure, UnitLost) and str(failure)
                lost = (seen or self.back_end.unit_lost_by_now()) if left else None
                if not lost:
                    raise
                rospy.logwarn('%s begins anew: %s (%s)', test.__name__, lost, str(failure).split('\n')[0])
                self.recover()
    return attempts


def all_begin_anew(tests):
    """Decorates a class of tests with the above."""
    for name, test in list(vars(tests).items()):
        if name.startswith('test_'):
            setattr(tests, name, begins_anew_if_a_unit_is_lost(test))
    return tests
