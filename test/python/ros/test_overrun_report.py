"""Reports of overruns."""

from types import SimpleNamespace

from deformable_manipulation.ros import overrun_report


def test_overruns_are_one_line_with_the_node_and_the_remedy(monkeypatch):
    warnings = []
    rospy = SimpleNamespace(on_shutdown=lambda hook: None, get_name=lambda: "/left/assistants")
    monkeypatch.setattr(overrun_report, "rospy", rospy)
    monkeypatch.setattr(overrun_report, "age_of", lambda state: 1.0)
    monkeypatch.setattr(overrun_report.node.rospy, "logwarn", warnings.append)
    report = overrun_report.OverrunReport(0.01)
    for cycle in range(100):
        report.answered(SimpleNamespace(cycle=cycle, reset_count=0))
    (line,) = warnings
    assert line.startswith("/left/assistants: Overruns: 1 of 1 cycles")
    assert "lower controller.rate, or use lockstep:=true" in line
