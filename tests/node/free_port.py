"""For a ROS master of one's own."""
import socket


def free_port():
    """One that nobody listened at a moment ago, as text."""
    with socket.socket() as probe:
        probe.bind(('', 0))
        return str(probe.getsockname()[1])
