"""The same examples in every run: a property fails where it was broken, never by the luck of a draw elsewhere.

New examples are drawn with ``make test ARGS="--hypothesis-profile fresh"``. No example fails for being slow, as it is
on a busy machine; what has to be fast is measured by a test of its own. Tests run beside each other on all cores, and
there threads of linear algebra that wait for each other cost several times what they save.
"""

import os

from hypothesis import settings

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
settings.register_profile("fresh", deadline=None)
settings.register_profile("reproducible", settings.get_profile("fresh"), derandomize=True)
settings.load_profile("reproducible")
