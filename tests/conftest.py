"""The same examples in every run: a property fails where it was broken, never by the luck of a draw elsewhere.

New examples are drawn with ``make test ARGS="--hypothesis-profile fresh"``. No example fails for being slow, as it is
on a busy machine; what has to be fast is measured by a test of its own. Tests run beside each other on all cores, and
there threads of linear algebra that wait for each other cost several times what they save.

What could not be tested for want of something on this machine is said in one line at the end, with what to install.
"""

import os
from collections import Counter

from hypothesis import settings

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
settings.register_profile("fresh", deadline=None)
settings.register_profile("reproducible", settings.get_profile("fresh"), derandomize=True)
settings.load_profile("reproducible")

WANTED = "to install: "
"""How a test that is skipped for want of something says what it is."""


def pytest_terminal_summary(terminalreporter):
    """One line for each thing that is wanted, with the number of tests that are skipped without it."""
    reasons = [str(report.longrepr[-1]) for report in terminalreporter.stats.get("skipped", []) if report.longrepr]
    wanted = Counter(reason.partition(WANTED)[2] for reason in reasons if WANTED in reason)
    for what, tests in wanted.items():
        terminalreporter.write_line(f"NOT TESTED: {tests} tests were skipped; {WANTED}{what}", yellow=True, bold=True)
