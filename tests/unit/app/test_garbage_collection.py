"""What lasts is loaded once, and left alone by the garbage collector."""

from __future__ import annotations

import gc
import weakref

import pytest

from app.garbage_collection import exempt_what_is_loaded


class Knot:
    """Refers to itself."""

    def __init__(self):
        self.me = self


@pytest.fixture
def thawed():
    yield
    gc.unfreeze()


@pytest.mark.usefixtures("thawed")
def test_only_what_comes_later_is_collected():
    lasting, gone = Knot(), Knot()
    lasts, was_gone = weakref.ref(lasting), weakref.ref(gone)
    del gone
    exempt_what_is_loaded()
    assert was_gone() is None
    later = Knot()
    comes = weakref.ref(later)
    del lasting, later
    gc.collect()
    assert comes() is None
    assert lasts() is not None
