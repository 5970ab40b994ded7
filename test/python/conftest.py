"""Property tests try the same examples in every run, so that a run that passed passes again.

Matrices here are small: BLAS gains nothing from threads, which wait for one another on busy cores.
"""

import os

from hypothesis import settings

settings.register_profile("repeatable", derandomize=True)
settings.load_profile("repeatable")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # read when numpy is imported, after this
