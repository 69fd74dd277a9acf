"""What tests wait for."""
import time


def wait_for(condition, seconds, what):
    """Of wall time."""
    end = time.time() + seconds
    while time.time() < end:
        if condition():
            return
        time.sleep(0.01)
    raise AssertionError('waited %.1f s for: %s' % (seconds, what))
