#!/usr/bin/env python3
"""What the nodes say on /diagnostics, in good order and with an input that stays away."""

import os
import signal

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from faulty_run import FaultTest
from observed_run import Messages, call, run_tests
from std_srvs.srv import SetBool

PROGRAM = "controller: assistant_1 quadratic program"
REPORTS = {
    "simulator: loop",
    "simulator: object",
    "simulator: agents",
    "minimum_distance: distances",
    "leader: cycle",
    "leader: motion",
    "controller: cycle",
    "controller: inputs",
    PROGRAM,
}
_STARTING = "Node starting up"  # as diagnostic_updater says at once


class DiagnosticsTest(FaultTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.diagnostics = Messages("/diagnostics", DiagnosticArray)

    def wait_for_report(self, name, level, *words):
        """A report of this name and level, with these words, from now on; its values."""

        def find(message):
            for status in message.status:
                if status.name == name and status.level == level:
                    return all(word in status.message for word in words)
            return False

        what = "{} at level {} with {}".format(name, level, words)
        message = self.diagnostics.wait_for(find, what, len(self.diagnostics))
        status = next(each for each in message.status if each.name == name)
        return {value.key: value.value for value in status.values}

    def test_every_node_tells_how_it_fares(self):
        def name_all(_message):
            names = {
                status.name
                for message in list(self.diagnostics)
                for status in message.status
                if status.message != _STARTING
            }
            return REPORTS <= names

        self.diagnostics.wait_for(name_all, str(REPORTS))
        loop = self.wait_for_report("simulator: agents", DiagnosticStatus.OK, "in time")
        self.assertEqual(set(loop), {"leader", "assistant_1"})
        values = self.wait_for_report("simulator: object", DiagnosticStatus.OK, "Solved")
        self.assertLess(abs(float(values["relative error of its length"])), 1e-3)
        program = self.wait_for_report(PROGRAM, DiagnosticStatus.OK)
        self.assertGreater(float(program["lowest distance [m]"]), 0.0)
        self.assertIn("largest slack, collision [m/s]", program)
        self.wait_for_report(
            "controller: inputs", DiagnosticStatus.OK, "All inputs arrive in time."
        )
        self.wait_for_report("leader: motion", DiagnosticStatus.OK, "Follows its path.")

    def test_an_input_that_stays_away_is_named(self):
        process = self.processes["minimum_distance"]
        os.kill(process, signal.SIGSTOP)
        try:
            self.wait_for_report("controller: inputs", DiagnosticStatus.STALE, "No distances for")
            self.wait_for_report(PROGRAM, DiagnosticStatus.ERROR, "no distances for")
            self.wait_for_report("controller: cycle", DiagnosticStatus.STALE, "No state for")
        finally:
            os.kill(process, signal.SIGCONT)
        self.wait_for_report("controller: inputs", DiagnosticStatus.OK)

    def test_commands_that_stay_away_are_named(self):
        process = self.processes["leader"]
        os.kill(process, signal.SIGSTOP)
        try:
            self.wait_for_report(
                "simulator: agents", DiagnosticStatus.STALE, "leader: no command for more than"
            )
        finally:
            os.kill(process, signal.SIGCONT)
        self.wait_for_report("simulator: agents", DiagnosticStatus.OK)

    def test_a_pause_is_no_fault(self):
        call("pause", SetBool, True)
        self.addCleanup(call, "pause", SetBool, False)
        self.wait_for_report("simulator: loop", DiagnosticStatus.OK, "Paused.")


if __name__ == "__main__":
    run_tests("diagnostics")
