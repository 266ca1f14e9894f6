"""Which language model takes what the grammar cannot parse, from ``PROVIDER:MODEL``."""

from __future__ import annotations

import httpx

from majordomo.app.settings import Settings
from majordomo.planner.models.breaker import CircuitBreaker
from majordomo.planner.models.protocol import LanguageModel
from majordomo.planner.models.spec import language_model, parse_spec


def make_language_model(settings: Settings, http: httpx.AsyncClient) -> LanguageModel | None:
    """The configured model's client, which rests while its server is out of order; ``None`` for the grammar alone.

    Raises:
        BadModelSpec: the model is not named as it should be.
        BadModelKey: its provider wants a key.
    """
    if settings.llm is None:
        return None
    spec = parse_spec(settings.llm, base_url=settings.llm_url)
    model = language_model(spec, http=http, key=settings.llm_key, context_tokens=settings.llm_context)
    return CircuitBreaker(model, place=spec.host)
