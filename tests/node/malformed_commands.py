"""Commands that simulator and driver refuse whole: names, modes, references. For a robot with `lateral_deltoid`."""
import math

MALFORMED_COMMANDS = [
    ([], [], []),
    (['nobody'], [1], [1.0]),
    ([''], [1], [1.0]),
    (['Lateral_Deltoid'], [1], [1.0]),
    (['lateral_deltoid', 'nobody'], [1, 1], [1.0, 1.0]),
    (['lateral_deltoid', 'lateral_deltoid'], [1, 1], [1.0, 2.0]),
    (['lateral_deltoid'], [], [1.0]),
    (['lateral_deltoid'], [1], []),
    (['lateral_deltoid'], [1, 1], [1.0]),
    (['lateral_deltoid'], [1], [1.0, 2.0]),
    (['lateral_deltoid'], [4], [1.0]),
    (['lateral_deltoid'], [255], [1.0]),
    (['lateral_deltoid'], [1], [math.nan]),
    (['lateral_deltoid'], [1], [math.inf]),
    (['lateral_deltoid'], [0], [12.5]),
    (['lateral_deltoid'], [1], [-1e3]),
    (['lateral_deltoid'], [2], [100.0]),
    (['lateral_deltoid'], [3], [-1.0]),
]
