"""Which language model takes what the grammar cannot parse, from ``PROVIDER:MODEL``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import httpx

from app.settings import Settings
from planner.models.breaker import CircuitBreaker
from planner.models.protocol import LanguageModel
from planner.models.spec import language_model, parse_spec


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


def key_in(environment: Mapping[str, str]) -> str | None:
    """The model's key: what ``MAJORDOMO_LLM_KEY`` holds, or the file that ``MAJORDOMO_LLM_KEY_FILE`` names.

    Raises:
        OSError: the file cannot be read.
    """
    if key := environment.get("MAJORDOMO_LLM_KEY"):
        return key
    file = environment.get("MAJORDOMO_LLM_KEY_FILE")
    return Path(file).expanduser().read_text(encoding="utf-8", errors="replace").strip() if file else None
