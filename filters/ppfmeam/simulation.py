# SPDX-License-Identifier: BSD-3-Clause
"""What the commands that simulate share."""
from . import scripting

SENSORS = ("structured-light", "active-stereo", "time-of-flight")


def camel(name):
    """ribbed_flange or time-of-flight as RibbedFlange, TimeOfFlight."""
    return "".join(word.capitalize() for word in name.replace("-", "_").split("_"))


def add_sensor_argument(parser):
    parser.add_argument("--sensor", choices=SENSORS, default=SENSORS[0],
                        help="what measures the depth (default: %(default)s)")


def set_sensor(source, name):
    """Sets the sensor of a vtkMEAMBinSceneSource."""
    scripting.set_choice(source, "Sensor", camel(name))
