"""The same examples in every run: a property fails where it was broken, never by the luck of a draw elsewhere.

New examples are drawn with ``make test ARGS="--hypothesis-profile default"``.
"""

from hypothesis import settings

settings.register_profile("reproducible", derandomize=True)
settings.load_profile("reproducible")
