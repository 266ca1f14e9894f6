"""One event loop, and every dialect of a model's server."""

from __future__ import annotations

import pytest

from model_server import DIALECTS


@pytest.fixture
def anyio_backend():
    return "asyncio"


@pytest.fixture(params=DIALECTS, ids=lambda dialect: dialect.provider)
def dialect(request):
    return request.param
