"""A node's reports on /diagnostics (REP-107)."""

import rospy
from diagnostic_updater import Updater

from deformable_manipulation.cycles.health import CycleMonitor
from deformable_manipulation.ros import node

_PERIOD = 1.0  # s of real time, whatever the ROS clock does


def publish_diagnostics(reports):
    """Publish reports once per second, until shutdown.

    Args:
        reports: name -> function that gives a
            :class:`~deformable_manipulation.cycles.health.Report`; they appear as "<node>: <name>".
    """
    updater = Updater()
    updater.setHardwareID("none")
    for name, report in reports.items():
        updater.add(name, _task(report))
    node.every(_PERIOD, updater.force_update)


def cycle_monitor(scenario):
    """CycleMonitor for a node, in real time or lock-step."""
    lockstep = rospy.get_param("~lockstep", False)
    return CycleMonitor(None if lockstep else scenario.controller.rate)


def _task(report):
    def run(status):
        result = report()
        status.summary(int(result.level), result.text)
        for key, value in result.values.items():
            status.add(key, value)
        return status

    return run
