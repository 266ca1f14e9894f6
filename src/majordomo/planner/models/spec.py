"""From ``provider:model@url`` to a language model. Keys and addresses come as arguments, never from the environment."""

from __future__ import annotations

from dataclasses import dataclass

import httpx

from majordomo.planner.errors import BadModelSpec
from majordomo.planner.models.openai import OpenAIModel
from majordomo.planner.models.protocol import LanguageModel

EXPECTED = "openai:MODEL or openai:MODEL@URL, such as openai:qwen2.5@http://127.0.0.1:8000/v1"
DEFAULT_URLS = {"openai": "https://api.openai.com/v1"}


@dataclass(frozen=True, kw_only=True)
class ModelSpec:
    """Which model, and where."""

    provider: str
    model: str
    base_url: str


def parse_spec(text: str, *, base_url: str | None = None) -> ModelSpec:
    """Read ``provider:model`` or ``provider:model@url``; ``base_url`` is used when the text names none.

    Raises:
        BadModelSpec: saying what is expected.
    """
    provider, colon, rest = text.strip().partition(":")
    model, _, url = rest.partition("@http")
    if not colon or provider not in DEFAULT_URLS or not model:
        raise BadModelSpec(text, EXPECTED)
    address = f"http{url}" if url else base_url or DEFAULT_URLS[provider]
    if not address.startswith(("http://", "https://")):
        raise BadModelSpec(text, EXPECTED)
    return ModelSpec(provider=provider, model=model, base_url=address)


def language_model(spec: ModelSpec, *, http: httpx.AsyncClient, key: str | None = None) -> LanguageModel:
    """The client of a specified model."""
    return OpenAIModel(spec.model, base_url=spec.base_url, http=http, key=key or "")
