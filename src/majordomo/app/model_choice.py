"""Which language model takes what the grammar cannot parse, from ``PROVIDER:MODEL``."""

from __future__ import annotations

import httpx

from majordomo.app.settings import Settings
from majordomo.planner.models.protocol import LanguageModel
from majordomo.planner.models.spec import language_model, parse_spec


def make_language_model(settings: Settings, http: httpx.AsyncClient) -> LanguageModel | None:
    """The configured model's client, ``None`` for the grammar alone.

    Raises:
        BadModelSpec: the model is not named as it should be.
    """
    if settings.llm is None:
        return None
    return language_model(parse_spec(settings.llm, base_url=settings.llm_url), http=http, key=settings.llm_key)
