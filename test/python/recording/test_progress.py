import io

from deformable_manipulation.commands.progress import ProgressDisplay


class Terminal(io.StringIO):
    def isatty(self):
        return True


def show(stream, steps):
    display = ProgressDisplay(stream)
    for step in range(steps + 1):
        display(step / steps)
    display.close()
    return stream.getvalue()


def test_a_log_gets_a_line_every_ten_percent():
    lines = show(io.StringIO(), 1000).splitlines()
    assert lines == [f"{percent:3d} %" for percent in range(10, 101, 10)]


def test_a_terminal_gets_one_line_that_redraws_itself():
    text = show(Terminal(), 1000)
    states = text.rstrip("\n").split("\r")[1:]
    assert len(states) == 101
    assert states[50] == "[" + 20 * "#" + 20 * "." + "]  50 %"
    assert states[-1].endswith("100 %") and "." not in states[-1]
    assert text.endswith("\n") and text.count("\n") == 1


def test_closing_without_a_step_writes_nothing():
    stream = Terminal()
    ProgressDisplay(stream).close()
    assert stream.getvalue() == ""
