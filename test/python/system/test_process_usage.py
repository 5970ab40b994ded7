import os

import pytest

from deformable_manipulation.system.process_usage import usage_of

STAT = "42 (a (strange) name) S 1 42 42 0 -1 4194560 500 0 0 0 250 50 0 0 20 0 1 0 100 1000 10"
ROLLUP = "5560-7ffc ---p 00000000 00:00 0 [rollup]\nRss:  9000 kB\nPss:  4321 kB\nPss_Anon: 1 kB\n"


def test_reads_what_the_kernel_tells(tmp_path):
    folder = tmp_path / "42"
    folder.mkdir()
    (folder / "stat").write_text(STAT)
    (folder / "smaps_rollup").write_text(ROLLUP)
    usage = usage_of(42, tmp_path)
    assert usage.processor == pytest.approx(300.0 / os.sysconf("SC_CLK_TCK"))
    assert usage.memory == 4321 * 1024


def test_this_process_has_some():
    usage = usage_of(os.getpid())
    assert usage.processor > 0.0 and usage.memory > 1e6


def test_no_such_process(tmp_path):
    with pytest.raises(OSError):
        usage_of(1, tmp_path)
